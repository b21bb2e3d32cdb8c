// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/gl/WorkBuffers.h>

#include <optional>

namespace gnomon {

/// True if the rows of the framebuffer that is bound for reading go from the top: Mesa's windows', and those of what
/// stands for them.
bool isTopDown(const osg::State& state);

/// A framebuffer object with eight stencil bits and alpha that stands for the framebuffer which is bound, and is bound in
/// its place while it lives: where that one lacks such bits, or its stencil is somebody else's.
///
/// Its pixels have the same places, samples and depths; the colours are copied in, and copied back at its end. Of Mesa's
/// windows the rows go from the top, and so do its own: else OpenGL would round otherwise in the two.
///
/// Needs   OpenGL 3.0, or framebuffer objects that can be blitted between.
/// Threads one a context.
class WorkFramebuffer {
public:
    /// @param pixels  that are copied; others are undefined.
    WorkFramebuffer(osg::State& state, const osg::Viewport& viewport, const PixelRect& pixels);
    ~WorkFramebuffer();
    WorkFramebuffer(const WorkFramebuffer&) = delete;
    WorkFramebuffer& operator=(const WorkFramebuffer&) = delete;

    /// False if OpenGL makes none: what was bound before still is.
    bool isBound() const { return _own.has_value(); }
    /// False if depths could not be copied, and are all far.
    bool hasDepth() const { return _hasDepth; }

private:
    bool attach(GLint samples) const;
    bool copyColors() const;
    void copyDepths();
    void copyDepthsInMemory() const;
    void blit(GLuint from, GLuint to, GLbitfield what) const;

    osg::State& _state;
    const osg::GLExtensions& _extensions;
    PixelRect _pixels;
    GLuint _target = 0;
    GLenum _drawBuffer = GL_BACK;
    WorkBuffers::Buffers* _buffers = nullptr;
    std::optional<ScratchFramebuffer> _own;
    bool _isTopDown = false, _hasDepth = false;
};

} // namespace gnomon
