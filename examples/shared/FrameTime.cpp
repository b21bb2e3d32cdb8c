// SPDX-License-Identifier: MIT
#include "FrameTime.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace gnomon::examples {
namespace {

using Clock = std::chrono::steady_clock;

double processorMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

/// OSG leaves no context current between frames.
void finish(osgViewer::Viewer& viewer) {
    viewer.getCamera()->getGraphicsContext()->makeCurrent();
    glFinish();
}

/// Value below which the share `part` of the sorted values lies.
double quantile(const std::vector<double>& sorted, double part) {
    const double place = part * static_cast<double>(sorted.size() - 1);
    const std::size_t below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

} // namespace

FrameTime timeFrame(osgViewer::Viewer& viewer, double simulationTime) {
    if (!viewer.isRealized()) viewer.realize();
    finish(viewer);
    const double processor = processorMilliseconds();
    const Clock::time_point start = Clock::now();
    viewer.frame(simulationTime);
    finish(viewer);
    const std::chrono::duration<double, std::milli> wall = Clock::now() - start;
    return {wall.count(), processorMilliseconds() - processor};
}

Quartiles quartiles(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

} // namespace gnomon::examples
