// SPDX-License-Identifier: MIT
#include <gnomon/StageDraw.h>

#include <osgUtil/StateGraph>

#include <algorithm>

namespace gnomon {
namespace {

/// The lowest bits, one beside the other from bit 0 on, for OpenGL counts from there; else any single one.
unsigned countersAmong(const std::vector<unsigned>& bits, std::size_t own) {
    unsigned result = 0;
    for (std::size_t i = bits.size(); i-- > own;) {
        if (bits[i] != result + 1) break;
        result |= bits[i];
    }
    return result || bits.size() <= own ? result : bits.back();
}

} // namespace

StageDraw::StageDraw(osg::RenderInfo& info, osgUtil::RenderStage& drawn, std::vector<StageLeaf> before,
                     const CompositorOptions& asked, bool isClean, std::size_t ownBits)
    : renderInfo(info),
      state(*info.getState()),
      stage(drawn),
      leaves(std::move(before)),
      options(asked),
      clean(isClean),
      own(ownBits) {
    GLint stencil = 0, alpha = 0;
    glGetIntegerv(GL_STENCIL_BITS, &stencil);
    glGetIntegerv(GL_ALPHA_BITS, &alpha);
    hasStencil = stencil > 0;
    hasAlpha = alpha > 0;
    for (int i = std::min(stencil, 8); i-- > 0;)
        if (!(options.reservedStencilBits & (1u << i))) bits.push_back(1u << i);
    counters = countersAmong(bits, own);
}

Channels StageDraw::channels() const {
    if (!_channels) _channels = writtenChannels(leaves);
    return *_channels;
}

void StageDraw::clear(unsigned stencil, const ScreenRect& bounds) const {
    pass(bounds, [stencil](ScreenPass& screen) { screen.clearStencil(stencil); });
}

void StageDraw::clearLeftovers(unsigned stencil) const {
    if (!clean) clear(stencil | counters, wholeScreen);
}

void popLeafState(osg::State& state, osgUtil::RenderLeaf*& previous) {
    if (!previous) return;
    osgUtil::StateGraph* pushed = previous->_parent ? previous->_parent->_parent : nullptr;
    const auto count = static_cast<unsigned>(osgUtil::StateGraph::numToPop(pushed));
    state.popStateSetStackToSize(static_cast<unsigned>(state.getStateSetStackSize()) - count);
    previous = nullptr;
}

std::string whyNotComposed(const StageDraw& draw) {
    if (!draw.hasStencil)
        return "finds no stencil bits in this framebuffer: ask for 8, by "
               "osg::DisplaySettings::setMinimumNumStencilBits(8) before the window is made or by a stencil attachment "
               "of the camera.";
    if (draw.stage.getClearDepth() < 1.0)
        return "does not know this view's depth buffer, which is cleared to less than 1: clear it to 1.";
    return draw.bits.empty() ? "finds every stencil bit reserved: leave one to CompositorOptions::reservedStencilBits."
                             : "";
}

} // namespace gnomon
