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

/// What the meter reads.
metrics::TruthMaps slim(const metrics::TruthMaps& maps) {
    metrics::TruthMaps result;
    result.lit = maps.lit;
    result.litCentre = maps.litCentre;
    result.undecided = maps.undecided;
    result.receiver = maps.receiver;
    result.position = maps.position;
    return result;
}

} // namespace

metrics::FlickerFrame flickerFrame(const metrics::TruthMaps& truth, const osg::Vec3d& origin, const SceneCamera& camera,
                                   metrics::Picture visibility, metrics::Mask facing) {
    metrics::FlickerFrame frame;
    frame.visibility = std::move(visibility);
    frame.truth = slim(truth);
    frame.facing = std::move(facing);
    frame.clipFromPosition = toGlm(osg::Matrixd::translate(origin) * camera.view * camera.projection);
    return frame;
}

Film::Film(const Yardstick& yardstick, Motion motion, int frames, const std::function<bool()>& stops)
    : _origin(yardstick.truth().origin()) {
    const ChartScene& scene = yardstick.scene();
    for (int k = 0; k < frames && !stops(); ++k) {
        Frame frame;
        frame.camera = motion == Motion::CAMERA ? shifted(scene, k) : scene.camera;
        frame.light = motion == Motion::LIGHT ? movedLight(scene, stepDegrees * k) : scene.light;
        frame.truth = yardstick.truth().maps(frame.camera, frame.light);
        frame.truth.blocker = {}; // nobody reads them here
        frame.truth.edgeLength = {};
        _frames.push_back(std::move(frame));
    }
}

metrics::FlickerMeter Film::measure(Sight& sight, const std::function<bool()>& stops) const {
    metrics::FlickerMeter meter;
    for (const Frame& frame : _frames) {
        if (stops()) break;
        sight.setCamera(frame.camera);
        sight.setLight(frame.light);
        metrics::Picture visibility = sight.visibility().value;
        metrics::Mask facing = metrics::pixelSets(frame.truth, visibility).facing;
        meter.add(flickerFrame(frame.truth, _origin, frame.camera, std::move(visibility), std::move(facing)));
    }
    return meter;
}

} // namespace gnomon::examples
