// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/BoundingBox>
#include <osg/LightSource>
#include <osg/Node>
#include <osg/Vec4d>
#include <osg/ref_ptr>

#include <vector>

namespace gnomon {

/// Bounds of a scene's vertices, in double. Text and billboards count only if there is nothing else.
/// @return an invalid box if nothing is drawn.
GNOMON_EXPORT osg::BoundingBoxd sceneBounds(osg::Node& root);

/// Makes a matt white square, named "ground", for a scene that stands on nothing.
///
/// Its normal is +z. Its centre lies under that of `scene`, 1/10000 of the scene's radius below its lowest point.
/// @param scene  bounds of what stands on it, for example those of sceneBounds().
/// @param side   length of a side, scene's unit, > 0.
GNOMON_EXPORT osg::ref_ptr<osg::Node> makeGround(const osg::BoundingBoxd& scene, double side);

/// The direction towards a sun, homogeneous: w is 0.
/// @param azimuth    degrees, from north = +y through east = +x.
/// @param elevation  degrees above the horizon; the zenith is +z.
GNOMON_EXPORT osg::Vec4d sunAt(double azimuth, double elevation);

/// All LightSources under a node that hold a light, in traversal order. Switches and node masks count.
GNOMON_EXPORT std::vector<osg::ref_ptr<osg::LightSource>> lightSourcesIn(osg::Node& root);

/// Asks for 8 stencil bits in osg::DisplaySettings, for all windows that are made afterwards. They spare a copy each frame.
GNOMON_EXPORT void askForStencilBits();

/// Asks for 8 alpha bits in osg::DisplaySettings, for all windows that are made afterwards. With smooth and soft edges
/// they spare a copy each frame.
GNOMON_EXPORT void askForAlphaBits();

} // namespace gnomon
