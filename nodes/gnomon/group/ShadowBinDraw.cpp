// SPDX-License-Identifier: MIT
// ShadowBin: its part of a draw traversal.
#include <gnomon/compositor/Compositor.h>
#include <gnomon/compositor/CompositorTarget.h>
#include <gnomon/compositor/ForgottenArrays.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/compositor/SoftMarkJob.h>
#include <gnomon/compositor/StageVerdict.h>
#include <gnomon/group/ShadowBin.h>

#include <algorithm>
#include <set>

namespace gnomon {
namespace {

/// Stencil bits that the compositor takes: one a light, and a scratch bit; one more for lights that fade.
std::size_t ownBits(const std::vector<ShadowJob>& jobs) {
    if (std::none_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.marks->counts(); })) return 8;
    if (std::any_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.softMarks(); }))
        return mostRelitLights + 2;
    std::set<int> lights;
    for (const ShadowJob& job : jobs) lights.insert(job.light);
    return std::min(lights.size(), mostRelitLights) + 1;
}

/// Where a framebuffer of the kit's own could not take over depths. What blends, or tests, does so as in the frame.
void drawDepths(const CompositorStage& draw, const ScreenRect& bounds) {
    LeafReplay::Overlay overlay;
    overlay.color = LeafReplay::Color::None;
    overlay.bounds = bounds;
    LeafReplay replay(draw, overlay);
    TouchTest touches(bounds);
    for (const DrawnLeaf& entry : draw.leaves)
        if (touches(*entry.leaf)) replay.draw(entry);
}

} // namespace

void ShadowBin::drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    if (!isIdle()) {
        const std::optional<double> begin = drawStartIfWatched();
        tell(compose(renderInfo, previous));
        if (begin) recordDraw(*begin);
        renderInfo.getState()->decrementDynamicObjectCount();
    }
    osgUtil::RenderBin::drawImplementation(renderInfo, previous);
}

/// @return why nothing could be composed, as a cause for diagnose(); empty if all is well.
std::string ShadowBin::compose(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    osg::State& state = *renderInfo.getState();
    const std::string never = whyNeverComposed(state, *getStage());
    if (!never.empty()) return never;
    std::vector<DrawnLeaf> leaves = leavesBelow(*getStage(), _composesBelow.value_or(getBinNum()));
    MaterialHistory materials(state, *getStage(), PrepassBin::followsDefault(*getStage()));
    osgUtil::RenderLeaf* const last = previous;
    popLeafState(state, previous);
    const unsigned unit = state.getActiveTextureUnit();
    forgetArrays(state);
    for (const osg::ref_ptr<DrawWatch>& watch : _watches) watch->begin(renderInfo);
    const std::string cause = compose(renderInfo, std::move(leaves), materials);
    for (const osg::ref_ptr<DrawWatch>& watch : _watches) watch->end(renderInfo);
    if (last) pushLeafState(state, *last);
    previous = last;
    materials.restore();
    forgetArrays(state);
    state.setActiveTextureUnit(unit);
    return cause;
}

std::string ShadowBin::compose(osg::RenderInfo& renderInfo, std::vector<DrawnLeaf> leaves, MaterialHistory& materials) {
    osg::State& state = *renderInfo.getState();
    const TargetNeeds needs = this->needs(leaves);
    const CompositorTarget target(state, *getStage()->getViewport(), needs);
    CompositorOptions options = _options;
    if (target.isOwn()) options.reservedStencilBits = 0;
    const bool clean = target.isOwn() || isStencilClean(leaves);
    const CompositorStage draw(renderInfo, *getStage(), std::move(leaves), options, clean, ownBits(_jobs), materials);
    const std::string cause = needs.stencilBits > 0 ? whyNotComposed(draw) : "";
    if (cause.empty()) {
        if (target.lacksDepth()) drawDepths(draw, needs.bounds);
        Compositor(draw).compose(_jobs, _effects);
    }
    draw.pattern.restore(state);
    return cause;
}

TargetNeeds ShadowBin::needs(const std::vector<DrawnLeaf>& leaves) const {
    TargetNeeds needs;
    if (_effects.empty() && _jobs.size() == 1 && needsNoMarks(_jobs.front(), leaves) &&
        vastLeaves(leaves, *getStage()->getViewport()).empty())
        return needs;
    needs = needsOf(_jobs);
    needs.reserved = _options.reservedStencilBits;
    needs.ownStencil = _sharesStencil && needs.reserved == 0;
    if (!_effects.empty()) needs.bounds = wholeScreen;
    return needs;
}

/// As the stage draws. @param leaves  drawn since.
bool ShadowBin::isStencilClean(const std::vector<DrawnLeaf>& leaves) const {
    return (getStage()->getClearMask() & GL_STENCIL_BUFFER_BIT) && getStage()->getClearStencil() == 0 &&
           !isModeOn(leaves, GL_STENCIL_TEST);
}

/// All whom it concerns; and those that ask in the stage's later frames, that no work need be done for them.
void ShadowBin::tell(const std::string& cause) {
    for (const FrameReport& report : _waiting) report(cause);
    for (const ShadowJob& job : _jobs) job.report(cause);
    for (const osg::ref_ptr<ViewEffect>& effect : _effects) effect->report(cause);
    const auto isForPrograms = [](const ShadowJob& job) { return job.programMarks() != nullptr; };
    const bool served = std::any_of(_jobs.begin(), _jobs.end(), isForPrograms);
    keptBy<StageVerdict>(*getStage()).refuse(!cause.empty() && !served);
}

} // namespace gnomon
