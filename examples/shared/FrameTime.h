// SPDX-License-Identifier: MIT
#pragma once
#include <osgViewer/Viewer>

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

} // namespace gnomon::examples
