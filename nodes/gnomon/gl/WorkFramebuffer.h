// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <OpenThreads/Mutex>
#include <osg/GLObjects>
#include <osg/State>

#include <map>
#include <optional>
#include <tuple>

namespace gnomon {

/// What the buffers of a WorkFramebuffer have in common with those of the framebuffer that it stands for.
struct WorkFormat {
    GLenum color = 0; ///< with alpha; 0 if no colours are drawn there.
    GLenum depth = 0; ///< with eight stencil bits; 0 if there is no depth.
    GLint samples = 0;
    bool keepsDepth = false; ///< depths can be copied bit for bit: of one sample, in 24 bits.

    /// That of the framebuffer that is bound for drawing.
    static WorkFormat ofBound();

    bool operator<(const WorkFormat& other) const { return key() < other.key(); }

private:
    std::tuple<GLenum, GLenum, GLint> key() const { return {color, depth, samples}; }
};

/// The renderbuffers of a context's WorkFramebuffers, kept from frame to frame and for as long as the context lives.
///
/// Threads one a context.
class WorkBuffers : public osg::GraphicsObjectManager {
public:
    /// How depths come from the framebuffer that is stood for.
    enum class DepthCopy {
        Untried,
        Blit,
        Memory, ///< blits change bits.
    };
    /// Of one format.
    struct Buffers {
        GLuint color = 0; ///< a renderbuffer.
        GLuint depth = 0; ///< the same; of one sample and 24 bits a texture.
        bool depthIsTexture = false;
        GLsizei width = 0, height = 0;
        bool tried = false;     ///< to copy colours to them.
        bool takesColor = true; ///< false once OpenGL has refused that.
        DepthCopy depthCopy = DepthCopy::Untried;
    };

    explicit WorkBuffers(unsigned context) : osg::GraphicsObjectManager("gnomon::WorkBuffers", context) {}

    /// Buffers of that format: at least as wide; exactly as high.
    Buffers& fitting(const osg::GLExtensions& extensions, const WorkFormat& format, GLsizei width, GLsizei height);

    bool empty() const { return _buffers.empty(); }

    void flushDeletedGLObjects(double, double&) override {}
    void flushAllDeletedGLObjects() override {}
    void deleteAllGLObjects() override;
    void discardAllGLObjects() override;

protected:
    ~WorkBuffers() override = default;

private:
    OpenThreads::Mutex _mutex;
    std::map<WorkFormat, Buffers> _buffers;
};

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
    /// @param pixels  that are copied; others are undefined. @param depths  are copied, too.
    WorkFramebuffer(osg::State& state, const osg::Viewport& viewport, const PixelRect& pixels, bool depths);
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
