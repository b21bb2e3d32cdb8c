// SPDX-License-Identifier: MIT
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <osgUtil/StateGraph>

#include <algorithm>

namespace gnomon {
namespace {

/// The lowest bits, one beside the other from bit 0 on, for OpenGL counts from there; else any single one.
unsigned countersAmong(const std::vector<unsigned>& bits, std::size_t taken) {
    unsigned result = 0;
    for (std::size_t i = bits.size(); i-- > taken;) {
        if (bits[i] != result + 1) break;
        result |= bits[i];
    }
    return result || bits.size() <= taken ? result : bits.back();
}

} // namespace

CompositorStage::CompositorStage(osg::RenderInfo& info, osgUtil::RenderStage& of, DrawnStage drawn,
                                 MaterialHistory& kept)
    : renderInfo(info),
      state(*info.getState()),
      stage(of),
      leaves(std::move(drawn.leaves)),
      options(drawn.options),
      materials(kept),
      stencilIsZero(drawn.stencilIsZero),
      pattern(StencilPattern::read(state)),
      since(drawn.since) {
    GLint stencil = 0, alpha = 0;
    glGetIntegerv(GL_STENCIL_BITS, &stencil);
    glGetIntegerv(GL_ALPHA_BITS, &alpha);
    hasStencil = stencil > 0;
    hasAlpha = alpha > 0;
    for (int i = std::min(stencil, 8); i-- > 0;)
        if (!((options.reservedStencilBits | pattern.bit) & (1u << i))) bits.push_back(1u << i);
    const auto take = [this] {
        const unsigned bit = bits.front();
        bits.erase(bits.begin());
        return bit;
    };
    if (bits.size() > 2) vast = vastLeaves(leaves, *stage.getViewport());
    if (!vast.empty()) vastBit = take();
    if (since && !bits.empty()) hidingBit = take();
    counters = countersAmong(bits, drawn.bitsOfLights);
}

Channels CompositorStage::channels() const {
    if (_channels) return *_channels;
    _channels = writtenChannels(leaves);
    if (!_channels->red && !_channels->green && !_channels->blue) openBy(stage.getColorMask(), *_channels);
    return *_channels;
}

void CompositorStage::clear(unsigned stencil, const ScreenRect& bounds) const {
    pass(bounds, [stencil](ScreenPass& screen) { screen.clearStencil(stencil); });
}

void CompositorStage::clearLeftovers(unsigned stencil) const {
    if (!stencilIsZero) clear(stencil | counters, wholeScreen);
}

void popLeafState(osg::State& state, osgUtil::RenderLeaf*& previous) {
    if (!previous) return;
    osgUtil::StateGraph* pushed = previous->_parent ? previous->_parent->_parent : nullptr;
    const auto count = static_cast<unsigned>(osgUtil::StateGraph::numToPop(pushed));
    state.popStateSetStackToSize(static_cast<unsigned>(state.getStateSetStackSize()) - count);
    previous = nullptr;
}

void pushLeafState(osg::State& state, const osgUtil::RenderLeaf& leaf) {
    state.applyProjectionMatrix(leaf._projection.get());
    state.applyModelViewMatrix(leaf._modelview.get());
    osgUtil::StateGraph::moveStateGraph(state, nullptr, leaf._parent->_parent);
    state.apply(leaf._parent->getStateSet());
}

namespace {

/// True if a geometry shader chooses among the layers of what is drawn into. Rectangles, as marks are, go to the first alone.
bool isLayered(const osg::State& state) {
    constexpr GLenum layered = 0x8DA7; // GL_FRAMEBUFFER_ATTACHMENT_LAYERED
    if (state.get<osg::GLExtensions>()->glVersion < 3.2f || glInteger(GL_FRAMEBUFFER_BINDING_EXT) == 0) return false;
    const auto first = static_cast<GLenum>(glInteger(GL_DRAW_BUFFER));
    return first != GL_NONE && attachmentParameter(first, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE_EXT) == GL_TEXTURE &&
           attachmentParameter(first, layered);
}

} // namespace

std::string whyNeverComposed(const osg::State& state, const osgUtil::RenderStage& stage) {
    if (isCoreProfile(state)) return coreProfileRefused;
    if (isLayered(state))
        return "this framebuffer has layers, of which marks reach the first alone, so no layer has a shadow. Draw each "
               "layer "
               "by a camera of its own.";
    return stage.getClearDepth() < 1.0
               ? "this view's depth buffer is cleared to less than 1. Set the camera's clear depth to 1."
               : "";
}

std::string whyNotComposed(const CompositorStage& draw) {
    if (!draw.hasStencil)
        return "this framebuffer has no stencil bits, and OpenGL makes no framebuffer object that has. Ask for 8 with "
               "osg::DisplaySettings::setMinimumNumStencilBits(8) before the window is made, or give the camera a "
               "stencil attachment.";
    return draw.bits.empty()
               ? "every stencil bit is reserved. Leave at least one out of CompositorOptions::reservedStencilBits."
               : "";
}

} // namespace gnomon
