// SPDX-License-Identifier: MIT
#include <gnomon/ScreenPass.h>
#include <gnomon/gl/FrameDepths.h>
#include <gnomon/gl/GlState.h>

#include <osg/BlendEquation>
#include <osg/GLExtensions>
#include <osg/State>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

struct Interval {
    GLint first;
    GLsizei count;
};

/// Pixels whose centres lie in [low, high] of a side of the viewport, one more on either side against rounding.
Interval pixels(double low, double high, double start, double size) {
    const double first = std::max(0.0, std::floor((low + 1.0) / 2.0 * size) - 1.0);
    const double last = std::min(size, std::ceil((high + 1.0) / 2.0 * size) + 1.0);
    return {static_cast<GLint>(start + first), static_cast<GLsizei>(std::max(0.0, last - first))};
}

} // namespace

PixelRect pixelsWithin(const ScreenRect& bounds, const osg::Viewport& viewport) {
    const PixelRect all = pixelsOf(viewport);
    const Interval x = pixels(bounds.low.x, bounds.high.x, all.x, all.width);
    const Interval y = pixels(bounds.low.y, bounds.high.y, all.y, all.height);
    return {x.first, y.first, x.count, y.count};
}

ScreenPass::ScreenPass(osg::RenderInfo& renderInfo, const PixelRect& pixels, std::function<Channels()> written,
                       unsigned counters, const StencilPattern& pattern)
    : _renderInfo(renderInfo),
      _state(*renderInfo.getState()),
      _written(std::move(written)),
      _counters(counters),
      _pattern(pattern) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(pixels.x, pixels.y, pixels.width, pixels.height);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDepthMask(GL_FALSE);
    if (_pattern.bit) stencilEqual(0, 0, 0);
}

ScreenPass::~ScreenPass() {
    leaveDefaults(_state);
    if (_encodes) glDisable(framebufferSrgb); // osg::State, which knows it off, need not be told
}

void ScreenPass::ask(Want want, unsigned bit, float factor) {
    _wanted = want;
    _bit = bit;
    _factor = factor;
    if (want == Want::Factor)
        beginMultiplyByColor();
    else if (bit)
        stencilEqual(bit, 0, bit);
    else
        multiplyAlpha();
}

void ScreenPass::clearStencil(unsigned bits) {
    glStencilMask(bits);
    glClearStencil(0);
    glClear(GL_STENCIL_BUFFER_BIT);
}

void ScreenPass::stencilEqual(unsigned reference, unsigned test, unsigned write) {
    _pattern.test(test ? GL_EQUAL : GL_ALWAYS, reference, test);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilMask(write);
}

void ScreenPass::stencilAny(unsigned test) {
    _pattern.test(GL_NOTEQUAL, 0, test);
    glStencilMask(0);
}

void ScreenPass::takeStencil(unsigned test, unsigned bits) {
    stencilAny(test);
    glStencilOp(GL_KEEP, GL_ZERO, GL_ZERO);
    glStencilMask(bits);
}

void ScreenPass::count(unsigned bits, bool behind) {
    const GLenum single = (bits & (bits - 1)) == 0 ? GL_INVERT : GL_NONE;
    const auto& gl = *_state.get<osg::GLExtensions>();
    testDepth(GL_LESS);
    _pattern.test(GL_ALWAYS, 0, ~0u);
    for (const GLenum face : {GL_FRONT, GL_BACK}) {
        const bool up = (face == GL_BACK) == behind;
        const GLenum operation = single ? single : GLenum(up ? GL_INCR_WRAP : GL_DECR_WRAP);
        gl.glStencilOpSeparate(face, GL_KEEP, behind ? operation : GL_KEEP, behind ? GL_KEEP : operation);
    }
    glStencilMask(bits);
}

/// Source: W. Bilodeau and M. Songy; C. Everitt and M. Kilgard, "Practical and Robust Stenciled Shadow Volumes", 2002.
void ScreenPass::countHolding(unsigned bits) { count(bits, true); }

/// Source: T. Heidmann, "Real Shadows, Real Time", Iris Universe 18, 1991.
void ScreenPass::countEntered(unsigned bits) { count(bits, false); }

void ScreenPass::uncount(unsigned bits) {
    const bool single = (bits & (bits - 1)) == 0;
    testDepth(GL_LESS);
    _pattern.test(GL_NOTEQUAL, 0, bits);
    glStencilOp(GL_KEEP, GL_KEEP, single ? GL_INVERT : GL_DECR_WRAP);
    glStencilMask(bits);
}

void ScreenPass::takeCount(unsigned bits, unsigned mark) {
    testDepth(GL_GREATER);
    _pattern.test(GL_NOTEQUAL, mark & ~bits, bits);
    glStencilOp(GL_KEEP, GL_ZERO, GL_REPLACE);
    glStencilMask(bits | mark);
    drawQuad(1.0);
}

bool ScreenPass::isInterlaced() const { return _pattern.bit != 0; }

void ScreenPass::writeFarDepth() {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    drawQuad(1.0);
    FrameDepths::forget(_state);
}

void ScreenPass::beginReplace() {
    glDisable(GL_BLEND);
    openChannels(GL_TRUE);
}

void ScreenPass::writeColor(const osg::Vec4& color) {
    beginReplace();
    drawColor(color);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

void ScreenPass::beginBlend() {
    openChannels(GL_FALSE);
    addBlended(_state, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void ScreenPass::blendColor(const osg::Vec3& color, float opacity) {
    beginBlend();
    drawColor({color, opacity});
    glDisable(GL_BLEND);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

void ScreenPass::multiplyColor(float factor) {
    beginMultiply(factor);
    drawQuad();
}

void ScreenPass::beginMultiply(float factor) {
    openToMultiply();
    addBlended(_state, GL_ZERO, GL_CONSTANT_COLOR);
    _state.get<osg::GLExtensions>()->glBlendColor(factor, factor, factor, 1.0f);
}

void ScreenPass::beginMultiplyByColor() {
    openToMultiply();
    addBlended(_state, GL_ZERO, GL_SRC_COLOR);
}

void ScreenPass::beginMix(const osg::Vec3& kept) {
    const auto& gl = *_state.get<osg::GLExtensions>();
    openChannels(GL_TRUE);
    addBlended(_state, GL_ONE_MINUS_CONSTANT_COLOR, GL_CONSTANT_COLOR);
    gl.glBlendFuncSeparate(GL_ONE_MINUS_CONSTANT_COLOR, GL_CONSTANT_COLOR, GL_ONE, GL_ZERO);
    gl.glBlendColor(kept.x(), kept.y(), kept.z(), 0.0f);
}

void ScreenPass::beginAlpha() {
    glDisable(GL_BLEND);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
}

void ScreenPass::beginLeast() {
    addBlended(_state, GL_ONE, GL_ONE);
    _state.get<osg::GLExtensions>()->glBlendEquation(osg::BlendEquation::RGBA_MIN);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
}

void ScreenPass::beginMost() {
    addBlended(_state, GL_ONE, GL_ONE);
    _state.get<osg::GLExtensions>()->glBlendEquation(osg::BlendEquation::RGBA_MAX);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void ScreenPass::endMix() {
    glDisable(GL_BLEND);
    _state.get<osg::GLExtensions>()->glBlendEquation(GL_FUNC_ADD);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

void ScreenPass::setAlpha(float value) {
    glDisable(GL_BLEND);
    drawAlpha(value);
}

void ScreenPass::fadeAlpha(float factor) {
    addBlended(_state, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    drawAlpha(factor);
}

void ScreenPass::multiplyAlpha(bool byRest) {
    addBlended(_state, GL_ZERO, byRest ? GL_ONE_MINUS_SRC_ALPHA : GL_SRC_ALPHA);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
}

void ScreenPass::multiplyColorByAlpha() {
    addBlended(_state, GL_ZERO, GL_DST_ALPHA);
    openToMultiply();
    drawOverSurfaces();
}

/// Fewer than all in anaglyph stereo, for one.
void ScreenPass::openChannels(GLboolean alpha) const {
    const Channels channels = _written();
    glColorMask(channels.red, channels.green, channels.blue, alpha);
}

/// A factor is one of light: where the leaves' colours are encoded, what stands is decoded first.
void ScreenPass::openToMultiply() {
    openChannels(GL_FALSE);
    _encodes = _encodes || _written().encoded;
    if (_encodes) glEnable(framebufferSrgb);
}

void ScreenPass::drawColor(const osg::Vec4& color, bool overSurfaces) {
    GLfloat current[4];
    glGetFloatv(GL_CURRENT_COLOR, current);
    glColor4fv(color.ptr());
    overSurfaces ? drawOverSurfaces() : drawQuad();
    glColor4fv(current);
}

void ScreenPass::drawAlpha(float alpha) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
    drawColor({0.0f, 0.0f, 0.0f, alpha}, true);
}

void ScreenPass::drawOverSurfaces() {
    testDepth(GL_GREATER);
    drawQuad(1.0);
    glDisable(GL_DEPTH_TEST);
    glDisable(depthClamp);
}

void ScreenPass::testDepth(GLenum function, bool clamp) {
    glEnable(GL_DEPTH_TEST);
    clamp ? glEnable(depthClamp) : glDisable(depthClamp);
    glDepthFunc(function);
}

void ScreenPass::drawQuad(double atCenter, double slopeX, double slopeY) {
    gnomon::drawQuad(_state, atCenter, slopeX, slopeY);
}

} // namespace gnomon
