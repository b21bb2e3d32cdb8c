// SPDX-License-Identifier: MIT
// ShadowBin: what it did, for those who ask. See ShadowReport and addShadowStats().
#include <gnomon/group/ShadowBin.h>
#include <gnomon/group/StageStats.h>

#include <osg/Timer>
#include <osg/Viewport>

#include <map>

namespace gnomon {
namespace {

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
