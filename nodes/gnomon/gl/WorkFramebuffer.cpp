// SPDX-License-Identifier: MIT
#include <gnomon/gl/WorkFramebuffer.h>

#include <OpenThreads/ScopedLock>
#include <osg/ContextData>
#include <osg/GraphicsContext>

#include <glm/vec2.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr GLenum colorEncoding = 0x8210, componentType = 0x8211; // GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING and so on
constexpr GLenum srgbEncoding = 0x8C40, srgb8Alpha8 = 0x8C43;    // GL_SRGB, GL_SRGB8_ALPHA8
constexpr GLenum depth32fStencil8 = 0x8CAD;                      // GL_DEPTH32F_STENCIL8

/// As glGetFramebufferAttachmentParameteriv() names what is drawn to: a window's buffers by the eye.
GLenum attachmentOf(GLenum drawBuffer) {
    if (drawBuffer == GL_BACK || drawBuffer == GL_FRONT_AND_BACK) return GL_BACK_LEFT;
    return drawBuffer == GL_FRONT ? GL_FRONT_LEFT : drawBuffer;
}

GLenum colorFormat(GLenum attachment) {
    const GLint bits = glInteger(GL_RED_BITS);
    if (attachmentParameter(attachment, componentType) == GL_FLOAT) return bits > 16 ? GL_RGBA32F_ARB : GL_RGBA16F_ARB;
    if (attachmentParameter(attachment, colorEncoding) == srgbEncoding) return srgb8Alpha8;
    return bits > 8 ? GL_RGBA16 : GL_RGBA8;
}

void store(const osg::GLExtensions& extensions, GLuint& name, GLenum format, GLint samples, const glm::ivec2& size) {
    if (!name) extensions.glGenRenderbuffers(1, &name);
    extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, name);
    if (samples > 0)
        extensions.glRenderbufferStorageMultisample(GL_RENDERBUFFER_EXT, samples, format, size.x, size.y);
    else
        extensions.glRenderbufferStorage(GL_RENDERBUFFER_EXT, format, size.x, size.y);
}

/// Of depth and stencil.
void storeTexture(GLuint& name, GLsizei width, GLsizei height) {
    if (!name) glGenTextures(1, &name);
    const GLint before = glInteger(GL_TEXTURE_BINDING_2D);
    glBindTexture(GL_TEXTURE_2D, name);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH24_STENCIL8_EXT, width, height, 0, GL_DEPTH_STENCIL_EXT,
                 GL_UNSIGNED_INT_24_8_EXT, nullptr);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
}

constexpr GLenum topDownRows = 0x8BBB; // GL_FRAMEBUFFER_FLIP_Y_MESA

bool knowsTopDownRows(const osg::State& state) {
    return osg::isGLExtensionSupported(state.getContextID(), "GL_MESA_framebuffer_flip_y");
}

/// Lets rows of the framebuffer object that is bound go from the top. @return false if OpenGL knows no such thing.
bool letRowsGoDown(const osg::State& state) {
    static void (*const set)(GLenum, GLenum, GLint) = [] {
        void (*found)(GLenum, GLenum, GLint) = nullptr;
        osg::setGLExtensionFuncPtr(found, "glFramebufferParameteri", "glFramebufferParameteriMESA");
        return found;
    }();
    if (!set || !knowsTopDownRows(state)) return false;
    set(GL_FRAMEBUFFER_EXT, topDownRows, 1);
    return true;
}

/// Of the window; 0 where it is not known.
int heightOf(const osg::State& state) {
    const osg::GraphicsContext* context = state.getGraphicsContext();
    return context && context->getTraits() ? context->getTraits()->height : 0;
}

bool canCopy(const osg::GLExtensions& extensions, const WorkFormat& format) {
    return format.color && extensions.isFrameBufferObjectSupported && extensions.glBlitFramebuffer &&
           extensions.isPackedDepthStencilSupported &&
           (format.samples == 0 || extensions.glRenderbufferStorageMultisample);
}

/// Copies are cut to no rectangle, and colours are copied as they are.
class PlainCopy {
public:
    PlainCopy() {
        for (const GLenum mode : modes) _on.push_back(glIsEnabled(mode));
        for (const GLenum mode : modes) glDisable(mode);
    }
    ~PlainCopy() {
        for (std::size_t i = 0; i < _on.size(); ++i)
            if (_on[i]) glEnable(modes[i]);
    }
    PlainCopy(const PlainCopy&) = delete;
    PlainCopy& operator=(const PlainCopy&) = delete;

private:
    static constexpr GLenum modes[] = {GL_SCISSOR_TEST, framebufferSrgb};
    std::vector<GLboolean> _on;
};

/// Far depth and no marks, everywhere.
void clear() {
    glPushAttrib(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_SCISSOR_BIT | GL_ENABLE_BIT);
    glDisable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    glClearDepth(1.0);
    glStencilMask(~0u);
    glClearStencil(0);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glPopAttrib();
}

/// How large the work buffers must be. A window's rows are counted from the top where its height is known.
struct Placement {
    GLsizei width = 1, height = 1;
    bool isWindow = false, fits = false;
};

Placement placementOf(const osg::State& state, const osg::Viewport& viewport, bool isWindow) {
    const PixelRect all = pixelsOf(viewport);
    Placement place;
    place.isWindow = isWindow;
    place.width = std::max(1, all.x + all.width);
    place.height = std::max(1, all.y + all.height);
    place.fits = !isWindow || heightOf(state) >= place.height;
    if (isWindow && place.fits) place.height = heightOf(state);
    return place;
}

PixelRect cutTo(const Placement& place, const PixelRect& pixels) {
    return {pixels.x, pixels.y, std::max(0, std::min(pixels.width, place.width - pixels.x)),
            std::max(0, std::min(pixels.height, place.height - pixels.y))};
}

/// Upwards from the lowest row. Depths of 24 bits are the highest bits of each; others are of no account.
std::vector<GLuint> depthsOf(const osg::GLExtensions& extensions, GLuint framebuffer, const PixelRect& pixels) {
    std::vector<GLuint> depths(std::size_t(pixels.width) * std::size_t(pixels.height));
    extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, framebuffer);
    glReadPixels(pixels.x, pixels.y, pixels.width, pixels.height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, depths.data());
    for (GLuint& depth : depths) depth &= ~0xffu;
    return depths;
}

/// Depths, with stencil 0, to a texture. @param pixels  in rows of the texture.
void upload(GLuint texture, const PixelRect& pixels, const std::vector<GLuint>& depths) {
    const GLint before = glInteger(GL_TEXTURE_BINDING_2D);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexSubImage2D(GL_TEXTURE_2D, 0, pixels.x, pixels.y, pixels.width, pixels.height, GL_DEPTH_STENCIL_EXT,
                    GL_UNSIGNED_INT_24_8_EXT, depths.data());
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
}

void reverseRows(std::vector<GLuint>& depths, const PixelRect& pixels) {
    for (GLsizei low = 0, high = pixels.height - 1; low < high; ++low, --high)
        std::swap_ranges(depths.begin() + low * pixels.width, depths.begin() + (low + 1) * pixels.width,
                         depths.begin() + high * pixels.width);
}

} // namespace

WorkFormat WorkFormat::ofBound() {
    constexpr GLenum firstDrawBuffer = 0x8825; // GL_DRAW_BUFFER0
    const bool isWindow = glInteger(GL_FRAMEBUFFER_BINDING_EXT) == 0;
    const auto drawn = static_cast<GLenum>(glInteger(firstDrawBuffer));
    const GLint bits = glInteger(GL_DEPTH_BITS);
    WorkFormat format;
    if (drawn == GL_NONE || bits == 0) return format;
    const GLenum depth = isWindow ? GLenum(GL_DEPTH) : GLenum(GL_DEPTH_ATTACHMENT_EXT);
    const bool isFloat = attachmentParameter(depth, componentType) == GL_FLOAT;
    format.color = colorFormat(attachmentOf(drawn));
    format.depth = isFloat ? depth32fStencil8 : GLenum(GL_DEPTH24_STENCIL8_EXT);
    format.samples = glInteger(GL_SAMPLES);
    format.keepsDepth = !isFloat && bits == 24 && format.samples == 0;
    return format;
}

WorkBuffers::Buffers& WorkBuffers::fitting(const osg::GLExtensions& extensions, const WorkFormat& format, GLsizei width,
                                           GLsizei height) {
    Lock lock(_mutex);
    Buffers& buffers = _buffers[format];
    if (buffers.width >= width && buffers.height == height) return buffers;
    buffers.width = std::max(buffers.width, width);
    buffers.height = height;
    const glm::ivec2 size(buffers.width, buffers.height);
    store(extensions, buffers.color, format.color, format.samples, size);
    buffers.depthIsTexture = format.samples == 0 && format.depth == GL_DEPTH24_STENCIL8_EXT;
    if (buffers.depthIsTexture)
        storeTexture(buffers.depth, buffers.width, buffers.height);
    else
        store(extensions, buffers.depth, format.depth, format.samples, size);
    return buffers;
}

void WorkBuffers::deleteAllGLObjects() {
    const auto& extensions = *osg::GLExtensions::Get(_contextID, true);
    Lock lock(_mutex);
    for (const auto& [format, buffers] : _buffers) {
        extensions.glDeleteRenderbuffers(1, &buffers.color);
        if (buffers.depthIsTexture)
            glDeleteTextures(1, &buffers.depth);
        else
            extensions.glDeleteRenderbuffers(1, &buffers.depth);
    }
    _buffers.clear();
}

void WorkBuffers::discardAllGLObjects() {
    Lock lock(_mutex);
    _buffers.clear();
}

bool isTopDown(const osg::State& state) {
    static void (*const ask)(GLenum, GLenum, GLint*) = [] {
        void (*found)(GLenum, GLenum, GLint*) = nullptr;
        osg::setGLExtensionFuncPtr(found, "glGetFramebufferParameteriv", "glGetFramebufferParameterivMESA");
        return found;
    }();
    if (glInteger(GL_READ_FRAMEBUFFER_BINDING_EXT) == 0) return true;
    GLint topDown = 0;
    if (ask && knowsTopDownRows(state)) ask(GL_READ_FRAMEBUFFER_EXT, topDownRows, &topDown);
    return topDown != 0;
}

WorkFramebuffer::WorkFramebuffer(osg::State& state, const osg::Viewport& viewport, const PixelRect& pixels, bool depths)
    : _state(state), _extensions(*state.get<osg::GLExtensions>()) {
    const WorkFormat format = WorkFormat::ofBound();
    if (!canCopy(_extensions, format)) return;
    _target = static_cast<GLuint>(glInteger(GL_FRAMEBUFFER_BINDING_EXT));
    _drawBuffer = static_cast<GLenum>(glInteger(GL_DRAW_BUFFER));
    const Placement place = placementOf(state, viewport, _target == 0);
    _pixels = cutTo(place, pixels);
    _own.emplace(_extensions);
    _buffers = &osg::get<WorkBuffers>(state.getContextID())->fitting(_extensions, format, place.width, place.height);
    _isTopDown = place.isWindow && letRowsGoDown(state);
    if (!attach(format.samples) || !copyColors()) {
        _own.reset();
        return;
    }
    clear();
    if (depths && format.keepsDepth && place.fits && _isTopDown == place.isWindow) copyDepths();
    _own->bind();
}

WorkFramebuffer::~WorkFramebuffer() {
    if (_own) blit(_own->name, _target, GL_COLOR_BUFFER_BIT);
}

/// @return false if OpenGL cannot draw to these together, or gives them more samples.
bool WorkFramebuffer::attach(GLint samples) const {
    const auto attachBuffer = [this](GLenum to, GLuint buffer) {
        _extensions.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, to, GL_RENDERBUFFER_EXT, buffer);
    };
    attachBuffer(GL_COLOR_ATTACHMENT0_EXT, _buffers->color);
    for (const GLenum to : {GL_DEPTH_ATTACHMENT_EXT, GL_STENCIL_ATTACHMENT_EXT})
        if (_buffers->depthIsTexture)
            _extensions.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, to, GL_TEXTURE_2D, _buffers->depth, 0);
        else
            attachBuffer(to, _buffers->depth);
    return _own->isComplete() && glInteger(GL_SAMPLES) == samples;
}

/// The first copy to buffers shows whether OpenGL can. Leaves them bound for drawing.
bool WorkFramebuffer::copyColors() const {
    if (!_buffers->takesColor) return false;
    if (!_buffers->tried) glGetError(); // somebody else's
    blit(_target, _own->name, GL_COLOR_BUFFER_BIT);
    if (!_buffers->tried) _buffers->takesColor = glGetError() == GL_NO_ERROR;
    _buffers->tried = true;
    return _buffers->takesColor;
}

/// The first copy to buffers shows whether a blit leaves each bit as it is: by Mesa's llvmpipe (22.3) it does not.
void WorkFramebuffer::copyDepths() {
    using Copy = WorkBuffers::DepthCopy;
    Copy& way = _buffers->depthCopy;
    const bool first = way == Copy::Untried;
    if (first) glGetError(); // somebody else's
    if (way != Copy::Memory) blit(_target, _own->name, GL_DEPTH_BUFFER_BIT);
    if (first) {
        const PlainPixels plain(_state);
        const bool same = glGetError() == GL_NO_ERROR &&
                          depthsOf(_extensions, _target, _pixels) == depthsOf(_extensions, _own->name, _pixels);
        way = same ? Copy::Blit : Copy::Memory;
    }
    if (way == Copy::Memory) copyDepthsInMemory();
    _hasDepth = true;
}

void WorkFramebuffer::copyDepthsInMemory() const {
    const PlainPixels plain(_state);
    std::vector<GLuint> depths = depthsOf(_extensions, _target, _pixels);
    PixelRect rows = _pixels;
    if (_isTopDown) {
        reverseRows(depths, _pixels);
        rows.y = _buffers->height - (_pixels.y + _pixels.height);
    }
    upload(_buffers->depth, rows, depths);
}

/// What is drawn to is what is read.
void WorkFramebuffer::blit(GLuint from, GLuint to, GLbitfield what) const {
    const PlainCopy plain;
    _extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, from);
    _extensions.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, to);
    const auto before = static_cast<GLenum>(glInteger(GL_READ_BUFFER));
    if (from == _target) glReadBuffer(_drawBuffer == GL_FRONT_AND_BACK ? GLenum(GL_BACK) : _drawBuffer);
    const GLint right = _pixels.x + _pixels.width, top = _pixels.y + _pixels.height;
    _extensions.glBlitFramebuffer(_pixels.x, _pixels.y, right, top, _pixels.x, _pixels.y, right, top, what, GL_NEAREST);
    glReadBuffer(before);
}

} // namespace gnomon
