// SPDX-License-Identifier: MIT
#include "FlickerRun.h"

#include <gnomon/Convert.h>
#include <gnomon/metrics/PixelSets.h>

namespace gnomon::examples {
namespace {

// A texel of a map of 1024 over the scene is radius / 512; an eighth of it is this of the radius, and as an angle at the
// radius this many degrees.
constexpr double stepShare = 1.0 / 4096.0, stepDegrees = 57.29577951308232 / 4096.0;

/// Sideways and forward, so that both axes of a map are crossed.
SceneCamera shifted(const ChartScene& scene, int step) {
    SceneCamera camera = scene.camera;
    const double by = stepShare * scene.radius * step;
    camera.view.postMult(osg::Matrixd::translate(-by, 0.0, 0.5 * by));
    return camera;
}

/// Without what the meter does not read.
metrics::TruthMaps slim(metrics::TruthMaps maps) {
    maps.blocker = {};
    maps.edgeLength = {};
    return maps;
}

} // namespace

Film::Film(const Yardstick& yardstick, Motion motion, int frames, const std::function<bool()>& stops)
    : _origin(yardstick.truth().origin()) {
    const ChartScene& scene = yardstick.scene();
    for (int k = 0; k < frames && !stops(); ++k) {
        Frame frame;
        frame.camera = motion == Motion::CAMERA ? shifted(scene, k) : scene.camera;
        frame.light = motion == Motion::LIGHT ? movedLight(scene, stepDegrees * k) : scene.light;
        frame.truth = slim(yardstick.truth().maps(frame.camera, frame.light));
        _frames.push_back(std::move(frame));
    }
}

metrics::FlickerMeter Film::measure(Sight& sight, const std::function<bool()>& stops) const {
    metrics::FlickerMeter meter;
    for (const Frame& frame : _frames) {
        if (stops()) break;
        sight.setCamera(frame.camera);
        sight.setLight(frame.light);
        metrics::FlickerFrame seen;
        seen.visibility = sight.visibility().value;
        seen.facing = metrics::pixelSets(frame.truth, seen.visibility).facing;
        seen.clipFromPosition = toGlm(osg::Matrixd::translate(_origin) * frame.camera.view * frame.camera.projection);
        seen.truth = frame.truth;
        meter.add(std::move(seen));
    }
    return meter;
}

} // namespace gnomon::examples
