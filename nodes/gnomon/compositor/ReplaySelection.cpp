// SPDX-License-Identifier: MIT
#include <gnomon/compositor/ReplaySelection.h>

#include <osg/Geometry>

#include <algorithm>

namespace gnomon {
namespace {

bool isReceiver(const std::vector<const ShadowJob*>& jobs, const osgUtil::RenderLeaf* leaf) {
    return std::any_of(jobs.begin(), jobs.end(), [leaf](const ShadowJob* job) { return job->isNamed(leaf); });
}

unsigned lightsLostBy(const osgUtil::RenderLeaf* leaf, const std::vector<const ShadowJob*>& jobs) {
    unsigned lost = 0;
    for (const ShadowJob* job : jobs)
        if (job->isReceiver(*leaf)) lost |= 1u << job->light;
    return lost;
}

/// Index of the last receiver, if only receivers and what is drawn over or before them can show where marks are.
/// The number of leaves if that cannot be told.
std::size_t lastReceiver(const std::vector<DrawnLeaf>& leaves, const std::vector<const ShadowJob*>& jobs,
                         PlainTest& plain) {
    if (std::any_of(jobs.begin(), jobs.end(), [](const ShadowJob* job) { return !job->receiverNamed; }))
        return leaves.size();
    std::size_t last = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (!isReceiver(jobs, leaves[i].leaf)) continue;
        if (!plain(*leaves[i].leaf)) return leaves.size();
        last = i;
    }
    return last;
}

} // namespace

std::vector<ReplayedLeaf> notOfView(const ShadowJob& job, const std::vector<DrawnLeaf>& leaves) {
    TouchTest touches(job.mark->screenBounds);
    std::vector<ReplayedLeaf> result;
    for (const DrawnLeaf& entry : leaves)
        if (!job.isOfView(*entry.leaf) && touches(*entry.leaf)) result.push_back({entry, 0});
    return result;
}

std::vector<ReplayedLeaf> leavesToReplay(const CompositorStage& draw, const std::vector<const ShadowJob*>& jobs,
                                         const ScreenRect& bounds) {
    const std::vector<DrawnLeaf>& leaves = draw.leaves;
    const bool filter = draw.options.filter;
    PlainTest plain;
    TouchTest touches(bounds);
    const std::size_t last = filter ? lastReceiver(leaves, jobs, plain) : leaves.size();
    std::vector<ReplayedLeaf> result;
    const DrawnLeaf* own = nullptr; // draws itself and is left out: it may have set the colour of what has none
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const osgUtil::RenderLeaf& leaf = *leaves[i].leaf;
        if (i > last && plain(leaf)) continue;
        const osg::Geometry* geometry = leaf._drawable->asGeometry();
        const bool replayed = !filter || touches(leaf);
        if (own && replayed && geometry && !geometry->getColorArray()) {
            result.push_back({*own, 0});
            own = nullptr;
        }
        if (replayed) result.push_back({leaves[i], lightsLostBy(&leaf, jobs)});
        if (!geometry) own = replayed ? nullptr : &leaves[i];
    }
    return result;
}

} // namespace gnomon
