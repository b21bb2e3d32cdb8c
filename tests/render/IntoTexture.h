// SPDX-License-Identifier: MIT
#pragma once
#include "GlComplaints.h"

#include <osg/Texture2D>

#include <memory>

namespace test {

/// What a camera draws into.
struct Target {
    GLenum color = GL_RGBA8;
    osg::Camera::BufferComponent depth = osg::Camera::PACKED_DEPTH_STENCIL_BUFFER;
    GLenum depthFormat = GL_DEPTH24_STENCIL8_EXT;
    unsigned samples = 0;
};

/// Draws a scene into a framebuffer object and shows it on a quad as wide as the window.
struct IntoTexture {
    /// @param besideTheScene  the window shows the scene itself on the left, the texture on the right.
    IntoTexture(osg::Node* scene, const View& view, const Target& target, bool besideTheScene = false);

    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    osg::ref_ptr<osg::Camera> into; ///< draws into it.
    std::unique_ptr<Camera> camera;
    std::unique_ptr<GlComplaints> complaints;
};

} // namespace test
