// SPDX-License-Identifier: MIT
// What the code in the guide's pages takes for granted: includes, and a scene's things by the names that pages give them.
#pragma once
#pragma GCC diagnostic ignored "-Wshadow" // pages declare what others take for granted
#pragma GCC diagnostic ignored "-Wunused-variable"
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/BoxShadow.h>
#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>
#include <gnomon/HeadlessContext.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowQuery.h>
#include <gnomon/ShadowReport.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/ShadowStats.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/ShadowedScene.h>
#include <gnomon/SunClock.h>
#include <gnomon/TerrainGround.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/VertexTraverser.h>

#include <osg/Geometry>
#include <osg/Material>
#include <osg/Program>
#include <osg/ShapeDrawable>
#include <osgGA/TrackballManipulator>
#include <osgShadow/ShadowMap>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <iostream>

namespace page {

extern osgViewer::Viewer viewer;
extern osg::ref_ptr<osg::Camera> camera;
extern osg::ref_ptr<osg::Geometry> grass;
extern osg::ref_ptr<osg::Group> root;
extern osg::ref_ptr<osg::Node> scene, ground, floor, hall, house, model, moved, proxy, terrain, trees;
extern osg::ref_ptr<osg::LightSource> lightSource;
extern osg::ref_ptr<osg::Program> program;
extern osg::ref_ptr<gnomon::ShadowCasterGroup> group;
extern osg::ref_ptr<gnomon::ShadowTechnique> technique;
extern osg::ref_ptr<gnomon::PlanarShadowNode> planar;
extern osg::ref_ptr<gnomon::ShadowMapTechnique> shadow;
extern osg::Vec3d eye, player;
extern osg::Vec4d sun;

} // namespace page
