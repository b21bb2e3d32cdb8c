// SPDX-License-Identifier: MIT
#include <gnomon/ViewFrame.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/group/ReceiverCauses.h>
#include <gnomon/group/ShadowBin.h>
#include <gnomon/group/ViewLights.h>

#include <OpenThreads/ScopedLock>
#include <osg/Notify>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <typeinfo>
#include <utility>

namespace gnomon {
namespace {

constexpr int highestNumber = 8;    // below 9, where osg::OcclusionQueryNode draws, and 10, the transparent bin
constexpr int lateNumber = 1 << 30; // below another bin, after all others there
constexpr const char* binName = "gnomon::ShadowBin";

/// Makes the bin known to osgUtil, which creates bins by name.
const bool registered = [] {
    osgUtil::RenderBin::addRenderBinPrototype(binName, new ShadowBin);
    return true;
}();

/// Casters without triangles are drawn by their own code, or not at all; clear parts of triangles in maps alone.
void reportOwnDrawings(const EnlistedTechnique& entry, const CasterDrawables& casters) {
    const auto report = [&entry](const std::string& cause) { entry.technique->report(entry.frameNumber, cause); };
    const auto& own = casters.own;
    if (entry.technique->drawsCasters()) {
        const auto hasNone = [](const auto& drawing) { return !drawing->bounds.valid(); };
        const auto unbounded = std::find_if(own.begin(), own.end(), hasNone);
        if (unbounded != own.end())
            report("'" + (*unbounded)->name +
                   "' draws itself and has no bounds, so it casts nothing. Give it computeBoundingBox(), or call "
                   "setInitialBound().");
        return;
    }
    const auto isAlone = [](const auto& drawing) { return !drawing->hasPiece; };
    const auto first = std::find_if(own.begin(), own.end(), isAlone);
    if (first != own.end())
        report("what draws itself or is made of patches casts nothing here: " +
               std::to_string(std::count_if(first, own.end(), isAlone)) + ", the first in '" + (*first)->name +
               "'. Use map, or let a node that is never drawn cast in its place.");
    if (casters.cutouts > 0)
        report("casters with clear parts cast as if they were solid: " + std::to_string(casters.cutouts) +
               ", the first in '" + casters.cutoutNode + "'. Use map for them, or leave them out of the casters.");
}

bool areSome(const EnlistedTechnique& entry, const CasterDrawables& casters) {
    reportOwnDrawings(entry, casters);
    if (casters.invalidTriangles > 0)
        entry.technique->report(entry.frameNumber,
                                "invalid triangles are left out: " + std::to_string(casters.invalidTriangles) +
                                    ", the first in '" + casters.invalidNode +
                                    "'. Give every vertex finite coordinates and every index a vertex.");
    if (!casters.empty() || (entry.technique->drawsCasters() && !casters.own.empty())) return true;
    if (entry.group->areCastersGone()) {
        entry.technique->report(entry.frameNumber, "nothing casts, because the node given to setCasters() of the "
                                                   "ShadowCasterGroup is gone. Add the casters to the scene, and name "
                                                   "them anew.");
        return false;
    }
    if (casters.leftOut.empty())
        entry.technique->report(entry.frameNumber,
                                "nothing casts, because the ShadowCasterGroup '" + entry.group->getName() +
                                    "' holds no triangles. Add the scene to the group, or check its setCasters().");
    else
        entry.technique->report(entry.frameNumber, "nothing casts, because the ShadowCasterGroup '" +
                                                       entry.group->getName() +
                                                       "' holds no triangles that are drawn and opaque. Check the "
                                                       "states of '" +
                                                       casters.leftOut + "'.");
    return false;
}

bool hasCasters(const EnlistedTechnique& entry, const FrameCasters& casters) {
    return areSome(entry, entry.technique->takesDrawables() ? casters.drawables() : *casters.layers().pieces);
}

/// Asked for once for all techniques that share a group and a view of it.
const FrameCasters& castersOf(const EnlistedTechnique& entry, osgUtil::RenderStage& stage,
                              std::deque<FrameCasters>& known) {
    const CasterView view{entry.eyeFromGroup,  *entry.projection,
                          stage.getViewport(), entry.viewPoint,
                          entry.lodScale,      &stage,
                          entry.mask,          clipPlanesOf(stage, entry.eyeFromGroup)};
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const FrameCasters& casters) { return casters.areOf(*entry.group, view); });
    return found == known.end() ? known.emplace_back(*entry.group, view) : *found;
}

ShadowJob jobFor(const EnlistedTechnique& entry, const ShadowLight& light) {
    ShadowJob job;
    job.report = entry.technique->reportIn(entry.frameNumber);
    job.light = light.number;
    job.relight = entry.group->getComposite() == ShadowCasterGroup::RELIGHT;
    job.dark = entry.group->getDark();
    job.projection = entry.projection;
    job.lightUniforms = entry.group->getLightUniforms();
    return job;
}

/// Where leaves can be seen.
std::optional<ScreenRect> boundsOf(const std::vector<const osgUtil::RenderLeaf*>& leaves) {
    std::optional<ScreenRect> all;
    FilledTest filled;
    for (const osgUtil::RenderLeaf* leaf : leaves)
        if (const std::optional<ScreenRect> place = filled(*leaf) ? screenBoundsOf(*leaf) : wholeScreen)
            all = all ? united(*all, *place) : *place;
    return all;
}

/// Leaves whose depths belong together. What all lies at one depth, as a sky does, receives nothing.
std::map<DepthPlacement, Leaves> byPlacement(const Leaves& leaves,
                                             const std::map<const osgUtil::RenderLeaf*, DepthPlacement>& displaced) {
    std::map<DepthPlacement, Leaves> parts;
    if (displaced.empty()) {
        parts[DepthPlacement()] = leaves;
        return parts;
    }
    for (const osgUtil::RenderLeaf* leaf : leaves) {
        const auto found = displaced.find(leaf);
        const DepthPlacement placement = found == displaced.end() ? DepthPlacement() : found->second;
        if (placement.nearest != placement.farthest) parts[placement].push_back(leaf);
    }
    return parts;
}

/// A depth range, as a part of the projection.
osg::Matrixd rangeOf(const DepthPlacement& placement) {
    return osg::Matrixd::scale(1.0, 1.0, placement.farthest - placement.nearest) *
           osg::Matrixd::translate(0.0, 0.0, placement.farthest + placement.nearest - 1.0);
}

/// What a technique is asked for in one view.
struct Preparation {
    const EnlistedTechnique& entry;
    const std::vector<ShadowLight>& lights;
    const FrameCasters& casters;
    ViewFrame view;
    const std::vector<const osgUtil::RenderLeaf*>& receiving;
    std::optional<ScreenRect> within = wholeScreen; ///< where those are; nullopt: nowhere.
};

/// @param alone  what receives is not all that the view sees.
std::vector<ShadowJob> jobsFor(Preparation asked, bool alone) {
    std::vector<ShadowJob> jobs;
    std::shared_ptr<const LeafSet> receivers;
    if (alone) receivers = std::make_shared<const LeafSet>(asked.receiving.begin(), asked.receiving.end());
    asked.view.receivers = receivers.get();
    asked.view.seen = asked.receiving;
    for (const ShadowLight& light : asked.lights) {
        ShadowJob job = jobFor(asked.entry, light);
        job.receiverNamed = alone;
        job.receivers = receivers;
        for (const osg::ref_ptr<Mark>& marks : asked.entry.technique->prepare(asked.view, light, asked.casters)) {
            job.marks = marks;
            marks->screenBounds = common(marks->screenBounds, *asked.within);
            if (job.programMarks() || overlap(marks->screenBounds, marks->screenBounds)) jobs.push_back(job);
        }
    }
    return jobs;
}

/// The bin that composes what the bin `last` of the stage draws, right after it: a bin below it, or else beside it.
ShadowBin& binAfter(osgUtil::RenderBin& last) {
    const bool drawsBinsBelow = typeid(last) == typeid(osgUtil::RenderBin) || typeid(last) == typeid(ShadowBin);
    const bool below = drawsBinsBelow && !last.getStateSet();
    osgUtil::RenderBin& parent = below ? last : *last.getStage();
    for (int number = below ? lateNumber : last.getBinNum() + 1;; ++number) {
        auto* bin = dynamic_cast<ShadowBin*>(parent.find_or_insert(number, binName));
        if (bin) return *bin;
    }
}

/// What only its own code knows may clear the depths that shadows are found by, so that what follows is on top.
bool mayClearDepth(const osg::Drawable& drawable) {
    return drawable.getDrawCallback() || (drawsItself(drawable) && !drawable.getBoundingBox().valid());
}

/// The bin of the stage that a bin is in; the stage itself, if it is that.
osgUtil::RenderBin& topOf(osgUtil::RenderBin& bin) {
    osgUtil::RenderBin* top = &bin;
    while (top->getParent() && top->getParent() != top->getStage()) top = top->getParent();
    return *top;
}

/// A bin that may clear depths, and the one that is drawn before it.
struct DepthClear {
    osgUtil::RenderBin *before, *by;
};

/// The first such bin below `number` that is drawn after others.
std::optional<DepthClear> firstDepthClear(osgUtil::RenderStage& stage, int number) {
    osgUtil::RenderBin *before = nullptr, *now = nullptr;
    for (const DrawnLeaf& entry : leavesBelow(stage, number)) {
        osgUtil::RenderBin& top = topOf(*entry.bin);
        if (&top != now) before = std::exchange(now, &top);
        if (before && now != &stage && now->getBinNum() >= 0 &&
            (now->getDrawCallback() || mayClearDepth(*entry.leaf->_drawable)))
            return DepthClear{before, now};
    }
    return std::nullopt;
}

} // namespace

ShadowBin& ShadowBin::of(osgUtil::RenderStage* stage) {
    for (int number = highestNumber;; --number) {
        auto* bin = dynamic_cast<ShadowBin*>(stage->find_or_insert(number, binName));
        if (bin) return *bin;
    }
}

void ShadowBin::enlist(const EnlistedTechnique& technique) {
    _enlisted.push_back(technique);
    _options = _options.with(technique.group->getCompositorOptions());
}

void ShadowBin::enlist(ViewEffect& effect, const CompositorOptions& options) {
    _effects.push_back(&effect);
    _options = _options.with(options);
}

/// After the whole cull, in which an osg::ClearNode sets the mask anew. In draw it may change once more: interlaced stereo
/// takes the bit out again, for it keeps a pattern in the stencil buffer.
void ShadowBin::clearWithStage() {
    osgUtil::RenderStage& stage = *getStage();
    if (_options.reservedStencilBits == 0 && !_sharesStencil && (stage.getClearMask() & GL_DEPTH_BUFFER_BIT) &&
        stage.getClearStencil() == 0)
        stage.setClearMask(stage.getClearMask() | GL_STENCIL_BUFFER_BIT);
}

void ShadowBin::reset() {
    osgUtil::RenderBin::reset();
    setSortMode(getDefaultRenderBinSortMode());
    _enlisted.clear();
    _jobs.clear();
    _lateJobs.clear();
    _composesBelow.reset();
    _effects.clear();
    _watches.clear();
    _waiting.clear();
    _holdsFrame = false;
    _sharesStencil = false;
    _options = {};
}

void ShadowBin::sortImplementation() {
    if (!_composesBelow) prepareAll();
    sortAsAsked();
    osgUtil::RenderBin::sortImplementation();
}

void ShadowBin::prepareAll() {
    _jobs.clear();
    std::deque<FrameCasters> known;
    if (!_enlisted.empty() || !_effects.empty()) moveBinStatesToGraphs(*getStage());
    const std::optional<DepthClear> clear =
        _enlisted.empty() ? std::nullopt : firstDepthClear(*getStage(), getBinNum());
    const StageLeaves drawn(*getStage(), clear ? clear->by->getBinNum() : getBinNum(), !_enlisted.empty());
    StageVerdict& verdict = keptBy<StageVerdict>(*getStage());
    const bool refused = verdict.isRefused();
    for (const EnlistedTechnique& entry : _enlisted) {
        if (refused) {
            _waiting.push_back(entry.technique->reportIn(entry.frameNumber));
            continue;
        }
        const std::optional<Start> start = startIfWatched(entry);
        const std::size_t lights = prepareOf(entry, drawn, known);
        if (start) recordCull(entry, *start, lights);
    }
    PrepassBin::show(_jobs, *getStage());
    PrepassBin::show(_lateJobs, *getStage());
    for (const osg::ref_ptr<ViewEffect>& effect : _effects) effect->prepare(*getStage(), drawn.early);
    if (!isIdle() || !_lateJobs.empty()) {
        const std::vector<DrawnLeaf> all = leavesBelow(*getStage(), std::numeric_limits<int>::max());
        const auto isDynamic = [](const DrawnLeaf& entry) { return entry.leaf->_dynamic; };
        _holdsFrame = verdict.hold(_holdsFrame || !_effects.empty() || std::any_of(all.begin(), all.end(), isDynamic));
        _sharesStencil = isModeOn(all, GL_STENCIL_TEST);
        clearWithStage();
        PrepassBin::watch(*getStage());
    }
    saveColorsIfBlended(drawn);
    if (!_lateJobs.empty()) {
        for (ShadowJob& job : _lateJobs) job.hidingOnly = true;
        handOn(_lateJobs, binAfter(*drawn.late.last), drawn.late.last->getBinNum() + 1);
    }
    if (clear && !_jobs.empty()) handOn(_jobs, binAfter(*clear->before), clear->by->getBinNum());
}

/// @return how many lights were asked for.
std::size_t ShadowBin::prepareOf(const EnlistedTechnique& entry, const StageLeaves& drawn,
                                 std::deque<FrameCasters>& known) {
    if (const std::string cause = whyNoPicture(entry); !cause.empty()) {
        entry.technique->report(entry.frameNumber, cause);
        return 0;
    }
    const FrameCasters& casters = castersOf(entry, *getStage(), known);
    if (!hasCasters(entry, casters)) {
        entry.technique->letGo();
        return 0;
    }
    _holdsFrame = _holdsFrame || (entry.technique->drawsCasters() && !casters.drawables().own.empty());
    const GroupLights found = lightsOf(*entry.group, entry.eyeFromGroup, *getStage());
    for (const std::string& cause : found.causes) entry.technique->report(entry.frameNumber, cause);
    prepare(entry, found, casters, drawn);
    return found.lights.size();
}

/// What is relit is drawn anew, and leaves that blend need the colours from before the stage, where it clears none.
void ShadowBin::saveColorsIfBlended(const StageLeaves& drawn) {
    const auto relights = [](const std::vector<ShadowJob>& jobs) {
        return std::any_of(jobs.begin(), jobs.end(), [](const ShadowJob& job) { return job.relight; });
    };
    if (getStage()->getClearMask() & GL_COLOR_BUFFER_BIT) return;
    const bool blended = relights(_lateJobs) ? readsBack(leavesBelow(*getStage(), drawn.late.last->getBinNum() + 1))
                                             : relights(_jobs) && readsBack(drawn.early);
    if (blended) PrepassBin::saveColors(*getStage());
}

/// Leaves that asked for a bin of this number got this one, which must sort as the kind they named.
void ShadowBin::sortAsAsked() {
    for (const osgUtil::StateGraph* graph : getStateGraphList())
        for (; graph; graph = graph->_parent) {
            const osg::StateSet* set = graph->getStateSet();
            if (!set || !set->useRenderBinDetails() || set->getBinNumber() != getBinNum()) continue;
            const osgUtil::RenderBin* kind = osgUtil::RenderBin::getRenderBinPrototype(set->getBinName());
            if (kind) setSortMode(kind->getSortMode());
        }
}

void ShadowBin::prepare(const EnlistedTechnique& entry, const GroupLights& found, const FrameCasters& casters,
                        const StageLeaves& drawn) {
    if (const std::string why = entry.technique->whyUnavailable(); !why.empty())
        return entry.technique->report(entry.frameNumber, "there is no shadow. " + why);
    const auto receiving = receivingOf(entry, drawn.early, *getStage());
    const auto lateOnes = receivingOf(entry, drawn.late.leaves, *getStage());
    reportReceiverStates(entry, {receiving, lateOnes, drawn}, *getStage());
    const bool otherLens = reportOtherLens(entry, _enlisted, drawn, *getStage());
    if (entry.technique->hasReceiver() && receiving.empty() && lateOnes.empty()) {
        if (!otherLens) reportNoReceiver(entry, *getStage());
        return;
    }
    reportEnclosers(entry, found.lights, casters.drawables(), receiving, *getStage());
    ViewFrame view = viewOf(entry, *getStage()->getViewport());
    view.lights = found.lights.size();
    view.strengths = found.strengths;
    view.renderStage = getStage();
    view.options.filter = _options.filter; // as all who share this bin want it
    const auto add = [&](auto& to, const Leaves& those, std::optional<ScreenRect> within, bool alone, bool programs) {
        for (ShadowJob& job : jobsFor({entry, found.lights, casters, view, those, within}, alone))
            if (programs || !job.programMarks()) to.push_back(std::move(job));
    };
    const std::size_t before = _jobs.size(), lateBefore = _lateJobs.size();
    int index = 0;
    bool programs = true; // are served once
    const auto addAll = [&](const Leaves& all, bool late) {
        const auto parts = byPlacement(all, drawn.displaced);
        for (const auto& [placement, those] : parts) {
            view.stage = reinterpret_cast<const char*>(getStage()) + index++; // to a technique's caches another view
            view.projection = *entry.projection * rangeOf(placement);
            view.pushedBack = {placement.pixels, placement.steps};
            view.kind = late ? ReceiverKind::Late : placement.isPlain() ? ReceiverKind::Usual : ReceiverKind::Displaced;
            const bool part = parts.size() > 1;
            const std::optional<ScreenRect> within = part || late ? boundsOf(those) : wholeScreen;
            const bool named = part || late || entry.technique->hasReceiver();
            if (within) add(late ? _lateJobs : _jobs, those, within, named, programs);
            programs = false;
        }
    };
    if (!receiving.empty() || lateOnes.empty()) addAll(receiving, false);
    if (const auto watch = entry.technique->watch(view)) _watches.push_back(watch);
    addAll(lateOnes, true);
    if (_jobs.size() == before && _lateJobs.size() == lateBefore) return; // it has said why, or is out of sight
    reportUnshadowed(entry, _enlisted, found.lights, casters.drawables(), drawn, *getStage());
    double steps = 0.0;
    const auto take = [&steps](const ShadowJob& job) { steps = std::max(steps, job.marks->depthSteps()); };
    std::for_each(_jobs.begin() + before, _jobs.end(), take);
    std::for_each(_lateJobs.begin() + lateBefore, _lateJobs.end(), take);
    if (steps > 0.0) reportCoarseDepth(entry, found.lights.front(), casters.drawables(), *getStage(), steps);
}

/// To a bin of their own, which composes what the stage draws before that number: what receives late, or what depths are
/// cleared after.
void ShadowBin::handOn(std::vector<ShadowJob>& jobs, ShadowBin& to, int below) const {
    to._jobs = std::move(jobs);
    to._options = _options;
    to._holdsFrame = _holdsFrame;
    to._sharesStencil = _sharesStencil;
    to._composesBelow = below;
    jobs.clear();
}

/// Leaves that are DYNAMIC are drawn again, and casters draw themselves: the frame is not done with them before this bin is.
unsigned ShadowBin::computeNumberOfDynamicRenderLeaves() const {
    return osgUtil::RenderBin::computeNumberOfDynamicRenderLeaves() + (holdsFrame() ? 1u : 0u);
}

} // namespace gnomon
