// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Camera>
#include <osgGA/GUIEventHandler>
#include <osgViewer/Viewer>

#include <memory>
#include <string>
#include <vector>

namespace gnomon::examples {

/// How long something took, in milliseconds: by the clock, and of the processor over all threads of the process.
struct FrameTime {
    double wall = 0.0, processor = 0.0;
};

/// Draws one frame between two glFinish(): nothing drawn before counts, all of this frame does. The viewer has one
/// context, which is current afterwards. @param simulationTime  seconds, as osgViewer::ViewerBase::frame() takes it.
FrameTime timeFrame(osgViewer::Viewer& viewer, double simulationTime = USE_REFERENCE_TIME);

struct Quartiles {
    double q1 = 0.0, median = 0.0, q3 = 0.0;
};

/// Between neighbours by straight line. @param values  any order; zeros where there are none.
Quartiles quartiles(std::vector<double> values);

/// How long a window's frames take to draw, between two glFinish(), switched on and off by the key m.
class DrawTime : public osgGA::GUIEventHandler {
public:
    DrawTime();

    /// "drawn in 12.3 ms, 81 frames/s" of the last frame; empty while off.
    std::string line() const;

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    void getUsage(osg::ApplicationUsage& usage) const override;

private:
    struct Start;

    std::shared_ptr<Start> _clock; ///< shared with the camera's callbacks.
    bool _on = false;
};

} // namespace gnomon::examples
