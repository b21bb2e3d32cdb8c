// SPDX-License-Identifier: MIT
#pragma once
#include "RunClock.h"
#include "RunOptions.h"
#include "ShadowedScene.h"

#include <osgViewer/ViewerEventHandlers>

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace gnomon::examples {

/// All that gnomonrun's library does in a program. One a process; used by the thread that runs the viewers.
class ProgramRun {
public:
    /// Null if gnomonrun did not start the program.
    static ProgramRun* ofProcess();

    /// What a view is to show in the place of `scene`.
    osg::Node* shadowed(osg::Node* scene);
    /// The scene's time in seconds for the next frame: with --frames, 1/60 s after the last one, so that each run draws the same.
    /// @param wanted  what the program asks for; a time of its own stays.
    double timeOfFrame(double wanted) const;
    void beforeFrame(osgViewer::ViewerBase& viewer);
    /// Ends the process after the last frame asked for. @param draw  draws a frame as the program does.
    void afterFrame(osgViewer::ViewerBase& viewer, const std::function<void()>& draw);
    /// What was met, once: gnomonrun reads it when the program has ended.
    void met(const std::string& what);

private:
    explicit ProgramRun(const RunOptions& options);

    void guarded(const std::function<void()>& step);
    void choose();
    void tryTechnique(std::size_t number);
    void sayCauses();
    void capture(osgViewer::ViewerBase& viewer);
    [[noreturn]] void compare(osgViewer::ViewerBase& viewer, const std::function<void()>& draw);
    void sayCosts();
    [[noreturn]] void end(int status);
    std::string drawn() const;

    RunOptions _options;
    std::vector<std::unique_ptr<ShadowedScene>> _scenes;
    std::set<std::string> _met, _said;
    RunClock _clock;
    osg::ref_ptr<osgViewer::ScreenCaptureHandler>
        _capture; ///< its callback takes itself from the camera while it runs.
    int _frame = 0;
    bool _shown = true;
};

} // namespace gnomon::examples
