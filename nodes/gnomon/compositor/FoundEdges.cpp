// SPDX-License-Identifier: MIT
#include <gnomon/compositor/FoundEdges.h>
#include <gnomon/gl/MarkEdges.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <osg/ContextData>

#include <algorithm>

namespace gnomon {
namespace {

void clearToZero() {
    GLfloat color[4];
    glGetFloatv(GL_COLOR_CLEAR_VALUE, color);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glStencilMask(~0u);
    glClearStencil(0);
    glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glClearColor(color[0], color[1], color[2], color[3]);
}

/// Into the texture that is bound.
void copyTarget(const osg::State& state, const PixelRect& pixels) {
    const PlainPixels plain(state);
    const ReadsTarget reads(*state.get<osg::GLExtensions>());
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, pixels.x, pixels.y, pixels.x, pixels.y, pixels.width, pixels.height);
}

} // namespace

void EdgeTextures::fit(osg::State& state, GLsizei width, GLsizei height) {
    if (_width >= width && _height >= height) return;
    _width = std::max(_width, width);
    _height = std::max(_height, height);
    for (GLuint& name : _names) sizeTexture(state, name, GL_RGBA8, _width, _height);
    const auto& gl = *state.get<osg::GLExtensions>();
    const SavedFramebuffers saved(gl); // and which renderbuffer is bound
    if (!_stencil) gl.glGenRenderbuffers(1, &_stencil);
    gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, _stencil);
    gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, GL_DEPTH24_STENCIL8_EXT, _width, _height);
}

void EdgeTextures::deleteAllGLObjects() {
    glDeleteTextures(2, _names);
    if (_stencil) osg::get<osg::GLExtensions>(_contextID)->glDeleteRenderbuffers(1, &_stencil);
    discardAllGLObjects();
}

void EdgeTextures::discardAllGLObjects() {
    _names[0] = _names[1] = _stencil = 0;
    _width = _height = 0;
}

bool canFindEdges(osg::State& state) {
    return glInteger(GL_SAMPLES) == 0 && StencilPattern::read(state).bit == 0 &&
           state.get<osg::GLExtensions>()->isFrameBufferObjectSupported;
}

/// By way of alpha, for no shader reads the stencil. Depths are copied before the frame is no more what is drawn to.
FoundEdges::FoundEdges(const CompositorStage& draw, const ShadowJob& job, unsigned bit)
    : _job(job), _textures(*osg::get<EdgeTextures>(draw.state.getContextID())) {
    const ScreenRect& bounds = job.mark->screenBounds;
    const osg::Viewport& viewport = *draw.stage.getViewport();
    const PixelRect all = pixelsOf(viewport);
    draw.pass(bounds, [&](ScreenPass& screen) {
        screen.ask(ScreenPass::Want::Blocked, bit);
        job.report(job.mark->draw(screen));
    });
    draw.pass(bounds, [&](ScreenPass& screen) {
        const PixelRect pixels = pixelsInScissor(viewport);
        if (pixels.empty()) return;
        FrameDepths::hold(draw.state, wholeQuads(pixels, viewport));
        _textures.fit(draw.state, all.x + all.width, all.y + all.height);
        screen.setAlpha(1.0f);
        screen.stencilAny(bit);
        screen.setAlpha(0.0f);
        bindTexture(draw.state, 0, _textures.marks());
        copyTarget(draw.state, pixels);
        screen.clearStencil(bit);
    });
    draw.pass(bounds, [&](ScreenPass& screen) {
        if (pixelsInScissor(viewport).empty()) return;
        const auto& gl = *draw.state.get<osg::GLExtensions>();
        const ScratchFramebuffer framebuffer(gl);
        framebuffer.attachColor(_textures.cuts());
        for (const GLenum attachment : {GL_DEPTH_ATTACHMENT_EXT, GL_STENCIL_ATTACHMENT_EXT})
            gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, attachment, GL_RENDERBUFFER_EXT, _textures.stencil());
        clearToZero();
        job.report(job.mark->edges()->find(screen, *job.mark, _textures.marks()));
    });
}

std::string FoundEdges::draw(ScreenPass& screen) const {
    return _job.mark->edges()->draw(screen, _textures.marks(), _textures.cuts());
}

} // namespace gnomon
