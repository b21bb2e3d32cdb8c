// SPDX-License-Identifier: MIT
#include <gnomon/Compositor.h>
#include <gnomon/ReplayFilter.h>

#include <algorithm>
#include <set>

namespace gnomon {
namespace {

constexpr std::size_t mostRelitLights = 3;

ScreenRect boundsOf(const std::vector<const ShadowJob*>& jobs) {
    ScreenRect all = jobs.front()->marks->screenBounds;
    for (const ShadowJob* job : jobs) all = united(all, job->marks->screenBounds);
    return all;
}

void reportAll(const std::vector<const ShadowJob*>& jobs, const std::string& cause) {
    for (const ShadowJob* job : jobs) job->technique->report(job->frameNumber, cause);
}

/// Bits of the stencil buffer that are there and not reserved, the highest first.
std::vector<unsigned> freeBits(unsigned count, unsigned reserved) {
    std::vector<unsigned> bits;
    for (unsigned i = std::min(count, 8u); i-- > 0;)
        if (!(reserved & (1u << i))) bits.push_back(1u << i);
    return bits;
}

} // namespace

Compositor::Compositor(osg::RenderInfo& renderInfo, osgUtil::RenderStage& stage, std::vector<StageLeaf> leaves)
    : _renderInfo(renderInfo), _state(*renderInfo.getState()), _stage(stage), _leaves(std::move(leaves)) {
    GLint count = 0;
    glGetIntegerv(GL_STENCIL_BITS, &count);
    _stencilBits = static_cast<unsigned>(std::max(count, 0));
    const std::vector<unsigned> bits = freeBits(_stencilBits, ShadowBin::reserved());
    for (std::size_t i = 0; i < bits.size() && i < mostRelitLights; ++i) _bits.lights.push_back(bits[i]);
    if (bits.size() > 1) {
        _bits.scratch = bits[std::min(bits.size() - 1, mostRelitLights)];
        if (_bits.lights.size() == bits.size()) _bits.lights.pop_back();
    }
}

void Compositor::compose(const std::vector<ShadowJob>& jobs) {
    Jobs relit;
    std::map<float, Jobs> blended;
    for (const ShadowJob& job : jobs) {
        if (!canMark(job)) continue;
        if (job.composite == ShadowCasterGroup::RELIGHT)
            relit.push_back(&job);
        else
            blended[job.dark].push_back(&job);
    }
    if (!relit.empty()) relight(relit);
    for (const auto& [dark, group] : blended) blend(group, dark);
}

bool Compositor::canMark(const ShadowJob& job) const {
    const char* cause = nullptr;
    if (_stencilBits == 0)
        cause = "finds no stencil bits in this framebuffer: ask for 8, by "
                "osg::DisplaySettings::setMinimumNumStencilBits(8) before the "
                "window is made or by a stencil attachment of the camera.";
    else if (_bits.lights.empty())
        cause = "finds every stencil bit reserved: leave one to ShadowBin::reserve().";
    else if (job.receiverNamed && !_bits.scratch)
        cause = "needs a second stencil bit for its named receiver: leave two to ShadowBin::reserve().";
    if (cause) job.technique->report(job.frameNumber, cause);
    return !cause;
}

std::map<int, unsigned> Compositor::assignBits(const Jobs& jobs) const {
    std::map<int, unsigned> bitOf;
    for (const ShadowJob* job : jobs) {
        if (bitOf.count(job->light)) continue;
        if (bitOf.size() < _bits.lights.size())
            bitOf[job->light] = _bits.lights[bitOf.size()];
        else
            reportAll({job}, "leaves light " + std::to_string(job->light) + " unshadowed: at most " +
                                 std::to_string(_bits.lights.size()) +
                                 " lights can be relit here; blend takes any number.");
    }
    return bitOf;
}

void Compositor::relight(const Jobs& wanted) {
    const std::map<int, unsigned> bitOf = assignBits(wanted);
    Jobs jobs;
    unsigned lightBits = 0;
    for (const ShadowJob* job : wanted)
        if (bitOf.count(job->light)) jobs.push_back(job);
    for (const auto& entry : bitOf) lightBits |= entry.second;
    const ScreenRect bounds = boundsOf(jobs);
    mark(jobs, bitOf, bounds);
    {
        CleanState clean(_state, _stage.getViewport());
        ScreenPass pass(_state, *_stage.getViewport(), bounds);
        pass.stencilAny(lightBits);
        pass.writeFarDepth();
    }
    for (unsigned subset = 1; subset < (1u << bitOf.size()); ++subset) {
        Combination combination;
        combination.bounds = bounds;
        unsigned index = 0;
        for (const auto& [light, bit] : bitOf) {
            if (!(subset & (1u << index++))) continue;
            Jobs ofLight;
            for (const ShadowJob* job : jobs)
                if (job->light == light) ofLight.push_back(job);
            combination.bits |= bit;
            combination.bounds = common(combination.bounds, boundsOf(ofLight));
            combination.jobs.insert(combination.jobs.end(), ofLight.begin(), ofLight.end());
        }
        if (overlap(combination.bounds, combination.bounds)) replay(combination, lightBits);
    }
    clear(lightBits | _bits.scratch, bounds);
}

void Compositor::replay(const Combination& combination, unsigned lightBits) {
    LeafReplay::Overlay overlay;
    overlay.stencilReference = combination.bits;
    overlay.stencilTest = lightBits;
    LeafReplay replay(_renderInfo, overlay);
    for (const ReplayedLeaf& leaf :
         leavesToReplay(_leaves, combination.jobs, combination.bounds, ShadowBin::getFilter()))
        replay.draw(leaf.entry, leaf.dark);
}

void Compositor::blend(const Jobs& jobs, float dark) {
    const unsigned bit = _bits.lights.front();
    const ScreenRect bounds = boundsOf(jobs);
    std::map<int, unsigned> bitOf;
    for (const ShadowJob* job : jobs) bitOf[job->light] = bit;
    mark(jobs, bitOf, bounds);
    CleanState clean(_state, _stage.getViewport());
    ScreenPass pass(_state, *_stage.getViewport(), bounds);
    pass.stencilAny(bit);
    pass.multiplyColor(dark);
    pass.clearStencil(bit | _bits.scratch);
}

void Compositor::mark(const Jobs& jobs, const std::map<int, unsigned>& bitOf, const ScreenRect& bounds) {
    unsigned used = _bits.scratch;
    for (const auto& entry : bitOf) used |= entry.second;
    clear(used, bounds);
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
                              "needs a second stencil bit beside another technique of its light: leave two to "
                              "ShadowBin::reserve().");
        return;
    }
    {
        CleanState clean(_state, _stage.getViewport());
        ScreenPass pass(_state, *_stage.getViewport(), job.marks->screenBounds);
        job.marks->mark(_renderInfo, pass, direct ? bit : _bits.scratch);
    }
    if (direct) return;
    if (job.receiverNamed)
        gate(job, bit);
    else
        transfer(job, bit);
    clear(_bits.scratch, job.marks->screenBounds);
}

/// Hands marks on where the receiver is what one sees: its own leaves, drawn again, pass only at the depth that stands.
void Compositor::gate(const ShadowJob& job, unsigned bit) {
    LeafReplay::Overlay overlay;
    overlay.stencilReference = _bits.scratch | bit;
    overlay.stencilTest = _bits.scratch;
    overlay.stencilWrite = bit;
    overlay.onlyStencil = true;
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

void Compositor::clear(unsigned bits, const ScreenRect& bounds) {
    CleanState clean(_state, _stage.getViewport());
    ScreenPass pass(_state, *_stage.getViewport(), bounds);
    pass.clearStencil(bits);
}

} // namespace gnomon
