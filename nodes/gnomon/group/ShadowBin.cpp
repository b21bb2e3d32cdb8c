// SPDX-License-Identifier: MIT
#include <gnomon/ViewFrame.h>
#include <gnomon/base/Fingerprint.h>
#include <gnomon/base/PixelRect.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/group/ReceiverCauses.h>
#include <gnomon/group/ShadowBin.h>
#include <gnomon/group/SlowCauses.h>
#include <gnomon/group/StageStats.h>
#include <gnomon/group/ViewLights.h>

#include <osgUtil/StateGraph>

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace gnomon {
namespace {

constexpr int highestNumber = 8; // below 9, where osg::OcclusionQueryNode draws, and 10, the transparent bin
constexpr const char* binName = "gnomon::ShadowBin";

/// Makes the bin known to osgUtil, which creates bins by name.
const bool registered = [] {
    osgUtil::RenderBin::addRenderBinPrototype(binName, new ShadowBin);
    return true;
}();

/// Casters without triangles are drawn by their own code, or not at all; clear parts of triangles by few.
void reportSelfDrawings(const EnlistedTechnique& entry, const Casters& casters) {
    const auto report = [&entry](const std::string& cause) { entry.report(cause); };
    const auto& drawings = casters.selfDrawings;
    if (casters.screenDoors > 0)
        report("what discards by gl_FragCoord, or has a projection of its own and discards, casts as if it were solid, "
               "because no light can draw it: " +
               std::to_string(casters.screenDoors) + ", the first in '" + casters.screenDoorNode +
               "'. Take it out of the casters once it has faded, or use gl_ProjectionMatrix or osg_ProjectionMatrix, "
               "or name its matrix by addMatrixUniform().");
    if (entry.technique->drawsCasters()) {
        const auto hasNone = [](const auto& drawing) { return !drawing->bounds.valid(); };
        const auto unbounded = std::find_if(drawings.begin(), drawings.end(), hasNone);
        if (unbounded != drawings.end())
            report("'" + (*unbounded)->name +
                   "' draws itself and has no bounds, so it casts nothing. Give it computeBoundingBox(), or call "
                   "setInitialBound().");
        return;
    }
    const auto isAlone = [](const auto& drawing) { return !drawing->hasPiece; };
    const auto first = std::find_if(drawings.begin(), drawings.end(), isAlone);
    if (first != drawings.end())
        report("what draws itself or is made of patches casts nothing here: " +
               std::to_string(std::count_if(first, drawings.end(), isAlone)) + ", the first in '" + (*first)->name +
               "'. Use map, or let a node that is never drawn cast in its place.");
    const bool cuts = entry.technique->cutsByTextures();
    const unsigned solid = cuts ? casters.drawnCutouts : casters.cutouts;
    if (solid > 0)
        report("casters with clear parts cast as if they were solid: " + std::to_string(solid) + ", the first in '" +
               (cuts ? casters.drawnCutoutNode : casters.cutoutNode) +
               "'. Use map for them, or leave them out of the casters.");
}

bool hasCasters(const EnlistedTechnique& entry, const Casters& casters) {
    reportSelfDrawings(entry, casters);
    if (casters.invalidTriangles > 0)
        entry.report("invalid triangles are left out: " + std::to_string(casters.invalidTriangles) +
                     ", the first in '" + casters.invalidNode +
                     "'. Give every vertex finite coordinates and every index a vertex.");
    if (!casters.empty() || (entry.technique->drawsCasters() && !casters.selfDrawings.empty())) return true;
    if (entry.group->areCastersGone()) {
        entry.report("nothing casts, because the node given to setCasters() of the "
                     "ShadowCasterGroup is gone. Add the casters to the scene, and name "
                     "them anew.");
        return false;
    }
    if (casters.leftOut.empty())
        entry.report("nothing casts, because the " + described(*entry.group) +
                     " holds no triangles. Add the scene to the group, or check its setCasters() (--casters).");
    else
        entry.report("nothing casts, because the " + described(*entry.group) +
                     " holds no triangles that are drawn and opaque. Check the states of '" + casters.leftOut + "'.");
    return false;
}

} // namespace

/// What casts below a group as one view has it in this frame. Masks do not matter: what they leave out casts, and whether it is
/// drawn and hides what is behind it is asked of the stage's leaves, see unseenCasters().
struct ShadowBin::ViewCasters {
    osg::ref_ptr<const ShadowCasterGroup> group;
    CasterView view;
    osg::ref_ptr<const Casters> casters;

    bool areOf(const ShadowCasterGroup& other, const CasterView& seen) const {
        return group == &other && view.eyeFromGroup == seen.eyeFromGroup && view.projection == seen.projection &&
               view.lodScale == seen.lodScale && view.viewPoint == seen.viewPoint;
    }
};

/// Asked for once for all techniques that share a group and a view of it.
const Casters& ShadowBin::castersOf(const EnlistedTechnique& entry, std::deque<ViewCasters>& known) {
    osgUtil::RenderStage& stage = *getStage();
    const CasterView view{
        entry.eyeFromGroup,
        *entry.projection,
        stage.getViewport(),
        entry.viewPoint,
        entry.lodScale,
        &stage,
        entry.mask,
        clipPlanesOf(stage, entry.eyeFromGroup, entry.group->getClipping() == ShadowCasterGroup::ALL)};
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const ViewCasters& casters) { return casters.areOf(*entry.group, view); });
    if (found != known.end()) return *found->casters;
    return *known.emplace_back(ViewCasters{entry.group, view, entry.group->casters(&view)}).casters;
}

namespace {

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

void addMarks(FrameWork& work, const std::vector<ShadowJob>& jobs, std::size_t from, const osg::Viewport& viewport) {
    const PixelRect all = pixelsOf(viewport);
    const glm::dvec2 pixels(all.width, all.height);
    for (std::size_t i = from; i < jobs.size(); ++i) {
        const ScreenRect& bounds = jobs[i].mark->screenBounds;
        const glm::dvec2 size = 0.5 * (bounds.high - bounds.low) * pixels;
        work.pixels += size.x * size.y;
        ++work.marks;
    }
}

/// Where leaves can be seen.
std::optional<ScreenRect> screenBoundsOf(const Leaves& leaves, const ViewPrograms& programs) {
    std::optional<ScreenRect> all;
    for (const osgUtil::RenderLeaf* leaf : leaves)
        if (const std::optional<ScreenRect> place =
                isFilled(*leaf) && !programs.moves(*leaf) ? gnomon::screenBoundsOf(*leaf) : wholeScreen)
            all = all ? united(*all, *place) : *place;
    return all;
}

/// A depth range, as a part of the projection.
osg::Matrixd rangeOf(const DepthPlacement& placement) {
    return osg::Matrixd::scale(1.0, 1.0, placement.farthest - placement.nearest) *
           osg::Matrixd::translate(0.0, 0.0, placement.farthest + placement.nearest - 1.0);
}

/// Leaves that receive and whose depths belong together: a technique is asked about each such part apart.
struct ReceiverPart {
    Leaves leaves;
    DepthPlacement placement;
    bool late;                        ///< drawn after the opaque bins.
    bool isAll;                       ///< of what the view sees.
    std::optional<ScreenRect> within; ///< where they are seen; nullopt: nowhere.
};

/// What all lies at one depth, as a sky does, receives nothing.
std::vector<ReceiverPart> partsOf(const Leaves& leaves, const StageLeaves& drawn, bool late, bool named) {
    std::map<DepthPlacement, Leaves> byPlacement;
    if (drawn.displaced.empty())
        byPlacement[DepthPlacement()] = leaves;
    else
        for (const osgUtil::RenderLeaf* leaf : leaves) {
            const auto found = drawn.displaced.find(leaf);
            const DepthPlacement placement = found == drawn.displaced.end() ? DepthPlacement() : found->second;
            if (placement.nearest != placement.farthest) byPlacement[placement].push_back(leaf);
        }
    std::vector<ReceiverPart> parts;
    for (auto& [placement, those] : byPlacement) {
        const bool apart = late || byPlacement.size() > 1;
        const std::optional<ScreenRect> within = apart ? screenBoundsOf(those, drawn.programs) : wholeScreen;
        parts.push_back({std::move(those), placement, late, !apart && !named, within});
    }
    return parts;
}

/// Never 0. Leaves that share a matrix mostly follow one another.
std::uint64_t valueOf(const Leaves& leaves, bool anyMoves) {
    Fingerprint value;
    value.mix(std::uint64_t{anyMoves});
    const osg::RefMatrix* place = nullptr;
    for (const osgUtil::RenderLeaf* leaf : leaves) {
        value.mix(static_cast<const void*>(leaf->_drawable.get()));
        value.mix(leaf->_drawable->getBoundingBox());
        if (place && leaf->_modelview == place) continue;
        place = leaf->_modelview.get();
        value.mix(modelviewOf(*leaf));
    }
    return value.value() | 1u;
}

/// What a technique is told of one part: of leaves without depth, as skies are, only if there are no others.
ViewFrame viewOf(ViewFrame view, const TechniqueInStage& asked, const ReceiverPart& part) {
    view.projection = *asked.entry.projection * rangeOf(part.placement);
    view.pushedBack = {part.placement.pixels, part.placement.steps};
    view.kind = part.late                  ? ReceiverKind::Late
                : part.placement.isPlain() ? ReceiverKind::Usual
                                           : ReceiverKind::Displaced;
    const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
    bool written = true;
    for (const osgUtil::RenderLeaf* leaf : part.leaves) {
        if (leaf->_parent != graph) written = writesDepth(graph = leaf->_parent);
        if (written || part.late) view.seen.push_back(leaf);
    }
    if (view.seen.empty()) view.seen = part.leaves;
    const auto isMoved = [&asked](const auto* leaf) { return asked.drawn.programs.moves(*leaf); };
    view.movesReceivers = asked.drawn.programs.moved() && std::any_of(view.seen.begin(), view.seen.end(), isMoved);
    view.seenValue = valueOf(view.seen, view.movesReceivers);
    return view;
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
    ComposeBin::reset();
    _enlisted.clear();
    _lateJobs.clear();
}

void ShadowBin::sortImplementation() {
    askTechniques();
    ComposeBin::sortImplementation();
}

void ShadowBin::askTechniques() {
    _jobs.clear();
    std::deque<ViewCasters> known;
    if (!_enlisted.empty() || !_effects.empty()) moveBinStatesToGraphs(*getStage());
    const KnownStates states;
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
        const std::size_t lights = askTechnique(entry, drawn, known);
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
        for (ShadowJob& job : _lateJobs) {
            job.hidingOnly = true;
            job.isCut = drawn.late.areCut;
        }
        ComposeBin& late = after(*drawn.late.last);
        handOn(_lateJobs, late, drawn.late.last->getBinNum() + 1);
        if (drawn.late.areCut) saveFor(late, drawn.late.leaves);
    }
    if (clear && !_jobs.empty()) handOn(_jobs, after(*clear->before), clear->by->getBinNum());
}

/// @return how many lights were asked for.
std::size_t ShadowBin::askTechnique(const EnlistedTechnique& entry, const StageLeaves& drawn,
                                    std::deque<ViewCasters>& known) {
    if (const std::string cause = whyNoPicture(entry); !cause.empty()) {
        entry.report(cause);
        return 0;
    }
    const Casters& casters = castersOf(entry, known);
    if (!hasCasters(entry, casters)) {
        entry.technique->letGo();
        return 0;
    }
    _holdsFrame = _holdsFrame || (entry.technique->drawsCasters() && !casters.selfDrawings.empty());
    const GroupLights found = lightsOf(*entry.group, entry.eyeFromGroup, *getStage());
    for (const std::string& cause : found.causes) entry.report(cause);
    askForMarks(entry, found, casters, drawn);
    return found.lights.size();
}

/// What is relit is drawn anew, and leaves that blend need the colours from before the stage, where it clears none.
void ShadowBin::saveColorsIfBlended(const StageLeaves& drawn) {
    const auto relights = [](const std::vector<ShadowJob>& jobs) {
        return std::any_of(jobs.begin(), jobs.end(), [](const ShadowJob& job) { return job.relight; });
    };
    if (getStage()->getClearMask() & GL_COLOR_BUFFER_BIT) return;
    const bool blended = relights(_lateJobs) && !drawn.late.areCut
                             ? readsBack(leavesBelow(*getStage(), drawn.late.last->getBinNum() + 1))
                             : relights(_jobs) && readsBack(drawn.early);
    if (blended) PrepassBin::saveColors(*getStage());
}

void ShadowBin::askForMarks(const EnlistedTechnique& entry, const GroupLights& found, const Casters& casters,
                            const StageLeaves& drawn) {
    if (const std::string why = entry.technique->whyUnavailable(); !why.empty())
        return entry.report("there is no shadow. " + why);
    const TechniqueInStage asked{entry, _enlisted, drawn, *getStage()};
    const Receiving receiving{receivingOf(entry, drawn.early, *getStage()),
                              receivingOf(entry, drawn.late.leaves, *getStage())};
    reportReceiverStates(asked, receiving);
    const bool otherLens = reportOtherLens(asked);
    if (entry.technique->hasReceiver() && receiving.early.empty() && receiving.late.empty()) {
        if (!otherLens) reportNoReceiver(entry, *getStage());
        return;
    }
    const std::size_t before = _jobs.size(), lateBefore = _lateJobs.size();
    addJobs(asked, found, casters, receiving);
    const FrameReport report = entry.technique->reportIn(entry.frameNumber);
    if (!report.diagnosis->looksForSlow(report.frame)) return;
    const bool marks = _jobs.size() > before || _lateJobs.size() > lateBefore;
    double steps = 0.0;
    const auto take = [&steps](const ShadowJob& job) { steps = std::max(steps, job.mark->depthSteps); };
    std::for_each(_jobs.begin() + before, _jobs.end(), take);
    std::for_each(_lateJobs.begin() + lateBefore, _lateJobs.end(), take);
    for (const std::string& cause : slowCauses(asked, {found.lights, casters, receiving, marks, steps}))
        report(cause, CauseKind::Slow);
}

/// Asks a technique for its marks: each part of the receivers, and each light.
void ShadowBin::addJobs(const TechniqueInStage& asked, const GroupLights& found, const Casters& casters,
                        const Receiving& receiving) {
    const EnlistedTechnique& entry = asked.entry;
    const bool named = entry.technique->hasReceiver();
    std::vector<ReceiverPart> parts;
    const auto add = [&](const Leaves& leaves, bool late) {
        for (ReceiverPart& part : partsOf(leaves, asked.drawn, late, named)) parts.push_back(std::move(part));
    };
    if (!receiving.early.empty() || receiving.late.empty()) add(receiving.early, false);
    add(receiving.late, true);
    ViewFrame whole = viewOf(entry, *getStage()->getViewport());
    whole.lights = found.lights.size();
    whole.strengths = found.strengths;
    whole.options.skipsUntouched = _options.skipsUntouched; // as all who share this bin want it
    whole.key.stage = getStage();
    whole.drawn = &asked.drawn.programs;
    for (const ReceiverPart& part : parts) {
        const bool isFirst = &part == &parts.front();
        ViewFrame view = viewOf(whole, asked, part);
        view.key.part = int(&part - parts.data());
        std::shared_ptr<const LeafSet> receivers;
        if (!part.isAll) receivers = std::make_shared<const LeafSet>(part.leaves.begin(), part.leaves.end());
        view.receivers = receivers.get();
        if (!part.within) continue;
        for (const ShadowLight& light : found.lights)
            for (const osg::ref_ptr<Mark>& mark : entry.technique->prepare(view, light, casters)) {
                ShadowJob job = jobFor(entry, light);
                job.receiverNamed = !part.isAll;
                job.receivers = receivers;
                job.moved = asked.drawn.programs.moved();
                job.mark = mark;
                mark->screenBounds = common(mark->screenBounds, *part.within);
                const bool isForPrograms = job.programMark() != nullptr; // these are served once
                if (isForPrograms ? isFirst : !isEmpty(mark->screenBounds))
                    (part.late ? _lateJobs : _jobs).push_back(std::move(job));
            }
    }
    if (const auto watch = entry.technique->watch(whole)) _watches.push_back(watch);
}

std::optional<ShadowBin::Start> ShadowBin::startIfWatched(const EnlistedTechnique& entry) const {
    if (!entry.technique->isRecorded() && !StageStats(*getStage()).collect()) return std::nullopt;
    return Start{secondsNow(), _jobs.size(), _lateJobs.size()};
}

void ShadowBin::recordCull(const EnlistedTechnique& entry, const Start& start, std::size_t lights) const {
    const double end = secondsNow();
    FrameWork work;
    work.frame = entry.frameNumber;
    work.lights = static_cast<unsigned>(lights);
    addMarks(work, _jobs, start.jobs, *getStage()->getViewport());
    addMarks(work, _lateJobs, start.lateJobs, *getStage()->getViewport());
    work.cull = 1000.0 * (end - start.time);
    entry.technique->record(work);
    const StageStats stats(*getStage());
    stats.addTime(work.frame, "Shadow cull", start.time, end);
    stats.addCount(work.frame, "Shadow marks", work.marks);
}

} // namespace gnomon
