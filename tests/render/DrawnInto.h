// SPDX-License-Identifier: MIT
#pragma once
#include "IntoTexture.h"
#include "TracedCases.h"

namespace test {

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
