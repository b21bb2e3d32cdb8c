// SPDX-License-Identifier: MIT
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/StencilMarks.h>

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

ScreenRect boundsOf(const Jobs& jobs) {
    ScreenRect all = jobs.front()->marks->screenBounds;
    for (const ShadowJob* job : jobs) all = united(all, job->marks->screenBounds);
    return all;
}

std::vector<LightUniform> lightUniformsOf(const Jobs& jobs) {
    std::vector<LightUniform> all;
    for (const ShadowJob* job : jobs) all.insert(all.end(), job->lightUniforms.begin(), job->lightUniforms.end());
    return all;
}

void writeWhereSeen(const CompositorStage& draw, const std::vector<ReplayedLeaf>& leaves, unsigned reference,
                    unsigned write, const ScreenRect& bounds) {
    OpaqueTest opaque;
    for (const bool equal : {false, true}) {
        LeafReplay::Overlay overlay;
        overlay.reference = reference;
        overlay.write = write;
        overlay.color = LeafReplay::Color::None;
        overlay.equalDepth = equal;
        overlay.keepDepth = true;
        overlay.bounds = bounds;
        LeafReplay replay(draw, overlay);
        for (const ReplayedLeaf& leaf : leaves)
            if (opaque(*leaf.entry.leaf) == equal) replay.draw(leaf.entry);
    }
}

TrueDepths::TrueDepths(const CompositorStage& draw, const ScreenRect& bounds) : _draw(draw), _bounds(bounds) {
    if (_draw.vast.empty()) return;
    const unsigned bit = _draw.vastBit;
    if (!_draw.clean) _draw.clear(bit, _bounds);
    std::vector<ReplayedLeaf> leaves;
    for (const VastLeaf& leaf : _draw.vast) leaves.push_back({leaf.entry, 0});
    writeWhereSeen(_draw, leaves, bit, bit, _bounds);
    _draw.pass(_bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bit, bit, 0);
        screen.writeFarDepth();
        for (const VastLeaf& leaf : _draw.vast) {
            const DepthPlacement placement = depthPlacementOf(leaf.entry.leaf->_parent);
            const osg::Vec2d offset = polygonOffsetOf(leaf.entry.leaf->_parent);
            screen.writeDepths(leaf.corners, {placement.nearest, placement.farthest}, {offset.x(), offset.y()});
        }
    });
}

/// The leaf alone, as it was drawn: it was what one saw there.
TrueDepths::~TrueDepths() {
    if (_draw.vast.empty()) return;
    const unsigned bit = _draw.vastBit;
    _draw.pass(_bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bit, bit, 0);
        screen.writeFarDepth();
    });
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = overlay.test = bit;
    overlay.color = LeafReplay::Color::None;
    overlay.bounds = _bounds;
    {
        LeafReplay replay(_draw, overlay);
        for (const VastLeaf& leaf : _draw.vast) replay.draw(leaf.entry);
    }
    _draw.clear(bit, _bounds);
}

/// The first job of a light without a named receiver marks its bit directly; any other goes through the scratch bit.
void StencilMarks::add(const ShadowJob& job, unsigned bit, bool fresh, Soft soft) const {
    if (fresh && !job.receiverNamed) return addUngated(job, bit, soft);
    if (!_scratch) {
        job.report("a named receiver, or a second technique for the same light, needs two stencil bits, but "
                   "only one is left. Leave at least two out of CompositorOptions::reservedStencilBits.");
        return;
    }
    addUngated(job, _scratch, soft);
    if (job.receiverNamed)
        gate(job, bit);
    else
        transfer(job, bit);
    _draw.clear(_scratch, job.marks->screenBounds);
}

void StencilMarks::addUngated(const ShadowJob& job, unsigned bit, Soft soft) const {
    const TrueDepths depths(_draw, job.marks->screenBounds);
    _draw.pass(job.marks->screenBounds, [&](ScreenPass& screen) {
        const bool touched = soft != Soft::Half && job.fades();
        if (touched && soft == Soft::Weighed) screen.multiplyAlpha();
        screen.ask(touched ? ScreenPass::Want::Touched : ScreenPass::Want::Blocked, bit);
        job.report(job.marks->draw(screen));
    });
}

/// Hands marks on where the receiver is what one sees: its own leaves, drawn again, pass only at the depth that stands.
void StencilMarks::gate(const ShadowJob& job, unsigned bit) const {
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = _scratch | bit;
    overlay.test = _scratch;
    overlay.write = bit;
    overlay.equalDepth = true;
    overlay.color = LeafReplay::Color::None;
    overlay.hidingOnly = job.hidingOnly;
    overlay.bounds = job.marks->screenBounds;
    overlay.marks = job.marks.get();
    LeafReplay replay(_draw, overlay);
    TouchTest touches(job.marks->screenBounds);
    for (const DrawnLeaf& entry : _draw.leaves)
        if (job.isNamed(entry.leaf) && touches(*entry.leaf)) replay.draw(entry);
}

void StencilMarks::transfer(const ShadowJob& job, unsigned bit) const {
    _draw.pass(job.marks->screenBounds, [&](ScreenPass& screen) {
        screen.stencilEqual(_scratch | bit, _scratch, bit);
        screen.drawQuad();
    });
}

/// A bit a relit light, and one for all that blends; one more where marks are put together; soft edges take two of those.
TargetNeeds needsOf(const std::vector<ShadowJob>& jobs) {
    TargetNeeds needs;
    std::set<int> lights;
    bool together = false;
    std::optional<ScreenRect> bounds;
    for (const ShadowJob& job : jobs) {
        if (job.programMarks()) continue;
        const bool known = !lights.insert(job.relight ? job.light : blended).second;
        together = together || known || job.receiverNamed;
        needs.alpha = needs.alpha || job.fades();
        const ScreenRect& place = job.marks->hasView() ? wholeScreen : job.marks->screenBounds;
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
