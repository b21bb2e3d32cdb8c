// SPDX-License-Identifier: MIT
#pragma once
#include <OpenThreads/Mutex>
#include <osg/State>
#include <osg/Texture2D>
#include <osg/Viewport>

#include <map>

namespace gnomon {

/// Keeps what a viewport shows, in a texture a context, and mixes it with what is drawn there later.
///
/// Threads one a context.
class FrameColorCopy {
public:
    FrameColorCopy() = default;
    FrameColorCopy(const FrameColorCopy&) = delete;
    FrameColorCopy& operator=(const FrameColorCopy&) = delete;

    /// Copies what the scissor box holds of the viewport. Called within a CleanState.
    /// @return false if OpenGL cannot read the framebuffer that is bound: an object of several samples.
    bool save(osg::State& state, const osg::Viewport& viewport);
    /// Draws the copy over the viewport, texel on pixel; stencil, scissor and blending are the caller's.
    void draw(osg::State& state);

    void resizeGLObjectBuffers(unsigned maxSize);
    /// Lets go of what a context holds, of null of what all of them do.
    void release(osg::State* state);

private:
    osg::Texture2D& of(unsigned context);

    OpenThreads::Mutex _mutex;
    std::map<unsigned, osg::ref_ptr<osg::Texture2D>> _textures; ///< by context.
};

} // namespace gnomon
