// SPDX-License-Identifier: MIT
#include <gnomon/gl/ResolvedDepth.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ScreenPass.h>

#include <OpenThreads/ScopedLock>
#include <osg/ContextData>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

GLint attachedDepth(GLenum what) { return attachmentParameter(GL_DEPTH_ATTACHMENT_EXT, what); }

/// The format of the depths that are drawn to: only between equal ones does OpenGL resolve. 0 if they are in no
/// renderbuffer.
GLenum depthFormat(const osg::GLExtensions& extensions) {
    const auto name = static_cast<GLuint>(attachedDepth(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME_EXT));
    const GLint kind = attachedDepth(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE_EXT);
    GLint format = 0;
    if (kind != GL_RENDERBUFFER_EXT || !extensions.glGetRenderbufferParameteriv) return 0;
    extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, name);
    extensions.glGetRenderbufferParameteriv(GL_RENDERBUFFER_EXT, GL_RENDERBUFFER_INTERNAL_FORMAT_EXT, &format);
    return static_cast<GLenum>(format);
}

/// Leaves `to` bound for reading.
void resolve(const osg::GLExtensions& extensions, GLuint from, GLuint to, GLint x, GLint y, GLsizei width,
             GLsizei height) {
    extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, from);
    extensions.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, to);
    extensions.glBlitFramebuffer(x, y, x + width, y + height, x, y, x + width, y + height, GL_DEPTH_BUFFER_BIT,
                                 GL_NEAREST);
    extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, to);
}

/// One pixel of several samples; bound for drawing while it lives.
class Pixel {
public:
    Pixel(const osg::GLExtensions& extensions, GLenum format, GLint samples)
        : framebuffer(extensions), _extensions(extensions) {
        extensions.glGenRenderbuffers(1, &_depth);
        extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, _depth);
        extensions.glRenderbufferStorageMultisample(GL_RENDERBUFFER_EXT, samples, format, 1, 1);
        framebuffer.attachDepth(_depth);
        glPushAttrib(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_SCISSOR_BIT);
        glViewport(0, 0, 1, 1);
        for (const GLenum mode : {GL_SCISSOR_TEST, GL_STENCIL_TEST}) glDisable(mode);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
        glDepthMask(GL_TRUE);
    }
    ~Pixel() {
        glPopAttrib();
        _extensions.glDeleteRenderbuffers(1, &_depth);
    }
    Pixel(const Pixel&) = delete;
    Pixel& operator=(const Pixel&) = delete;

    const ScratchFramebuffer framebuffer;

private:
    const osg::GLExtensions& _extensions;
    GLuint _depth = 0;
};

} // namespace

std::optional<glm::dvec2> ResolvedDepth::read(osg::State& state, GLint x, GLint y, GLsizei width, GLsizei height,
                                              const std::function<void()>& readOut) {
    const auto& extensions = *state.get<osg::GLExtensions>();
    const SavedFramebuffers bound(extensions);
    const GLenum format = depthFormat(extensions);
    if (!format || !extensions.glBlitFramebuffer || !extensions.glRenderbufferStorageMultisample) return std::nullopt;
    Buffers& own = of(state.getContextID());
    const GLint samples = glInteger(GL_SAMPLES);
    const bool known = own.format == format && own.samples == samples;
    if (!known || own.width < x + width || own.height < y + height) {
        own.format = format;
        own.samples = samples;
        fit(own, extensions, x + width, y + height);
    }
    const ScratchFramebuffer framebuffer(extensions);
    framebuffer.attachDepth(own.depth);
    if (!framebuffer.isComplete()) return std::nullopt;
    if (!known)
        own.place = {placeOnSlope(own, framebuffer.name, state, false),
                     placeOnSlope(own, framebuffer.name, state, true)};
    resolve(extensions, bound.draw, framebuffer.name, x, y, width, height);
    readOut();
    return own.place;
}

ResolvedDepth::Buffers& ResolvedDepth::of(unsigned context) {
    Lock lock(_mutex);
    return _buffers[context];
}

void ResolvedDepth::fit(Buffers& buffers, const osg::GLExtensions& extensions, GLsizei width, GLsizei height) {
    if (!buffers.depth) extensions.glGenRenderbuffers(1, &buffers.depth);
    buffers.width = std::max(buffers.width, width);
    buffers.height = std::max(buffers.height, height);
    extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffers.depth);
    extensions.glRenderbufferStorage(GL_RENDERBUFFER_EXT, buffers.format, buffers.width, buffers.height);
}

/// Over a pixel whose depth rises from 0 to 1, the resolved depth is the place.
double ResolvedDepth::placeOnSlope(const Buffers& buffers, GLuint into, osg::State& state, bool upwards) {
    const auto& extensions = *state.get<osg::GLExtensions>();
    const Pixel pixel(extensions, buffers.format, buffers.samples);
    drawQuad(state, 0.0, upwards ? 0.0 : 1.0, upwards ? 1.0 : 0.0);
    float place = 0.5f;
    resolve(extensions, pixel.framebuffer.name, into, 0, 0, 1, 1);
    glReadPixels(0, 0, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &place);
    return static_cast<double>(place);
}

bool ResolvedDepth::isNeeded(const osg::State& state) {
    return state.get<osg::GLExtensions>()->isFrameBufferObjectSupported && glInteger(GL_FRAMEBUFFER_BINDING_EXT) != 0 &&
           glInteger(GL_SAMPLES) > 0;
}

void ResolvedDepth::release(const osg::State* state) {
    Lock lock(_mutex);
    for (auto entry = _buffers.begin(); entry != _buffers.end();) {
        const bool meant = !state || state->getContextID() == entry->first;
        if (meant) letGo(entry->first, entry->second);
        entry = meant ? _buffers.erase(entry) : std::next(entry);
    }
}

void ResolvedDepth::letGo(unsigned context, const Buffers& buffers) {
    if (!buffers.depth) return;
    osg::get<osg::GLRenderBufferManager>(context)->scheduleGLObjectForDeletion(buffers.depth);
}

} // namespace gnomon
