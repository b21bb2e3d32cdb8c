// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/ResolvedDepth.h>
#include <gnomon/gl/ScreenPass.h>

#include <OpenThreads/Mutex>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <osg/Texture2D>

#include <map>
#include <string>
#include <utility>

namespace gnomon {

/// A frame's depths as a texture, copied on the GPU; one a context, kept from frame to frame, and another one where depths
/// are of another format.
///
/// Threads one a context.
class FrameDepthCopy {
public:
    /// What was copied, and how far off it may be: see depthBufferShadow().
    struct Copy {
        std::string cause;     ///< why nothing was copied, for ShadowTechnique::report(); empty if all is well.
        glm::dvec4 error{0.0}; ///< in depth, in pixels; x and y of where in a pixel depths were taken, from its centre.
        osg::ref_ptr<osg::Texture2D> texture{}; ///< until the next copy in this context.
        glm::dvec2 rows{0.0, 1.0};              ///< pixels of row y are in the texture's row rows.x + y rows.y.
    };
    /// Copies these pixels of the framebuffer that is drawn to, to the same columns of the texture.
    Copy copy(osg::State& state, const PixelRect& pixels);

    /// Lets go of what a context holds, of null of what all of them do.
    void release(osg::State* state);

private:
    /// Of one context.
    struct Target {
        osg::ref_ptr<osg::Texture2D> texture;
        bool packed = false;                                   ///< with stencil, as windows have it.
        osg::ref_ptr<const osg::Texture::TextureObject> tried; ///< to be drawn to.
        bool mirrors = true;                                   ///< false once OpenGL has refused to copy so.
    };
    Target& targetFor(const osg::State& state, const PixelRect& pixels, bool packed);
    static glm::dvec2 transfer(osg::State& state, Target& target, const PixelRect& pixels);
    static bool mirror(osg::State& state, Target& target, const PixelRect& pixels);

    ResolvedDepth _resolved;
    OpenThreads::Mutex _mutex;
    std::map<std::pair<unsigned, bool>, Target> _targets; ///< by context, and whether packed.
};

} // namespace gnomon
