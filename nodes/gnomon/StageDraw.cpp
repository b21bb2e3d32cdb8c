// SPDX-License-Identifier: MIT
#include <gnomon/ShadowBin.h>
#include <gnomon/StageDraw.h>

#include <algorithm>

namespace gnomon {
namespace {

/// Three lights, a scratch bit, and one for lights that fade are the compositor's own.
constexpr std::size_t ownBits = 5;

/// The lowest bits, one beside the other from bit 0 on, for OpenGL counts from there; else any single one.
unsigned countersAmong(const std::vector<unsigned>& bits) {
    unsigned result = 0;
    for (std::size_t i = bits.size(); i-- > ownBits;) {
        if (bits[i] != result + 1) break;
        result |= bits[i];
    }
    return result || bits.size() <= ownBits ? result : bits.back();
}

} // namespace

StageDraw::StageDraw(osg::RenderInfo& info, osgUtil::RenderStage& drawn, std::vector<StageLeaf> before, bool isClean,
                     bool counts)
    : renderInfo(info), state(*info.getState()), stage(drawn), leaves(std::move(before)), clean(isClean) {
    GLint stencil = 0, alpha = 0;
    glGetIntegerv(GL_STENCIL_BITS, &stencil);
    glGetIntegerv(GL_ALPHA_BITS, &alpha);
    hasStencil = stencil > 0;
    hasAlpha = alpha > 0;
    for (int i = std::min(stencil, 8); i-- > 0;)
        if (!(ShadowBin::reserved() & (1u << i))) bits.push_back(1u << i);
    if (counts) counters = countersAmong(bits);
}

void StageDraw::clear(unsigned stencil, const ScreenRect& bounds) const {
    pass(bounds, [stencil](ScreenPass& screen) { screen.clearStencil(stencil); });
}

void StageDraw::clearLeftovers(unsigned stencil) const {
    if (!clean) clear(stencil | counters, {{-1.0, -1.0}, {1.0, 1.0}});
}

std::string whyNotComposed(const StageDraw& draw) {
    if (!draw.hasStencil)
        return "finds no stencil bits in this framebuffer: ask for 8, by "
               "osg::DisplaySettings::setMinimumNumStencilBits(8) before the window is made or by a stencil attachment "
               "of the camera.";
    if (draw.stage.getClearDepth() < 1.0)
        return "does not know this view's depth buffer, which is cleared to less than 1: clear it to 1.";
    return draw.bits.empty() ? "finds every stencil bit reserved: leave one to ShadowBin::reserve()." : "";
}

} // namespace gnomon
