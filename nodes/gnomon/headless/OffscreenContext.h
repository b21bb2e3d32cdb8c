// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HeadlessOptions.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace gnomon {

/// What HeadlessContext stands on: an OpenGL context with colour, depth and stencil of a fixed size in memory. A
/// program links one of its makers, OffscreenOSMesa.cpp or OffscreenEgl.cpp.
class OffscreenContext {
public:
    OffscreenContext() = default;
    virtual ~OffscreenContext() = default;
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// Called once, with the context current. @throws std::runtime_error
    virtual void prepare(const HeadlessOptions&) {}
    /// Makes it this thread's current context.
    virtual bool bind() = 0;
    /// Leaves this thread without a current context.
    virtual bool unbind() = 0;
    /// Number of the framebuffer object that stands for its own buffers; 0 if it needs none.
    virtual unsigned framebuffer() const { return 0; }
    /// Its colours, bottom row first, complete after glFinish(); null if they are to be had by glReadPixels alone.
    virtual const unsigned char* pixels() const { return nullptr; }
    /// "OSMesa", "EGL": for messages.
    virtual std::string name() const = 0;
    /// What to do where OpenGL calls do not reach it.
    virtual std::string linkRemedy() const = 0;
};

/// Not current yet. @throws std::runtime_error with one sentence if it cannot be made.
std::unique_ptr<OffscreenContext> makeOffscreenContext(const HeadlessOptions& options);

/// The exception of all that belongs to HeadlessContext.
inline std::runtime_error headlessFailure(const std::string& sentence) {
    return std::runtime_error("HeadlessContext: " + sentence);
}

/// "800x600"
inline std::string sizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

} // namespace gnomon
