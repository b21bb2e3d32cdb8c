// SPDX-License-Identifier: MIT
#include <gnomon/compositor/CompositorTarget.h>
#include <gnomon/compositor/StencilMarks.h>
#include <gnomon/gl/GlState.h>

#include <algorithm>
#include <bitset>
#include <set>

namespace gnomon {
namespace {

/// Shaders look beyond the pixels that they draw: four by four are shaded together at most.
constexpr GLint shadedTogether = 4;

constexpr int blended = -1; // no light: all that blends shares a bit

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

/// A bit a relit light, and one for all that blends; one more where marks are put together; marks that fade take two of those.
TargetNeeds needsOf(const std::vector<ShadowJob>& jobs) {
    TargetNeeds needs;
    std::set<int> lights;
    bool together = false;
    std::optional<ScreenRect> bounds;
    for (const ShadowJob& job : jobs) {
        if (job.programMark()) continue;
        const bool known = !lights.insert(job.relight ? job.light : blended).second;
        together = together || known || job.receiverNamed;
        needs.alpha = needs.alpha || job.fades();
        const ScreenRect& place = job.mark->hasDebugView ? wholeScreen : job.mark->screenBounds;
        bounds = bounds ? united(*bounds, place) : place;
    }
    if (bounds) needs.bounds = *bounds;
    needs.stencilBits = std::clamp<std::size_t>(lights.size(), 1, mostRelitLights) + (needs.alpha ? 2 : together);
    return needs;
}

CompositorTarget::CompositorTarget(osg::State& state, const osg::Viewport& viewport, const TargetNeeds& needs)
    : _colors(state) {
    const bool interlaced = StencilPattern::read(state).bit != 0;
    if (!interlaced && !suffices(needs))
        _own.emplace(state, viewport, inWholeBlocks(pixelsWithin(needs.bounds, viewport)));
}

} // namespace gnomon
