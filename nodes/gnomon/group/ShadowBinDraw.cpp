// SPDX-License-Identifier: MIT
// ShadowBin: its part of a draw traversal, and what it did, for those who ask. See ShadowReport and addShadowStats().
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/compositor/Compositor.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/compositor/StencilMarks.h>
#include <gnomon/group/ShadowBin.h>

#include <osg/Camera>
#include <osg/Stats>
#include <osg/Stencil>
#include <osg/Timer>
#include <osg/View>
#include <osg/Viewport>
#include <osgUtil/RenderStage>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gnomon {
namespace {

/// Stencil bits that the compositor takes: one a light, and a scratch bit; one more for lights that fade.
std::size_t ownBits(const std::vector<ShadowJob>& jobs) {
    if (std::none_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.marks->kind() == Mark::Kind::Counts; }))
        return 8;
    if (std::any_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.fades(); })) return mostRelitLights + 2;
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

bool mayStencilHide(const DrawnLeaf& entry) {
    const osgUtil::StateGraph* graph = entry.leaf->_parent;
    if (!isOn(graph, GL_STENCIL_TEST) || !writesDepth(graph)) return false;
    const osg::StateAttribute* test = resolvedAttribute(graph, osg::StateAttribute::STENCIL);
    const auto* oneSided = dynamic_cast<const osg::Stencil*>(test); // the other has two tests
    return oneSided ? oneSided->getFunction() != osg::Stencil::ALWAYS : test != nullptr;
}

/// OSG's statistics of a stage's camera and of its view, as long as the camera's collect. See addShadowStats().
class StageStats {
public:
    explicit StageStats(const osgUtil::RenderStage& stage);

    bool collect() const { return !_all.empty(); }
    /// Notes a stretch of time. Several in one frame: the first begin, the last end, and the sum.
    /// @param what   "Shadow cull" or "Shadow draw".
    /// @param begin  seconds, of osg::Timer.
    void addTime(unsigned frame, const std::string& what, double begin, double end) const;
    /// Adds to a count.
    void addCount(unsigned frame, const std::string& what, double count) const;

private:
    std::vector<osg::Stats*> _all;
};

double valueOf(const osg::Stats& stats, unsigned frame, const std::string& name, double otherwise) {
    double value = otherwise;
    stats.getAttribute(frame, name, value);
    return value;
}

StageStats::StageStats(const osgUtil::RenderStage& stage) {
    const osg::Camera* camera = stage.getCamera();
    osg::Stats* own = camera ? const_cast<osg::Camera*>(camera)->getStats() : nullptr;
    if (!own || !(own->collectStats("rendering") || own->collectStats("gnomon"))) return;
    _all.push_back(own);
    osg::View* view = const_cast<osg::Camera*>(camera)->getView();
    if (view && view->getStats() && view->getStats() != own) _all.push_back(view->getStats());
}

void StageStats::addTime(unsigned frame, const std::string& what, double begin, double end) const {
    for (osg::Stats* stats : _all) {
        stats->setAttribute(frame, what + " begin time", valueOf(*stats, frame, what + " begin time", begin));
        stats->setAttribute(frame, what + " end time", end);
    }
    addCount(frame, what + " time taken", end - begin);
}

void StageStats::addCount(unsigned frame, const std::string& what, double count) const {
    for (osg::Stats* stats : _all) stats->setAttribute(frame, what, valueOf(*stats, frame, what, 0.0) + count);
}

double now() { return osg::Timer::instance()->time_s(); }
double milliseconds(double begin, double end) { return 1000.0 * (end - begin); }

void addMarks(FrameWork& work, const std::vector<ShadowJob>& jobs, std::size_t from, const osg::Viewport& viewport) {
    const glm::dvec2 pixels(viewport.width(), viewport.height());
    for (std::size_t i = from; i < jobs.size(); ++i) {
        const ScreenRect& bounds = jobs[i].marks->screenBounds;
        const glm::dvec2 size = 0.5 * (bounds.high - bounds.low) * pixels;
        work.pixels += size.x * size.y;
        ++work.marks;
    }
}

} // namespace

void ShadowBin::drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    if (!isIdle()) {
        const std::optional<double> begin = drawStartIfWatched();
        tell(compose(renderInfo, previous));
        if (begin) recordDraw(*begin);
        if (holdsFrame()) renderInfo.getState()->decrementDynamicObjectCount();
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
    learnQuadCut(); // for the next cull
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
        if (target.lacksDepth()) {
            drawDepths(draw, needs.bounds);
            if (std::any_of(draw.leaves.begin(), draw.leaves.end(), mayStencilHide))
                for (const ShadowJob& job : _jobs)
                    job.report(
                        "OpenGL hands over no depths of this framebuffer, so an object that its own stencil test hides "
                        "takes shadows away from what is behind it. Draw that object in a bin above 8.");
        }
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

std::optional<ShadowBin::Start> ShadowBin::startIfWatched(const EnlistedTechnique& entry) const {
    if (!entry.technique->isRecorded() && !StageStats(*getStage()).collect()) return std::nullopt;
    return Start{now(), _jobs.size(), _lateJobs.size()};
}

void ShadowBin::recordCull(const EnlistedTechnique& entry, const Start& start, std::size_t lights) const {
    const double end = now();
    FrameWork work;
    work.frame = entry.frameNumber;
    work.lights = static_cast<unsigned>(lights);
    addMarks(work, _jobs, start.jobs, *getStage()->getViewport());
    addMarks(work, _lateJobs, start.lateJobs, *getStage()->getViewport());
    work.cull = milliseconds(start.time, end);
    entry.technique->record(work);
    const StageStats stats(*getStage());
    stats.addTime(work.frame, "Shadow cull", start.time, end);
    stats.addCount(work.frame, "Shadow marks", work.marks);
}

std::optional<double> ShadowBin::drawStartIfWatched() const {
    const auto isRecorded = [](const ShadowJob& job) { return job.report.diagnosis->isRecorded(); };
    const bool watched =
        std::any_of(_jobs.begin(), _jobs.end(), isRecorded) || (!_jobs.empty() && StageStats(*getStage()).collect());
    return watched ? std::optional<double>(now()) : std::nullopt;
}

/// All techniques of the stage are composed together.
void ShadowBin::recordDraw(double begin) const {
    const double end = now();
    std::map<FrameDiagnosis*, unsigned> frames;
    for (const ShadowJob& job : _jobs) frames[job.report.diagnosis.get()] = job.report.frame;
    for (const auto& [technique, frame] : frames) {
        FrameWork work;
        work.frame = frame;
        work.draw = milliseconds(begin, end);
        technique->addWork(work);
    }
    StageStats(*getStage()).addTime(_jobs.front().report.frame, "Shadow draw", begin, end);
}

} // namespace gnomon
