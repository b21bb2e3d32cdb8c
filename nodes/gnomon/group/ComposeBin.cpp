// SPDX-License-Identifier: MIT
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/compositor/Compositor.h>
#include <gnomon/compositor/FoundEdges.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/compositor/StencilMarks.h>
#include <gnomon/group/ComposeBin.h>
#include <gnomon/group/StageStats.h>

#include <osg/Stencil>
#include <osg/Viewport>
#include <osgUtil/RenderStage>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

constexpr int lateNumber = 1 << 30;     // below another bin, after all others there
constexpr int earlyNumber = -(1 << 30); // before them
constexpr const char* binName = "gnomon::ComposeBin";
constexpr const char* noFrameForCut =
    "in interlaced stereo, and where OpenGL makes no framebuffer objects, what is drawn in a bin above 8 receives no "
    "shadow if any of it is clear in parts. Draw it in a bin below 8.";

/// Makes the bin known to osgUtil, which creates bins by name.
const bool registered = [] {
    osgUtil::RenderBin::addRenderBinPrototype(binName, new ComposeBin);
    return true;
}();

/// Stencil bits that marks take: one a light, and a scratch bit; one more for lights that fade.
std::size_t bitsOfLights(const std::vector<ShadowJob>& jobs) {
    if (std::none_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.mark->kind() == Mark::Kind::Counts; }))
        return 8;
    if (std::any_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.fades(); })) return stencilBitsFor(jobs);
    std::set<int> lights;
    for (const ShadowJob& job : jobs) lights.insert(job.light);
    return std::min(lights.size(), mostRelitLights) + 1;
}

/// Where a framebuffer of the kit's own could not take over depths. What blends, or tests, does so as in the frame.
void drawDepths(const CompositorStage& draw, const ScreenRect& bounds, const LeafSet* moved) {
    LeafReplay::Overlay overlay;
    overlay.color = LeafReplay::Color::None;
    overlay.bounds = bounds;
    LeafReplay replay(draw, overlay);
    TouchTest touches(bounds, moved);
    for (const DrawnLeaf& entry : draw.leaves)
        if (touches(*entry.leaf)) replay.draw(entry);
}

bool mayStencilHide(const DrawnLeaf& entry) {
    const osgUtil::StateGraph* graph = entry.leaf->_parent;
    if (!isOn(graph, GL_STENCIL_TEST)) return false;
    const osg::StateAttribute* test = resolvedAttribute(graph, osg::StateAttribute::STENCIL);
    const auto* oneSided = dynamic_cast<const osg::Stencil*>(test); // the other has two tests
    return oneSided ? oneSided->getFunction() != osg::Stencil::ALWAYS : test != nullptr;
}

} // namespace

ComposeBin& ComposeBin::after(osgUtil::RenderBin& last) {
    const auto isOwn = [](osgUtil::RenderBin& bin) { return typeid(bin) == typeid(ComposeBin); };
    const auto firstIn = [&isOwn](osgUtil::RenderBin& parent, int number) -> ComposeBin& {
        for (;; ++number)
            if (osgUtil::RenderBin* bin = parent.find_or_insert(number, binName); isOwn(*bin))
                return static_cast<ComposeBin&>(*bin);
    };
    const auto isPlain = [](osgUtil::RenderBin& bin) {
        return typeid(bin) == typeid(osgUtil::RenderBin) && !bin.getStateSet();
    };
    if (isPlain(last) || (dynamic_cast<ComposeBin*>(&last) && !last.getStateSet())) return firstIn(last, lateNumber);
    osgUtil::RenderBin& stage = *last.getStage();
    const int next = &last == &stage ? 0 : last.getBinNum() + 1; // the stage's bin 0 is drawn after its own leaves
    osgUtil::RenderBin* beside = stage.find_or_insert(next, binName);
    return isPlain(*beside) ? firstIn(*beside, earlyNumber) : firstIn(stage, next);
}

void ComposeBin::reset() {
    osgUtil::RenderBin::reset();
    setSortMode(getDefaultRenderBinSortMode());
    _jobs.clear();
    _effects.clear();
    _watches.clear();
    _waiting.clear();
    _holdsFrame = false;
    _sharesStencil = false;
    _options = {};
    _saves = nullptr;
    _since.reset();
    _below.reset();
}

void ComposeBin::sortImplementation() {
    sortAsAsked();
    osgUtil::RenderBin::sortImplementation();
}

/// Leaves that asked for a bin of this number got this one, which must sort as the kind they named.
void ComposeBin::sortAsAsked() {
    for (const osgUtil::StateGraph* graph : getStateGraphList())
        for (; graph; graph = graph->_parent) {
            const osg::StateSet* set = graph->getStateSet();
            if (!set || !set->useRenderBinDetails() || set->getBinNumber() != getBinNum()) continue;
            const osgUtil::RenderBin* kind = osgUtil::RenderBin::getRenderBinPrototype(set->getBinName());
            if (kind) setSortMode(kind->getSortMode());
        }
}

void ComposeBin::handOn(std::vector<ShadowJob>& jobs, ComposeBin& to, int below) const {
    to._jobs = std::move(jobs);
    to._options = _options;
    to._holdsFrame = _holdsFrame;
    to._sharesStencil = _sharesStencil;
    to._below = to.getParent() == getStage() ? to.getBinNum() : below; // others may be drawn in between
    jobs.clear();
}

void ComposeBin::saveFor(ComposeBin& to, const std::vector<DrawnLeaf>& hiding) {
    _saves = &keptBy<SavedFrame>(*getStage());
    to._since = DrawnSince{_saves, getBinNum(), hiding};
    std::vector<DrawnLeaf>& known = to._since->hiding; // their own test finds nothing in a framebuffer of the kit's own
    known.erase(std::remove_if(known.begin(), known.end(), mayStencilHide), known.end());
}

void ComposeBin::releaseGLObjects(osg::State* state) const {
    osgUtil::RenderBin::releaseGLObjects(state);
    if (_saves) _saves->releaseGLObjects(state);
}

/// Leaves that are DYNAMIC are drawn again, and casters draw themselves: the frame is not done with them before this bin is.
unsigned ComposeBin::computeNumberOfDynamicRenderLeaves() const {
    return osgUtil::RenderBin::computeNumberOfDynamicRenderLeaves() + (holdsFrame() ? 1u : 0u);
}

void ComposeBin::drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    if (!isIdle()) {
        const std::optional<double> begin = drawStartIfWatched();
        tell(compose(renderInfo, previous));
        if (begin) recordDraw(*begin);
        if (holdsFrame()) renderInfo.getState()->decrementDynamicObjectCount();
    }
    osgUtil::RenderBin::drawImplementation(renderInfo, previous);
}

/// @return why nothing could be composed, as a cause for diagnose(); empty if all is well.
std::string ComposeBin::compose(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    osg::State& state = *renderInfo.getState();
    const std::string never = whyNeverComposed(state, *getStage());
    if (!never.empty()) return never;
    const KnownStates states;
    std::vector<DrawnLeaf> leaves = leavesBelow(*getStage(), _below.value_or(getBinNum()));
    if (_since)
        leaves.erase(leaves.begin(), leaves.begin() + std::ptrdiff_t(leavesBelow(*getStage(), _since->number).size()));
    MaterialHistory materials(state, *getStage(), PrepassBin::followsDefault(*getStage()));
    osgUtil::RenderLeaf* const last = previous;
    popLeafState(state, previous);
    const unsigned unit = state.getActiveTextureUnit();
    forgetArrays(state);
    learnQuadCut(); // for the next cull
    for (const osg::ref_ptr<DrawWatch>& watch : _watches) watch->begin(renderInfo);
    const std::string cause = composesNothing() ? "" : compose(renderInfo, std::move(leaves), materials);
    if (_saves) {
        const CleanState clean(state, getStage()->getViewport());
        _saves->save(state, *getStage()->getViewport());
    }
    if (last) pushLeafState(state, *last);
    previous = last;
    materials.restore();
    forgetArrays(state);
    state.setActiveTextureUnit(unit);
    return cause;
}

std::string ComposeBin::compose(osg::RenderInfo& renderInfo, std::vector<DrawnLeaf> leaves,
                                MaterialHistory& materials) {
    osg::State& state = *renderInfo.getState();
    if (std::any_of(_jobs.begin(), _jobs.end(), [](const auto& job) { return job.mark->edges(); })) {
        const bool finds = canFindEdges(state);
        for (ShadowJob& job : _jobs) job.findsEdges = job.mark->edges() && finds;
    }
    const TargetNeeds needs = this->needs(leaves);
    const CompositorTarget target(state, *getStage()->getViewport(), needs);
    CompositorOptions options = _options;
    if (target.isOwn()) options.reservedStencilBits = 0;
    const bool stencilIsZero = target.isOwn() || isStencilZero(leaves);
    const CompositorStage draw(
        renderInfo, *getStage(),
        {std::move(leaves), options, stencilIsZero, bitsOfLights(_jobs), _since ? &*_since : nullptr}, materials);
    const std::string cause = needs.stencilBits > 0 ? whyNotComposed(draw) : "";
    if (cause.empty() && findDepths(draw, target, needs.bounds)) Compositor(draw).compose(_jobs, _effects);
    draw.pattern.restore(state);
    return cause;
}

/// Where the target has not those of the frame, or shall have others.
/// @return false if that cannot be: nothing here has a shadow then, unlike what the stage's other bin composes.
bool ComposeBin::findDepths(const CompositorStage& draw, const CompositorTarget& target,
                            const ScreenRect& bounds) const {
    const auto reportAll = [this](const std::string& cause) {
        for (const ShadowJob& job : _jobs) job.report(cause);
    };
    const LeafSet* moved = _jobs.empty() ? nullptr : _jobs.front().moved.get();
    if (_since) {
        const std::string cause = target.isOwn() ? drawHiding(draw, bounds, moved) : noFrameForCut;
        reportAll(cause);
        return cause.empty();
    }
    if (!target.lacksDepth()) return true;
    drawDepths(draw, bounds, moved);
    const auto mayHide = [](const DrawnLeaf& entry) {
        return writesDepth(entry.leaf->_parent) && mayStencilHide(entry);
    };
    if (std::any_of(draw.leaves.begin(), draw.leaves.end(), mayHide))
        reportAll("OpenGL hands over no depths of this framebuffer, so an object that its own stencil test hides takes "
                  "shadows away from what is behind it. Draw that object in a bin above 8.");
    return true;
}

TargetNeeds ComposeBin::needs(const std::vector<DrawnLeaf>& leaves) const {
    TargetNeeds needs;
    if (!_since && _effects.empty() && _jobs.size() == 1 && needsNoMarks(_jobs.front(), leaves) &&
        vastLeaves(leaves, *getStage()->getViewport()).empty())
        return needs;
    needs = needsOf(_jobs);
    needs.reserved = _options.reservedStencilBits;
    needs.depth = !_since;
    needs.ownStencil = _since || (_sharesStencil && needs.reserved == 0);
    if (!_effects.empty()) needs.bounds = wholeScreen;
    return needs;
}

/// As the stage draws. @param leaves  drawn since.
bool ComposeBin::isStencilZero(const std::vector<DrawnLeaf>& leaves) const {
    return (getStage()->getClearMask() & GL_STENCIL_BUFFER_BIT) && getStage()->getClearStencil() == 0 &&
           !isModeOn(leaves, GL_STENCIL_TEST);
}

/// All whom it concerns; and those that ask in the stage's later frames, that no work need be done for them.
void ComposeBin::tell(const std::string& cause) {
    for (const FrameReport& report : _waiting) report(cause);
    for (const ShadowJob& job : _jobs) job.report(cause);
    for (const osg::ref_ptr<ViewEffect>& effect : _effects) effect->report(cause);
    const auto isForPrograms = [](const ShadowJob& job) { return job.programMark() != nullptr; };
    const bool served = std::any_of(_jobs.begin(), _jobs.end(), isForPrograms);
    keptBy<StageVerdict>(*getStage()).refuse(!cause.empty() && !served);
}

std::optional<double> ComposeBin::drawStartIfWatched() const {
    const auto isRecorded = [](const ShadowJob& job) { return job.report.diagnosis->isRecorded(); };
    const bool watched =
        std::any_of(_jobs.begin(), _jobs.end(), isRecorded) || (!_jobs.empty() && StageStats(*getStage()).collect());
    return watched ? std::optional<double>(secondsNow()) : std::nullopt;
}

/// All techniques of the stage are composed together.
void ComposeBin::recordDraw(double begin) const {
    const double end = secondsNow();
    std::map<FrameDiagnosis*, unsigned> frames;
    for (const ShadowJob& job : _jobs) frames[job.report.diagnosis.get()] = job.report.frame;
    for (const auto& [technique, frame] : frames) {
        FrameWork work;
        work.frame = frame;
        work.draw = 1000.0 * (end - begin);
        technique->addWork(work);
    }
    StageStats(*getStage()).addTime(_jobs.front().report.frame, "Shadow draw", begin, end);
}

} // namespace gnomon
