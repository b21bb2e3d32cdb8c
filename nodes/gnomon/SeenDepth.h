// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ResolvedDepth.h>
#include <gnomon/ScreenPass.h>

#include <OpenThreads/Mutex>
#include <glm/vec4.hpp>
#include <osg/Texture2D>

#include <map>
#include <string>

namespace gnomon {

/// A frame's depths as a texture, copied on the GPU; one a context, kept from frame to frame.
///
/// Threads one a context.
class SeenDepth {
public:
    /// What was copied, and how far off it may be: see depthShadow().
    struct Copy {
        std::string cause;     ///< why nothing was copied, for ShadowTechnique::report(); empty if all is well.
        glm::dvec4 error{0.0}; ///< in depth, in pixels; x and y of where in a pixel depths were taken, from its centre.
    };
    /// Copies these pixels of the framebuffer that is drawn to, to the same place in the texture.
    Copy copy(osg::State& state, const PixelRect& pixels);
    void bind(osg::State& state, unsigned unit);

    /// Lets go of what a context holds, of null of what all of them do.
    void release(osg::State* state);

private:
    osg::Texture2D& textureFor(unsigned context, const PixelRect& pixels, bool packed);

    ResolvedDepth _resolved;
    OpenThreads::Mutex _mutex;
    std::map<unsigned, osg::ref_ptr<osg::Texture2D>> _textures; ///< by context.
};

} // namespace gnomon
