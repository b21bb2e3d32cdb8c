// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/casters/CasterView.h>

#include <osg/Matrixd>
#include <osg/Vec3>
#include <osg/ref_ptr>
#include <osgUtil/StateGraph>

namespace gnomon {

/// A technique met in the cull of one stage, and what it needs to know of the view.
struct EnlistedTechnique {
    osg::ref_ptr<const ShadowTechnique> technique;
    osg::ref_ptr<const ShadowCasterGroup> group;
    osg::Matrixd eyeFromGroup;
    osg::Matrixd groupFromTechnique;
    osg::ref_ptr<osg::RefMatrix> projection;    ///< shared with the leaves: near and far are set in it after the cull.
    osg::Vec3 viewPoint;                        ///< eye space, see CasterView.
    float lodScale = 1.0f;                      ///< of the cull.
    osg::Node::NodeMask mask = ~0u;             ///< the same, see CasterView.
    const osgUtil::StateGraph* state = nullptr; ///< that it was met in; valid as long as the stage's leaves.
    unsigned frameNumber = 0;
    double frameTime = 0.0; ///< seconds, see timeOf().
};

} // namespace gnomon
