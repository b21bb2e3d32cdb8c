// SPDX-License-Identifier: MIT
#include <gnomon/gl/WorkBuffers.h>

#include <OpenThreads/ScopedLock>

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

void store(const osg::GLExtensions& extensions, GLuint& name, GLenum format, GLint samples, GLsizei width,
           GLsizei height) {
    if (!name) extensions.glGenRenderbuffers(1, &name);
    extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, name);
    if (samples > 0)
        extensions.glRenderbufferStorageMultisample(GL_RENDERBUFFER_EXT, samples, format, width, height);
    else
        extensions.glRenderbufferStorage(GL_RENDERBUFFER_EXT, format, width, height);
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
    store(extensions, buffers.color, format.color, format.samples, buffers.width, buffers.height);
    buffers.depthIsTexture = format.samples == 0 && format.depth == GL_DEPTH24_STENCIL8_EXT;
    if (buffers.depthIsTexture)
        storeTexture(buffers.depth, buffers.width, buffers.height);
    else
        store(extensions, buffers.depth, format.depth, format.samples, buffers.width, buffers.height);
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

} // namespace gnomon
