// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Casting.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Vec3>
#include <osg/Viewport>
#include <osg/ref_ptr>

#include <vector>

namespace gnomon {

/// The view that nodes choose by what they show: levels of detail by its eye, scale and pixels; and how it is drawn.
struct CasterView {
    osg::Matrixd eyeFromGroup;            ///< modelview at the ShadowCasterGroup.
    osg::Matrixd projection;              ///< near and far do not matter.
    osg::ref_ptr<osg::Viewport> viewport; ///< null: nothing is chosen by pixels.
    osg::Vec3 viewPoint;                  ///< eye space; elsewhere than the eye where a camera inherits it.
    float lodScale = 1.0f;                ///< of the cull.
    const void* key = nullptr;            ///< any address that tells views apart.
    osg::Node::NodeMask mask = ~0u;       ///< of the cull: it draws a node if they share a bit.
    std::vector<NumberedPlane> planes{};  ///< clip planes of all the view, group frame.
};

} // namespace gnomon
