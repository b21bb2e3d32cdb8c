// SPDX-License-Identifier: MIT
#include <gnomon/compositor/FoundEdges.h>
#include <gnomon/compositor/LightShares.h>
#include <gnomon/gl/FrameDepths.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <osg/ContextData>

#include <algorithm>
#include <optional>
#include <utility>

namespace gnomon {

void ShareTextures::fit(osg::State& state, std::size_t count, GLsizei width, GLsizei height) {
    const GLint format = glInteger(GL_ALPHA_BITS) > 8 ? GL_RGBA16 : GL_RGBA8;
    if (_names.size() >= count && _width >= width && _height >= height && format == _format) return;
    _format = format;
    _width = std::max(_width, width);
    _height = std::max(_height, height);
    _names.resize(std::max(_names.size(), count), 0);
    for (GLuint& name : _names) sizeTexture(state, name, _format, _width, _height);
}

void ShareTextures::deleteAllGLObjects() {
    glDeleteTextures(static_cast<GLsizei>(_names.size()), _names.data());
    discardAllGLObjects();
}

void ShareTextures::discardAllGLObjects() {
    _names.clear();
    _width = _height = 0;
}

LightShares::LightShares(const CompositorStage& draw, std::vector<Jobs> lights, unsigned bit)
    : _draw(draw), _lights(std::move(lights)), _textures(*osg::get<ShareTextures>(draw.state.getContextID())) {
    if (_lights.empty()) return;
    const PixelRect all = pixelsOf(*draw.stage.getViewport());
    _draw.pass(wholeScreen,
               [&](ScreenPass&) { _textures.fit(draw.state, _lights.size(), all.x + all.width, all.y + all.height); });
    for (std::size_t i = 0; i < _lights.size(); ++i) {
        begin(_lights[i], _textures[i]);
        for (const ShadowJob* job : _lights[i]) look(*job, bit, _textures[i]);
    }
}

/// All of it arrives.
void LightShares::begin(const Jobs& light, GLuint texture) const {
    _draw.pass(screenBoundsOf(light), [&](ScreenPass& screen) {
        const ScratchFramebuffer framebuffer(*_draw.state.get<osg::GLExtensions>());
        framebuffer.attachColor(texture);
        screen.setAlpha(1.0f);
    });
}

/// Depths are copied before the frame is no more what is drawn to.
void LightShares::look(const ShadowJob& job, unsigned bit, GLuint texture) const {
    const TrueDepths depths(_draw, job.mark->screenBounds);
    std::optional<FoundEdges> edges;
    if (job.findsEdges) edges.emplace(_draw, job, bit);
    _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
        const osg::Viewport& viewport = *_draw.stage.getViewport();
        const PixelRect pixels = pixelsInScissor(viewport);
        if (pixels.empty()) return;
        FrameDepths::hold(screen.state(), wholeQuads(pixels, viewport));
        if (!edges) job.mark->look(screen);
        const ScratchFramebuffer framebuffer(*_draw.state.get<osg::GLExtensions>());
        framebuffer.attachColor(texture);
        screen.ask(ScreenPass::Want::Arriving);
        screen.beginLeast();
        job.report(edges ? edges->draw(screen) : job.mark->draw(screen));
        screen.endMix();
    });
}

void LightShares::mark(const ShadowJob& job, unsigned bit) const {
    _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bit, 0, bit);
        glEnable(GL_ALPHA_TEST);
        glAlphaFunc(GL_LESS, 1.0f);
        screen.testDepth(GL_GREATER);
        drawTexture(job, screen);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_ALPHA_TEST);
    });
}

void LightShares::multiplyAlpha(const ShadowJob& job, bool blocked, ScreenPass& screen) const {
    screen.multiplyAlpha(blocked);
    drawTexture(job, screen);
}

/// At the far plane, texel on pixel.
void LightShares::drawTexture(const ShadowJob& job, ScreenPass& screen) const {
    const auto hasJob = [&job](const Jobs& light) {
        return std::find(light.begin(), light.end(), &job) != light.end();
    };
    const auto light = std::find_if(_lights.begin(), _lights.end(), hasJob);
    osg::State& state = screen.state();
    bindTexture(state, 0, _textures[static_cast<std::size_t>(light - _lights.begin())]);
    glEnable(GL_TEXTURE_2D);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    const PixelRect all = pixelsOf(*_draw.stage.getViewport());
    const glm::dvec2 size(_textures.width(), _textures.height());
    drawTexturedQuad(state, glm::dvec2(all.x, all.y) / size, glm::dvec2(all.x + all.width, all.y + all.height) / size,
                     1.0);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
    glDisable(GL_TEXTURE_2D);
    state.haveAppliedTextureAttribute(0, osg::StateAttribute::TEXENV);
    state.haveAppliedTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF);
}

} // namespace gnomon
