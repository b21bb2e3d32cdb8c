// SPDX-License-Identifier: MIT
#include "DrawTime.h"

#include <osg/GL>
#include <osgViewer/View>

#include <atomic>
#include <chrono>
#include <cmath>
#include <sstream>

namespace gnomon::examples {
namespace {

using Now = std::chrono::steady_clock;

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

struct DrawTime::Clock {
    Now::time_point start;
    std::atomic<double> milliseconds{0.0};
};

DrawTime::DrawTime() : _clock(std::make_shared<Clock>()) {}

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
        camera.setInitialDrawCallback(callback([clock = _clock] { clock->start = Now::now(); }));
        camera.setFinalDrawCallback(callback([clock = _clock] {
            clock->milliseconds = std::chrono::duration<double, std::milli>(Now::now() - clock->start).count();
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
