// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Stats>
#include <osg/Timer>
#include <osgUtil/RenderStage>

#include <string>
#include <vector>

namespace gnomon {

/// Seconds, of osg::Timer.
inline double secondsNow() { return osg::Timer::instance()->time_s(); }

/// OSG's statistics of a stage's camera and of its view, as long as the camera's collect. See addShadowStats().
class StageStats {
public:
    explicit StageStats(const osgUtil::RenderStage& stage);

    bool collect() const { return !_all.empty(); }
    /// Notes a stretch of time. Several in one frame: the first begin, the last end, and the sum.
    /// @param what   "Shadow cull" or "Shadow draw".
    /// @param begin  see secondsNow().
    void addTime(unsigned frame, const std::string& what, double begin, double end) const;
    /// Adds to a count.
    void addCount(unsigned frame, const std::string& what, double count) const;

private:
    std::vector<osg::Stats*> _all;
};

} // namespace gnomon
