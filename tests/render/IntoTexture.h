// SPDX-License-Identifier: MIT
#pragma once
#include "GlComplaints.h"
#include "TracedCases.h"

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

constexpr GLenum depth24 = GL_DEPTH24_STENCIL8_EXT, depth32 = 0x8CAD; // GL_DEPTH32F_STENCIL8

/// Depth, of either format, and stencil in one buffer.
inline Target withDepth(GLenum format, unsigned samples = 0) {
    return {GL_RGBA8, osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, format, samples};
}
inline Target fourSamples(GLenum format = depth24) { return withDepth(format, 4); }

/// A case drawn into a framebuffer object.
struct DrawnInto {
    /// @param shadow  null for none.
    DrawnInto(const TracedCase& given, const Target& target, gnomon::ShadowTechnique* shadow, bool dark = false)
        : technique(shadow), scene(given.build()) {
        if (dark) scene.takeLightAway();
        if (technique) scene.addShadow(technique);
        into = std::make_unique<IntoTexture>(scene.root, given.view, target);
    }
    Picture frame() { return into->camera->frame(); }
    void shine(const osg::Vec4d& light) { scene.light->getLight()->setPosition(osg::Vec4(light)); }

    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    Scene scene;
    std::unique_ptr<IntoTexture> into;
};

/// The next frame of a case drawn so, against rays.
inline TruthComparison compareWithRays(DrawnInto& drawn, const TracedCase& given, const Target& target) {
    DrawnInto lit(given, target, nullptr), dark(given, target, nullptr, true);
    return compare(drawn.frame(), lit.frame(), dark.frame(), given.truth());
}

} // namespace test
