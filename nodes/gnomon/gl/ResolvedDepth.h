// SPDX-License-Identifier: MIT
#pragma once
#include <OpenThreads/Mutex>
#include <osg/GL>
#include <osg/State>

#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <optional>

namespace osg {
class GLExtensions;
}

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
    std::optional<glm::dvec2> read(osg::State& state, GLint x, GLint y, GLsizei width, GLsizei height,
                                   const std::function<void()>& readOut);

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

} // namespace gnomon
