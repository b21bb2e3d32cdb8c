// SPDX-License-Identifier: MIT
#include <gnomon/group/StageStats.h>

#include <osg/Camera>
#include <osg/View>

namespace gnomon {
namespace {

double valueOf(const osg::Stats& stats, unsigned frame, const std::string& name, double otherwise) {
    double value = otherwise;
    stats.getAttribute(frame, name, value);
    return value;
}

} // namespace

StageStats::StageStats(const osgUtil::RenderStage& stage) {
    const osg::Camera* camera = stage.getCamera();
    osg::Stats* ofCamera = camera ? const_cast<osg::Camera*>(camera)->getStats() : nullptr;
    if (!ofCamera || !(ofCamera->collectStats("rendering") || ofCamera->collectStats("gnomon"))) return;
    _all.push_back(ofCamera);
    osg::View* view = const_cast<osg::Camera*>(camera)->getView();
    if (view && view->getStats() && view->getStats() != ofCamera) _all.push_back(view->getStats());
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

} // namespace gnomon
