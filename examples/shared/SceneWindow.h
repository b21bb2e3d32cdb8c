// SPDX-License-Identifier: MIT
#pragma once
#include "CommandLine.h"
#include "Hud.h"
#include "SceneSetup.h"

#include <osgViewer/Viewer>

#include <functional>
#include <string>

namespace gnomon::examples {

/// What a window says of its program.
struct WindowNames {
    std::string program; ///< also the window's title, and how its pictures' names begin.
    std::string does;    ///< "shows scene files with shadows."
    std::string without; ///< what draws where there is no window.
};

/// A window on one scene, with osgviewer's keys, a program's own, and its text.
class SceneWindow {
public:
    /// @param setup  gets the text's camera; outlives it. @param keys  before osgviewer's.
    /// @throws std::invalid_argument or std::runtime_error, one sentence, if the options do not suit the scene or no
    /// window can be had.
    SceneWindow(const WindowNames& names, const ViewOptions& options, SceneSetup& setup, Hud& hud,
                osgGA::GUIEventHandler& keys);

    /// Another handler, after the program's own keys and before the ways to move.
    void add(osgGA::GUIEventHandler& handler) { _viewer.addEventHandler(&handler); }
    /// Until the user ends it. @return the program's exit status.
    int run() { return _viewer.run(); }

private:
    void openWindow(const WindowNames& names, const ViewOptions& options);
    void addHandlers(const WindowNames& names, Hud& hud, osgGA::GUIEventHandler& keys);
    void addOverlays(const WindowNames& names, Hud& hud);
    void placeHands(const ViewOptions& options, const SceneSetup& setup);

    osg::ref_ptr<osg::ApplicationUsage> _usage;
    osgViewer::Viewer _viewer;
};

/// osgviewer's keys that there are, a line each, for --help.
std::string windowKeysHelp(const std::string& program);

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
