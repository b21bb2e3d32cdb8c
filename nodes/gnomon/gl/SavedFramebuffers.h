// SPDX-License-Identifier: MIT
#pragma once
#include <osg/FrameBufferObject>
#include <osg/GLExtensions>

namespace gnomon {

inline GLint glInteger(GLenum what) {
    GLint value = 0;
    glGetIntegerv(what, &value);
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

} // namespace gnomon
