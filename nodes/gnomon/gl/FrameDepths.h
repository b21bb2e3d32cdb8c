// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/GlState.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <osg/GL>
#include <osg/GLExtensions>
#include <osg/State>
#include <osg/Texture2D>
#include <osg/Viewport>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace gnomon {

/// Causes for ShadowTechnique::report().
constexpr const char* noDepth =
    "this framebuffer has no depth bits, so visible points are unknown. Give the camera a depth buffer.";
constexpr const char* unresolvedDepth = "the depth of this multisampled framebuffer object cannot be resolved. Attach "
                                        "a renderbuffer for depth instead of a texture.";

/// Reads depths of multisampled framebuffer objects, which glReadPixels() refuses to: resolved into a renderbuffer without
/// samples first, one a context, kept from frame to frame. Which of a pixel's samples counts is the driver's choice: where
/// it lies is found out by resolving a slope.
///
/// Threads one a context.
class ResolvedDepth {
public:
    ResolvedDepth() = default;
    ~ResolvedDepth() { release(nullptr); }
    ResolvedDepth(const ResolvedDepth&) = delete;
    ResolvedDepth& operator=(const ResolvedDepth&) = delete;

    /// True where glReadPixels() reads no depths: it reads no samples but a window's, which OpenGL resolves by itself.
    static bool isNeeded(const osg::State& state);

    /// Calls `readOut` while the depths of the framebuffer that is bound for drawing can be read without samples, in window
    /// coordinates; bindings stay as they are. The scissor must not cut into the rectangle; no program is bound.
    /// @return where in its pixel each depth was taken, 0 … 1; nothing if OpenGL cannot resolve them.
    std::optional<glm::dvec2> read(osg::State& state, const PixelRect& pixels, const std::function<void()>& readOut);

    /// Lets go of what a context holds, of null of what all of them do; OSG deletes it when it next can.
    void release(const osg::State* state);

private:
    struct Buffers {
        GLuint depth = 0; ///< a renderbuffer.
        GLenum format = 0;
        GLint samples = 0;
        GLsizei width = 0, height = 0;
        glm::dvec2 place{0.5};
    };
    Buffers& of(unsigned context);
    static void fit(Buffers& buffers, const osg::GLExtensions& extensions, GLsizei width, GLsizei height);
    static double placeOnSlope(const Buffers& buffers, GLuint into, osg::State& state, bool upwards);
    static void letGo(unsigned context, const Buffers& buffers);

    OpenThreads::Mutex _mutex;
    std::map<unsigned, Buffers> _buffers; ///< by context.
};

/// A frame's depths as a texture, copied on the GPU for marks that look at them; one a context, kept from frame to frame, and
/// another one where depths are of another format. While no depth is written, one copy serves all marks.
///
/// Threads one a context; contexts that share objects draw one after the other.
class FrameDepths {
public:
    /// What was copied, and how far off it may be: see depthBufferShadow().
    struct Copy {
        std::string cause;     ///< why nothing was copied, for ShadowTechnique::report(); empty if all is well.
        glm::dvec4 error{0.0}; ///< in depth, in pixels; x and y of where in a pixel depths were taken, from its centre.
        osg::ref_ptr<osg::Texture2D> texture{}; ///< until the next copy in this context.
        glm::dvec2 rows{0.0, 1.0};              ///< pixels of row y are in the texture's row rows.x + y rows.y.
    };

    /// Those that all techniques share, as long as any has them.
    static std::shared_ptr<FrameDepths> shared();
    /// What has been copied before stands no more. @param pixels  of all marks that will look: each copy holds these.
    static void begin(const osg::State& state, const PixelRect& pixels);
    /// Copies these pixels now, for marks that are drawn when something else is drawn to.
    static void hold(osg::State& state, const PixelRect& pixels);
    /// What has been copied stands no more: depth has been written.
    static void forget(const osg::State& state);
    /// The same of this one.
    void drop(const osg::State& state) { of(state)->held = {}; }

    /// Depths of these pixels of the framebuffer that is drawn to, in the same columns of the texture.
    Copy copy(osg::State& state, const PixelRect& pixels);

    /// Lets go of what a context holds, of null of what all of them do.
    void release(osg::State* state);

private:
    /// Of one context, with or without stencil.
    struct Target {
        osg::ref_ptr<osg::Texture2D> texture;
        bool packed = false;                                   ///< with stencil, as windows have it.
        osg::ref_ptr<const osg::Texture::TextureObject> tried; ///< to be drawn to.
        bool mirrors = true;                                   ///< false once OpenGL has refused to copy so.
    };
    /// Of one context.
    struct Kept {
        ResolvedDepth resolved;
        Target packed, plain;
        PixelRect wanted; ///< see begin().
        PixelRect held;   ///< that the copy is of: none once it is forgotten.
        Copy copy;
    };
    std::shared_ptr<Kept> of(const osg::State& state);
    static Copy make(osg::State& state, Kept& kept, const PixelRect& pixels);
    static void fit(Target& target, const osg::State& state, const PixelRect& pixels);
    static glm::dvec2 transfer(osg::State& state, Target& target, const PixelRect& pixels);
    static bool mirror(osg::State& state, Target& target, const PixelRect& pixels);

    OpenThreads::Mutex _mutex;
    std::map<unsigned, std::shared_ptr<Kept>>
        _kept; ///< by context. Another technique may let go of it while this one draws.
};

/// From window coordinates x and y, and 1 - depth, of which floats are fine far away.
glm::dmat4 clipFromPixel(const osg::Viewport& viewport);

} // namespace gnomon
