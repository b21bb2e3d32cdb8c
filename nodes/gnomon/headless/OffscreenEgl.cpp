// SPDX-License-Identifier: MIT
#include <gnomon/headless/OffscreenContext.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <array>
#include <vector>

namespace gnomon {
namespace {

template <typename Function>
Function eglFunction(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Places to draw without a window, the best first: GPUs, software, and what the environment names.
std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> result;
    const auto platformDisplay = eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    const auto queryDevices = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    std::array<EGLDeviceEXT, 32> devices;
    EGLint count = 0;
    if (platformDisplay && queryDevices && queryDevices(EGLint(devices.size()), devices.data(), &count))
        for (EGLint i = 0; i < count; ++i)
            result.push_back(platformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[std::size_t(i)], nullptr));
    if (platformDisplay) result.push_back(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    result.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return result;
}

/// A configuration for a colour buffer of 8 bits a channel; null if the display has none.
EGLConfig configOf(EGLDisplay display, int depthBits, int stencilBits) {
    // clang-format off
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8,
                             EGL_DEPTH_SIZE, depthBits, EGL_STENCIL_SIZE, stencilBits, EGL_NONE};
    // clang-format on
    EGLConfig config = nullptr;
    EGLint count = 0;
    return eglChooseConfig(display, wanted, &config, 1, &count) && count > 0 ? config : nullptr;
}

EGLDisplay findDisplay() {
    for (EGLDisplay display : displays())
        if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) && configOf(display, 0, 0))
            return display;
    throw headlessFailure(
        "EGL finds no device that renders without a display. Install a GPU driver, or Mesa's (Debian: libegl-mesa0).");
}

/// One for the process, never closed: closing it would end every context on it.
EGLDisplay sharedDisplay() {
    static const EGLDisplay display = findDisplay();
    return display;
}

/// Colour in float, or more depth bits than a pbuffer has, take a framebuffer object.
bool needsFramebuffer(const HeadlessOptions& o) { return o.floatColor || o.depthBits > 24; }

class EglOffscreen : public OffscreenContext {
public:
    explicit EglOffscreen(const HeadlessOptions& options) : _display(sharedDisplay()) {
        const bool plain = !needsFramebuffer(options);
        const EGLConfig config = configOf(_display, plain ? options.depthBits : 0, plain ? options.stencilBits : 0);
        if (!config) throw headlessFailure("EGL makes no context with these depth and stencil bits. Ask for fewer.");
        eglBindAPI(EGL_OPENGL_API);
        _context = eglCreateContext(_display, config, EGL_NO_CONTEXT, nullptr);
        _surface = createSurface(config, plain ? options.width : 1, plain ? options.height : 1);
        if (_context != EGL_NO_CONTEXT && _surface != EGL_NO_SURFACE) return;
        destroy();
        throw headlessFailure("EGL makes no picture of " + sizeText(options.width, options.height) + " pixels.");
    }
    ~EglOffscreen() override { destroy(); }

    bool bind() override {
        eglBindAPI(EGL_OPENGL_API); // a thread's own setting
        return eglMakeCurrent(_display, _surface, _surface, _context) != EGL_FALSE;
    }
    bool unbind() override {
        return eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT) != EGL_FALSE;
    }
    unsigned framebuffer() const override { return _framebuffer; }
    std::string name() const override { return "EGL"; }
    std::string linkRemedy() const override { return "Link libGL, and no libOSMesa ahead of it"; }

    void prepare(const HeadlessOptions& options) override {
        if (needsFramebuffer(options)) addFramebuffer(options);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT); // else it holds another's picture
    }

private:
    /// It and its buffers go with the context.
    void addFramebuffer(const HeadlessOptions& options);

    EGLSurface createSurface(EGLConfig config, int width, int height) const {
        const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
        return eglCreatePbufferSurface(_display, config, size);
    }

    void destroy() {
        if (_surface != EGL_NO_SURFACE) eglDestroySurface(_display, _surface);
        if (_context != EGL_NO_CONTEXT) eglDestroyContext(_display, _context);
    }

    EGLDisplay _display;
    EGLContext _context = EGL_NO_CONTEXT;
    EGLSurface _surface = EGL_NO_SURFACE;
    GLuint _framebuffer = 0;
};

GLenum depthFormat(const HeadlessOptions& o) {
    if (o.depthBits > 24) return o.stencilBits ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F;
    return o.stencilBits ? GL_DEPTH24_STENCIL8 : o.depthBits > 16 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT16;
}

/// Gives the current framebuffer object a buffer of this format.
void attachBuffer(GLenum point, GLenum format, int width, int height) {
    GLuint buffer = 0;
    eglFunction<PFNGLGENRENDERBUFFERSPROC>("glGenRenderbuffers")(1, &buffer);
    eglFunction<PFNGLBINDRENDERBUFFERPROC>("glBindRenderbuffer")(GL_RENDERBUFFER, buffer);
    eglFunction<PFNGLRENDERBUFFERSTORAGEPROC>("glRenderbufferStorage")(GL_RENDERBUFFER, format, width, height);
    eglFunction<PFNGLFRAMEBUFFERRENDERBUFFERPROC>("glFramebufferRenderbuffer")(GL_FRAMEBUFFER, point, GL_RENDERBUFFER,
                                                                               buffer);
}

void EglOffscreen::addFramebuffer(const HeadlessOptions& o) {
    eglFunction<PFNGLGENFRAMEBUFFERSPROC>("glGenFramebuffers")(1, &_framebuffer);
    eglFunction<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, _framebuffer);
    attachBuffer(GL_COLOR_ATTACHMENT0, o.floatColor ? GL_RGBA32F : GL_RGBA8, o.width, o.height);
    attachBuffer(o.stencilBits ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depthFormat(o), o.width, o.height);
    const auto status = eglFunction<PFNGLCHECKFRAMEBUFFERSTATUSPROC>("glCheckFramebufferStatus")(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw headlessFailure("EGL makes no framebuffer with float colour or 32 depth bits of " +
                              sizeText(o.width, o.height) + " pixels.");
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

} // namespace

std::unique_ptr<OffscreenContext> makeOffscreenContext(const HeadlessOptions& options) {
    return std::make_unique<EglOffscreen>(options);
}

} // namespace gnomon
