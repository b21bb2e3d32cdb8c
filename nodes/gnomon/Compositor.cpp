// SPDX-License-Identifier: MIT
#include <gnomon/Compositor.h>
#include <gnomon/ReplayFilter.h>

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::size_t mostRelitLights = 3;

ScreenRect boundsOf(const std::vector<const ShadowJob*>& jobs) {
    ScreenRect all = jobs.front()->marks->screenBounds;
    for (const ShadowJob* job : jobs) all = united(all, job->marks->screenBounds);
    return all;
}

/// Bits of the stencil buffer that are there and not reserved, the highest first.
std::vector<unsigned> freeBits(unsigned count, unsigned reserved) {
    std::vector<unsigned> bits;
    for (unsigned i = std::min(count, 8u); i-- > 0;)
        if (!(reserved & (1u << i))) bits.push_back(1u << i);
    return bits;
}

/// Its own name or that of the nearest named node above it, else its class.
std::string nameOf(const osg::Node& node) {
    for (const osg::Node* above = &node; above; above = above->getNumParents() ? above->getParent(0) : nullptr)
        if (!above->getName().empty()) return above->getName();
    return node.className();
}

} // namespace

Compositor::Compositor(osg::RenderInfo& renderInfo, osgUtil::RenderStage& stage, std::vector<StageLeaf> leaves,
                       bool clean)
    : _renderInfo(renderInfo),
      _state(*renderInfo.getState()),
      _stage(stage),
      _leaves(std::move(leaves)),
      _clean(clean) {
    GLint count = 0;
    glGetIntegerv(GL_STENCIL_BITS, &count);
    _stencilBits = static_cast<unsigned>(std::max(count, 0));
    std::vector<unsigned> bits = freeBits(_stencilBits, ShadowBin::reserved());
    if (bits.size() > 1) {
        const auto scratch = bits.begin() + static_cast<std::ptrdiff_t>(std::min(bits.size() - 1, mostRelitLights));
        _bits.scratch = *scratch;
        bits.erase(scratch);
    }
    bits.resize(std::min(bits.size(), mostRelitLights));
    _bits.lights = bits;
}

void Compositor::compose(const std::vector<ShadowJob>& jobs) {
    Jobs relit;
    std::map<float, Jobs> blended;
    for (const ShadowJob& job : jobs) {
        if (!canMark(job)) continue;
        if (job.composite == ShadowCasterGroup::RELIGHT)
            relit.push_back(&job);
        else if (job.dark < 1.0f) // a factor of 1 changes nothing
            blended[job.dark].push_back(&job);
    }
    if (!relit.empty() && !composeDirectly(relit)) {
        if (isModeOn(_leaves, GL_STENCIL_TEST))
            blendInstead(relit, blended);
        else
            relight(relit);
    }
    for (const auto& [dark, group] : blended)
        if (!composeDirectly(group)) blend(group, dark);
}

/// A leaf with a stencil test of its own cannot be drawn again under ours.
void Compositor::blendInstead(const Jobs& jobs, std::map<float, Jobs>& blended) {
    for (const ShadowJob* job : jobs) {
        if (job->dark < 1.0f) blended[job->dark].push_back(job);
        job->technique->report(job->frameNumber,
                               "blends instead of relighting, for something opaque in this view has a stencil test of "
                               "its own: draw that in a bin above 8, or set BLEND.");
    }
}

bool Compositor::canMark(const ShadowJob& job) const {
    const char* cause = nullptr;
    if (_stencilBits == 0)
        cause =
            "finds no stencil bits in this framebuffer: ask for 8, by "
            "osg::DisplaySettings::setMinimumNumStencilBits(8) before the window is made or by a stencil attachment "
            "of the camera.";
    else if (_bits.lights.empty())
        cause = "finds every stencil bit reserved: leave one to ShadowBin::reserve().";
    if (cause) job.technique->report(job.frameNumber, cause);
    return !cause;
}

/// The short way for a single job: the leaves of its named receiver are drawn again at the depth that stands, and take
/// the light away themselves. Possible unless some other leaf shows on a relit receiver.
bool Compositor::composeDirectly(const Jobs& jobs) {
    const ShadowJob& job = *jobs.front();
    if (jobs.size() > 1 || !job.receiverNamed) return false;
    const bool relit = job.composite == ShadowCasterGroup::RELIGHT;
    const ScreenRect& bounds = job.marks->screenBounds;
    std::vector<ReplayedLeaf> leaves = leavesToReplay(_leaves, jobs, bounds, ShadowBin::getFilter());
    PlainTest plain;
    const auto other = [&job](const ReplayedLeaf& leaf) { return job.receivers.count(leaf.entry.leaf) == 0; };
    const auto unfit = [&](const ReplayedLeaf& leaf) { return other(leaf) || !plain(*leaf.entry.leaf); };
    if (relit && std::any_of(leaves.begin(), leaves.end(), unfit)) return false;
    leaves.erase(std::remove_if(leaves.begin(), leaves.end(), other), leaves.end());
    const unsigned bit = _bits.lights.front();
    if (!_clean) clear(bit, bounds);
    markInto(job, bit);
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_NOTEQUAL;
    overlay.test = overlay.write = bit; // back to 0 where drawn: a pixel loses its light once
    overlay.equalDepth = true;
    overlay.factor = relit ? 1.0f : job.dark;
    if (!relit)
        for (ReplayedLeaf& leaf : leaves) leaf.dark = 0;
    replay(leaves, overlay, jobs);
    clear(bit, bounds);
    return true;
}

void Compositor::relight(const Jobs& wanted) {
    const std::map<int, unsigned> bitOf = assignBits(wanted);
    Jobs jobs;
    std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(jobs),
                 [&bitOf](const ShadowJob* job) { return bitOf.count(job->light) > 0; });
    unsigned lightBits = 0;
    for (const auto& entry : bitOf) lightBits |= entry.second;
    const ScreenRect bounds = boundsOf(jobs);
    mark(jobs, bitOf);
    resetMarked(lightBits, bounds);
    for (unsigned subset = 1; subset < (1u << bitOf.size()); ++subset) {
        const Combination combination = combine(jobs, bitOf, subset);
        if (overlap(combination.bounds, combination.bounds)) replay(combination, lightBits);
    }
    clear(lightBits, bounds);
}

std::map<int, unsigned> Compositor::assignBits(const Jobs& jobs) const {
    std::map<int, unsigned> bitOf;
    for (const ShadowJob* job : jobs) {
        if (bitOf.count(job->light)) continue;
        const std::size_t used = bitOf.size();
        if (used < _bits.lights.size())
            bitOf[job->light] = _bits.lights[used];
        else
            job->technique->report(job->frameNumber, "leaves light " + std::to_string(job->light) +
                                                         " unshadowed: at most " + std::to_string(used) +
                                                         " lights can be relit here; blend takes any number.");
    }
    return bitOf;
}

Compositor::Combination Compositor::combine(const Jobs& jobs, const std::map<int, unsigned>& bitOf,
                                            unsigned subset) const {
    Combination combination{0, {}, {{-1.0, -1.0}, {1.0, 1.0}}};
    unsigned index = 0;
    for (const auto& [number, bit] : bitOf) {
        if (!(subset & (1u << index++))) continue;
        Jobs ofLight;
        std::copy_if(jobs.begin(), jobs.end(), std::back_inserter(ofLight),
                     [light = number](const ShadowJob* job) { return job->light == light; });
        combination.bits |= bit;
        combination.bounds = common(combination.bounds, boundsOf(ofLight));
        combination.jobs.insert(combination.jobs.end(), ofLight.begin(), ofLight.end());
    }
    return combination;
}

void Compositor::replay(const Combination& combination, unsigned lightBits) {
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = combination.bits;
    overlay.test = lightBits;
    replay(leavesToReplay(_leaves, combination.jobs, combination.bounds, ShadowBin::getFilter()), overlay,
           combination.jobs);
}

void Compositor::replay(const std::vector<ReplayedLeaf>& leaves, LeafReplay::Overlay overlay, const Jobs& jobs) {
    overlay.unlit = jobs.front()->dark;
    LeafReplay replay(_renderInfo, overlay);
    for (const ReplayedLeaf& leaf : leaves) replay.draw(leaf.entry, leaf.dark);
    for (const osgUtil::RenderLeaf* leaf : replay.notRelit())
        for (const ShadowJob* job : jobs)
            job->technique->report(job->frameNumber,
                                   "cannot take a light from '" + nameOf(*leaf->_drawable) +
                                       "', which is unlit or whose program reads no gl_LightSource: it is drawn in its "
                                       "own colour times setDark(); light it by OpenGL, or do not let it receive.");
}

void Compositor::blend(const Jobs& jobs, float dark) {
    const unsigned bit = _bits.lights.front();
    const ScreenRect bounds = boundsOf(jobs);
    std::map<int, unsigned> bitOf;
    for (const ShadowJob* job : jobs) bitOf[job->light] = bit;
    mark(jobs, bitOf);
    CleanState clean(_state, _stage.getViewport());
    ScreenPass pass(_state, *_stage.getViewport(), bounds);
    pass.takeStencil(bit);
    pass.multiplyColor(dark, writtenChannels(_leaves));
}

void Compositor::mark(const Jobs& jobs, const std::map<int, unsigned>& bitOf) {
    unsigned used = _bits.scratch;
    for (const auto& entry : bitOf) used |= entry.second;
    if (!_clean) clear(used, boundsOf(jobs));
    unsigned marked = 0;
    for (const ShadowJob* job : jobs) {
        const unsigned bit = bitOf.at(job->light);
        markOne(*job, bit, !(marked & bit));
        marked |= bit;
    }
}

/// The first job of a light without a named receiver marks its bit directly; any other goes through the scratch bit.
void Compositor::markOne(const ShadowJob& job, unsigned bit, bool fresh) {
    const bool direct = fresh && !job.receiverNamed;
    if (!direct && !_bits.scratch) {
        job.technique->report(job.frameNumber,
                              "needs a second stencil bit for its named receiver or beside another technique of its "
                              "light: leave two to ShadowBin::reserve().");
        return;
    }
    markInto(job, direct ? bit : _bits.scratch);
    if (direct) return;
    if (job.receiverNamed)
        gate(job, bit);
    else
        transfer(job, bit);
    clear(_bits.scratch, job.marks->screenBounds);
}

void Compositor::markInto(const ShadowJob& job, unsigned bit) {
    CleanState clean(_state, _stage.getViewport());
    ScreenPass pass(_state, *_stage.getViewport(), job.marks->screenBounds);
    const std::string cause = job.marks->mark(_renderInfo, pass, bit);
    if (!cause.empty()) job.technique->report(job.frameNumber, cause);
}

/// Hands marks on where the receiver is what one sees: its own leaves, drawn again, pass only at the depth that stands.
void Compositor::gate(const ShadowJob& job, unsigned bit) {
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = _bits.scratch | bit;
    overlay.test = _bits.scratch;
    overlay.write = bit;
    overlay.equalDepth = true;
    overlay.color = false;
    LeafReplay replay(_renderInfo, overlay);
    for (const StageLeaf& entry : _leaves) {
        if (!job.receivers.count(entry.leaf)) continue;
        const auto place = screenBoundsOf(*entry.leaf);
        if (place && overlap(*place, job.marks->screenBounds)) replay.draw(entry);
    }
}

void Compositor::transfer(const ShadowJob& job, unsigned bit) {
    CleanState clean(_state, _stage.getViewport());
    ScreenPass pass(_state, *_stage.getViewport(), job.marks->screenBounds);
    pass.stencilEqual(_bits.scratch | bit, _bits.scratch, bit);
    pass.drawQuad();
}

/// Before a full redraw: nothing stands where marked. A leaf that blends over nothing must find the background there.
void Compositor::resetMarked(unsigned where, const ScreenRect& bounds) {
    CleanState clean(_state, _stage.getViewport());
    ScreenPass pass(_state, *_stage.getViewport(), bounds);
    pass.stencilAny(where);
    const bool background = _stage.getClearMask() & GL_COLOR_BUFFER_BIT;
    if (background && isModeOn(_leaves, GL_BLEND)) pass.writeColor(_stage.getClearColor());
    pass.writeFarDepth();
}

void Compositor::clear(unsigned bits, const ScreenRect& bounds) {
    CleanState clean(_state, _stage.getViewport());
    ScreenPass pass(_state, *_stage.getViewport(), bounds);
    pass.clearStencil(bits);
}

} // namespace gnomon
