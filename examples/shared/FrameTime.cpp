// SPDX-License-Identifier: MIT
#include "FrameTime.h"

#include <osg/GL>
#include <osgViewer/View>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <malloc.h>
#include <sstream>

namespace gnomon::examples {
namespace {

using Clock = std::chrono::steady_clock;

double processorMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

/// Freed memory stays with the process. To give it back and have it again is a page fault for each 4 KiB: for vertices of
/// a large mesh milliseconds a frame in llvmpipe, or none, by what happens to lie above them.
bool keepFreedMemory() {
    constexpr int most = 32 << 20; // bytes: glibc takes no more
    return mallopt(M_MMAP_THRESHOLD, most) && mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
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

template <class Act>
class Callback : public osg::Camera::DrawCallback {
public:
    explicit Callback(Act act) : _act(std::move(act)) {}
    void operator()(osg::RenderInfo&) const override {
        glFinish();
        _act();
    }

private:
    Act _act;
};

template <class Act>
osg::ref_ptr<osg::Camera::DrawCallback> callback(Act act) {
    return new Callback<Act>(std::move(act));
}

} // namespace

FrameTime timeFrame(osgViewer::Viewer& viewer, double simulationTime) {
    [[maybe_unused]] static const bool kept = keepFreedMemory();
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

struct DrawTime::Start {
    Clock::time_point start;
    std::atomic<double> milliseconds{0.0};
};

DrawTime::DrawTime() : _clock(std::make_shared<Start>()) {}

std::string DrawTime::line() const {
    const double time = _clock->milliseconds;
    if (!_on || !(time > 0.0)) return "";
    std::ostringstream text;
    text.precision(3);
    text << "drawn in " << time << " ms, " << std::lround(1000.0 / time) << " frames/s";
    return text.str();
}

bool DrawTime::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    auto* view = dynamic_cast<osgViewer::View*>(&action);
    const bool key = event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN && event.getKey() == 'm';
    if (event.getHandled() || !key || !view) return false;
    _on = !_on;
    osg::Camera& camera = *view->getCamera();
    if (_on) {
        camera.setInitialDrawCallback(callback([clock = _clock] { clock->start = Clock::now(); }));
        camera.setFinalDrawCallback(callback([clock = _clock] {
            clock->milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - clock->start).count();
        }));
    } else {
        camera.setInitialDrawCallback(nullptr);
        camera.setFinalDrawCallback(nullptr);
    }
    return true;
}

void DrawTime::getUsage(osg::ApplicationUsage& usage) const {
    usage.addKeyboardMouseBinding("m", "Time that a frame takes to draw.");
}

} // namespace gnomon::examples
