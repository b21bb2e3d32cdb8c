// SPDX-License-Identifier: MIT
#pragma once
#include <osg/FrameBufferObject>
#include <osg/GLExtensions>
#include <osg/State>
#include <osg/Texture>

namespace gnomon {

inline GLint glInteger(GLenum what) {
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

/// Of an attachment of the framebuffer that is bound for drawing; 0 if OpenGL cannot tell.
inline GLint attachmentParameter(GLenum attachment, GLenum what) {
    using Ask = void (*)(GLenum, GLenum, GLenum, GLint*);
    static const Ask ask = [] {
        Ask found = nullptr;
        osg::setGLExtensionFuncPtr(found, "glGetFramebufferAttachmentParameteriv",
                                   "glGetFramebufferAttachmentParameterivEXT");
        return found;
    }();
    GLint value = 0;
    if (ask) ask(GL_FRAMEBUFFER_EXT, attachment, what, &value);
    return value;
}

/// Puts framebuffers and the renderbuffer that are bound back at its end.
class SavedFramebuffers {
public:
    explicit SavedFramebuffers(const osg::GLExtensions& extensions) : _extensions(extensions) {}
    ~SavedFramebuffers() {
        _extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, _renderbuffer);
        _extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, _read);
        _extensions.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, draw);
    }
    SavedFramebuffers(const SavedFramebuffers&) = delete;
    SavedFramebuffers& operator=(const SavedFramebuffers&) = delete;

    const GLuint draw = bound(GL_FRAMEBUFFER_BINDING_EXT);

private:
    static GLuint bound(GLenum what) { return static_cast<GLuint>(glInteger(what)); }

    const osg::GLExtensions& _extensions;
    const GLuint _read = bound(GL_READ_FRAMEBUFFER_BINDING_EXT);
    const GLuint _renderbuffer = bound(GL_RENDERBUFFER_BINDING_EXT);
};

/// A framebuffer object that is bound while it lives, and gone at its end; then what was bound before is so again.
///
/// None is kept: contexts that share textures and buffers, and OSG's ID of a context, share no framebuffer objects.
class ScratchFramebuffer {
public:
    explicit ScratchFramebuffer(const osg::GLExtensions& extensions)
        : _bound(extensions), _extensions(extensions), name(make(extensions)) {
        bind();
    }
    ~ScratchFramebuffer() { _extensions.glDeleteFramebuffers(1, &name); }
    ScratchFramebuffer(const ScratchFramebuffer&) = delete;
    ScratchFramebuffer& operator=(const ScratchFramebuffer&) = delete;

    /// For drawing and reading.
    void bind() const { _extensions.glBindFramebuffer(GL_FRAMEBUFFER_EXT, name); }
    /// While it is bound: has depths alone.
    void attachDepth(const osg::Texture::TextureObject& texture) const {
        _extensions.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, GL_DEPTH_ATTACHMENT_EXT, GL_TEXTURE_2D, texture.id(), 0);
        useNoColors();
    }
    void attachDepth(GLuint renderbuffer) const {
        _extensions.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, GL_DEPTH_ATTACHMENT_EXT, GL_RENDERBUFFER_EXT,
                                              renderbuffer);
        useNoColors();
    }
    void attachColor(GLuint texture) const {
        _extensions.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, texture, 0);
    }
    bool isComplete() const {
        return _extensions.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) == GL_FRAMEBUFFER_COMPLETE_EXT;
    }

private:
    static GLuint make(const osg::GLExtensions& extensions) {
        GLuint made = 0;
        extensions.glGenFramebuffers(1, &made);
        return made;
    }
    static void useNoColors() {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    }

    const SavedFramebuffers _bound;
    const osg::GLExtensions& _extensions;

public:
    const GLuint name;
};

/// While it lives, what is drawn to is what is read.
class ReadsTarget {
public:
    explicit ReadsTarget(const osg::GLExtensions& extensions) : _bound(extensions) {
        extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, _bound.draw);
        _before = static_cast<GLenum>(glInteger(GL_READ_BUFFER));
        const auto drawn = static_cast<GLenum>(glInteger(GL_DRAW_BUFFER));
        glReadBuffer(drawn == GL_FRONT_AND_BACK ? GLenum(GL_BACK) : drawn);
    }
    ~ReadsTarget() { glReadBuffer(_before); }
    ReadsTarget(const ReadsTarget&) = delete;
    ReadsTarget& operator=(const ReadsTarget&) = delete;

private:
    const SavedFramebuffers _bound;
    GLenum _before = GL_NONE;
};

/// While it lives, pixels go to and come from memory as they are, without gaps.
class PlainPixels {
public:
    explicit PlainPixels(const osg::State& state) : _extensions(*state.get<osg::GLExtensions>()) {
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPushAttrib(GL_CURRENT_BIT | GL_PIXEL_MODE_BIT);
        for (GLenum size : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SWAP_BYTES,
                            GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS, GL_UNPACK_LSB_FIRST})
            glPixelStorei(size, 0);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glPixelTransferf(GL_DEPTH_SCALE, 1.0f);
        glPixelTransferf(GL_DEPTH_BIAS, 0.0f);
        glPixelTransferf(GL_ALPHA_SCALE, 1.0f);
        glPixelTransferf(GL_ALPHA_BIAS, 0.0f);
        glPixelZoom(1.0f, 1.0f);
        if (!_extensions.isPBOSupported) return;
        for (GLenum buffer : {GL_PIXEL_PACK_BUFFER_ARB, GL_PIXEL_UNPACK_BUFFER_ARB})
            _extensions.glBindBuffer(buffer, 0);
    }
    ~PlainPixels() {
        glPopAttrib();
        glPopClientAttrib();
    }
    PlainPixels(const PlainPixels&) = delete;
    PlainPixels& operator=(const PlainPixels&) = delete;

private:
    const osg::GLExtensions& _extensions;
};

} // namespace gnomon
