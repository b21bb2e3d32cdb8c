// SPDX-License-Identifier: MIT
#pragma once
#include "CommandLine.h"
#include "SceneWindow.h"

#include <osgGA/GUIEventHandler>

#include <functional>

namespace gnomon::examples {

/// Tells each frame how long the sun has run: the window's seconds times a speed.
class RunningSun : public osgGA::GUIEventHandler {
public:
    /// @param speed  1 is the clock's. @param run  takes seconds of the sun's since the frame before.
    RunningSun(double speed, std::function<void(double)> run) : _speed(speed), _run(std::move(run)) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
        if (event.getEventType() != osgGA::GUIEventAdapter::FRAME) return false;
        if (_last >= 0.0) _run((event.getTime() - _last) * _speed);
        _last = event.getTime();
        return false;
    }

private:
    double _speed;
    std::function<void(double)> _run;
    double _last = -1.0; ///< seconds, the window's; below 0 before the first frame.
};

/// Lets a window's sun run; at a speed of 0 it stands still.
inline void runSun(SceneWindow& window, double speed, std::function<void(double)> run) {
    if (speed > 0.0) window.add(*osg::ref_ptr<RunningSun>(new RunningSun(speed, std::move(run))));
}

/// --sun-speed of the programs with a window.
inline Option sunSpeedOption(double& into) {
    return {"--sun-speed", "N", "speed of the sun as a multiple of the clock's, 0 to 100000", "0, the sun stands still",
            [&into](const std::string& text) { into = readNumber(text, 0.0, 1e5); }};
}

} // namespace gnomon::examples
