// SPDX-License-Identifier: MIT
#include <gnomon/compositor/CompositorTarget.h>
#include <gnomon/compositor/StencilMarks.h>
#include <gnomon/gl/GlState.h>

#include <algorithm>
#include <bitset>

namespace gnomon {
namespace {

/// Shaders look beyond the pixels that they draw: four by four are shaded together at most.
constexpr GLint shadedTogether = 4;

PixelRect inWholeBlocks(const PixelRect& pixels) {
    const auto down = [](GLint x) { return std::max(0, x - shadedTogether) / shadedTogether * shadedTogether; };
    const auto up = [](GLint x) { return (x + 2 * shadedTogether - 1) / shadedTogether * shadedTogether; };
    const GLint x = down(pixels.x), y = down(pixels.y);
    return {x, y, up(pixels.x + pixels.width) - x, up(pixels.y + pixels.height) - y};
}

/// Of the framebuffer that is bound, those that are free.
std::size_t freeStencilBits(unsigned taken) {
    const int bits = std::min(glInteger(GL_STENCIL_BITS), 8);
    return std::bitset<8>(((1u << bits) - 1u) & ~taken).count();
}

bool suffices(const TargetNeeds& needs) {
    return !needs.ownStencil && freeStencilBits(needs.reserved) >= needs.stencilBits &&
           (!needs.alpha || glInteger(GL_ALPHA_BITS) > 0);
}

} // namespace

TargetNeeds needsOf(const std::vector<ShadowJob>& jobs) {
    TargetNeeds needs;
    std::optional<ScreenRect> bounds;
    for (const ShadowJob& job : jobs) {
        if (job.programMark()) continue;
        needs.alpha = needs.alpha || job.fades();
        const ScreenRect& place = job.mark->hasDebugView ? wholeScreen : job.mark->screenBounds;
        bounds = bounds ? united(*bounds, place) : place;
    }
    if (bounds) needs.bounds = *bounds;
    needs.stencilBits = stencilBitsFor(jobs);
    return needs;
}

CompositorTarget::CompositorTarget(osg::State& state, const osg::Viewport& viewport, const TargetNeeds& needs)
    : _colors(state) {
    const bool interlaced = StencilPattern::read(state).bit != 0;
    if (!interlaced && !suffices(needs))
        _own.emplace(state, viewport, inWholeBlocks(pixelsWithin(needs.bounds, viewport)), needs.depth);
}

} // namespace gnomon
