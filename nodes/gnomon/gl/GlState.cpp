// SPDX-License-Identifier: MIT
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <osg/GLExtensions>
#include <osg/State>

#include <algorithm>

namespace gnomon {

CleanState::CleanState(osg::State& state, osg::Viewport* viewport) : _state(state), _set(new osg::StateSet) {
    _set->setAttribute(viewport);
    _set->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    _state.pushStateSet(_set.get());
    _state.apply();
}

CleanState::~CleanState() { _state.popStateSet(); }

FirstColorBuffer::FirstColorBuffer(const osg::State& state) : _state(state) {
    constexpr GLenum maxDrawBuffers = 0x8824, drawBuffer = 0x8825; // GL_MAX_DRAW_BUFFERS, GL_DRAW_BUFFER0
    const bool mayBeObject = _state.get<osg::GLExtensions>()->isFrameBufferObjectSupported;
    if (!mayBeObject || glInteger(GL_FRAMEBUFFER_BINDING_EXT) == 0) return; // a window has one for each eye
    GLint most = 1;
    glGetIntegerv(maxDrawBuffers, &most);
    for (GLint i = most; i-- > 0;) {
        GLint buffer = GL_NONE;
        glGetIntegerv(drawBuffer + static_cast<GLenum>(i), &buffer);
        if (_all.empty() && (i == 0 || buffer == GL_NONE)) continue;
        _all.insert(_all.begin(), static_cast<GLenum>(buffer));
    }
    if (!_all.empty()) _state.get<osg::GLExtensions>()->glDrawBuffers(1, _all.data());
}

FirstColorBuffer::~FirstColorBuffer() {
    if (!_all.empty()) _state.get<osg::GLExtensions>()->glDrawBuffers(static_cast<GLsizei>(_all.size()), _all.data());
}

StencilPattern StencilPattern::read(osg::State& state) {
    state.apply(); // what is on now is on in spite of osg::State
    if (!glIsEnabled(GL_STENCIL_TEST)) return {};
    GLint function = 0, reference = 0;
    glGetIntegerv(GL_STENCIL_FUNC, &function);
    glGetIntegerv(GL_STENCIL_REF, &reference);
    if (reference != 0 || (function != GL_EQUAL && function != GL_NOTEQUAL)) return {};
    return {1u, function == GL_EQUAL ? 0u : 1u};
}

void StencilPattern::restore(osg::State& state) const {
    if (!bit) return;
    state.apply(); // or it would do away with it later
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(value ? GL_NOTEQUAL : GL_EQUAL, 0, ~0u);
}

void StencilPattern::test(GLenum function, unsigned reference, unsigned mask) const {
    glEnable(GL_STENCIL_TEST);
    if (bit && function == GL_ALWAYS)
        glStencilFunc(GL_EQUAL, static_cast<GLint>(reference | value), bit);
    else if (bit && function == GL_EQUAL)
        glStencilFunc(GL_EQUAL, static_cast<GLint>(reference | value), mask | bit);
    else
        glStencilFunc(function, static_cast<GLint>(reference), mask);
}

bool isCoreProfile(const osg::State& state) {
    constexpr GLenum profileMask = 0x9126;
    constexpr GLint core = 1;
    GLint profile = 0;
    if (state.get<osg::GLExtensions>()->glVersion >= 3.2f) glGetIntegerv(profileMask, &profile);
    return profile & core;
}

/// osg::State sets an attribute again only if it ever had one of its type: so OpenGL itself is set, too.
void leaveDefaults(osg::State& state) {
    using A = osg::StateAttribute;
    for (GLenum mode : {GLenum(GL_SCISSOR_TEST), GLenum(GL_STENCIL_TEST), GLenum(GL_DEPTH_TEST), GLenum(GL_BLEND),
                        GLenum(GL_ALPHA_TEST), depthClamp}) {
        glDisable(mode);
        state.haveAppliedMode(mode, A::OFF);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glAlphaFunc(GL_ALWAYS, 0.0f);
    glStencilFunc(GL_ALWAYS, 0, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilMask(~0u);
    glBlendFunc(GL_ONE, GL_ZERO);
    state.get<osg::GLExtensions>()->glBlendColor(0.0f, 0.0f, 0.0f, 0.0f);
    if (const osg::Viewport* viewport = state.getCurrentViewport()) { // as osgUtil::RenderStage leaves it
        const PixelRect all = pixelsOf(*viewport);
        glScissor(all.x, all.y, all.width, all.height);
    }
    for (A::Type type :
         {A::SCISSOR, A::STENCIL, A::BLENDFUNC, A::BLENDCOLOR, A::BLENDEQUATION, A::DEPTH, A::ALPHAFUNC, A::COLORMASK})
        state.haveAppliedAttribute(type);
}

void bindTexture(osg::State& state, unsigned unit, GLuint texture) {
    state.setActiveTextureUnit(unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    state.haveAppliedTextureAttribute(unit, osg::StateAttribute::TEXTURE);
    state.setActiveTextureUnit(0);
}

void sizeTexture(osg::State& state, GLuint& texture, GLint format, GLsizei width, GLsizei height) {
    if (!texture) glGenTextures(1, &texture);
    bindTexture(state, 0, texture);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
}

PixelRect pixelsInScissor(const osg::Viewport& viewport) {
    GLint box[4];
    glGetIntegerv(GL_SCISSOR_BOX, box);
    const PixelRect all = pixelsOf(viewport);
    const GLint left = std::max({0, box[0], all.x}), low = std::max({0, box[1], all.y});
    const GLint right = std::min(box[0] + box[2], all.x + all.width);
    const GLint high = std::min(box[1] + box[3], all.y + all.height);
    return {left, low, right - left, high - low};
}

PixelRect wholeQuads(const PixelRect& pixels, const osg::Viewport& viewport) {
    const PixelRect all = pixelsOf(viewport);
    const int endX = std::min((pixels.x + pixels.width + 1) & ~1, all.x + all.width),
              endY = std::min((pixels.y + pixels.height + 1) & ~1, all.y + all.height),
              x = std::max({pixels.x & ~1, all.x, 0}), y = std::max({pixels.y & ~1, all.y, 0});
    return {x, y, endX - x, endY - y};
}

void addBlended(const osg::State& state, GLenum source, GLenum destination) {
    glEnable(GL_BLEND);
    glBlendFunc(source, destination);
    state.get<osg::GLExtensions>()->glBlendEquation(GL_FUNC_ADD);
}

void drawQuad(osg::State& state, double atCenter, double slopeX, double slopeY) {
    state.applyProjectionMatrix(nullptr);
    state.applyModelViewMatrix(nullptr);
    glBegin(GL_TRIANGLE_STRIP);
    for (const double y : {-1.0, 1.0})
        for (const double x : {-1.0, 1.0}) glVertex3d(x, y, atCenter + x * slopeX + y * slopeY);
    glEnd();
}

void drawTexturedQuad(osg::State& state, const glm::dvec2& low, const glm::dvec2& high, double depth) {
    state.applyProjectionMatrix(nullptr);
    state.applyModelViewMatrix(nullptr);
    glBegin(GL_TRIANGLE_STRIP);
    for (const int y : {0, 1})
        for (const int x : {0, 1}) {
            glTexCoord2d(x ? high.x : low.x, y ? high.y : low.y);
            glVertex3d(2 * x - 1, 2 * y - 1, depth);
        }
    glEnd();
}

void drawPolygon(osg::State& state, const std::vector<glm::dvec2>& corners, double depth) {
    if (corners.empty()) return drawQuad(state, depth);
    state.applyProjectionMatrix(nullptr);
    state.applyModelViewMatrix(nullptr);
    glBegin(GL_TRIANGLE_FAN);
    for (const glm::dvec2& corner : corners) glVertex3d(corner.x, corner.y, depth);
    glEnd();
}

} // namespace gnomon
