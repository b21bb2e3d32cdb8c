// SPDX-License-Identifier: MIT
#include "FlickerRun.h"

#include <gnomon/Convert.h>
#include <metrics/ShadowMetrics.h>

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

// A texel of a map of 1024 over the scene is radius / 512; an eighth of it is this of the radius, and as an angle at the
// radius this many degrees.
constexpr double stepShare = 1.0 / 4096.0, stepDegrees = 57.29577951308232 / 4096.0;
constexpr double pixelShare = 1.0 / 8.0; // of a pixel, a step

/// Sideways and forward, so that both axes of a map are crossed.
SceneCamera shifted(const ChartScene& scene, double by) {
    SceneCamera camera = scene.camera;
    camera.view.postMult(osg::Matrixd::translate(-by, 0.0, 0.5 * by));
    return camera;
}

/// Of what the still picture shows, along the view; 0 if it shows nothing.
double medianDepth(const Yardstick& yardstick) {
    const metrics::TruthMaps& maps = yardstick.maps();
    const glm::dmat4 eyeFromPosition =
        toGlm(osg::Matrixd::translate(yardstick.truth().origin()) * yardstick.scene().camera.view);
    std::vector<double> depths;
    for (std::size_t i = 0; i < maps.position.cells.size(); ++i)
        if (maps.receiver.cells[i] > 0)
            depths.push_back(-(eyeFromPosition * glm::dvec4(maps.position.cells[i], 1.0)).z);
    if (depths.empty()) return 0.0;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

/// The camera's steps by parts of a pixel.
class PixelSteps {
public:
    PixelSteps(const Yardstick& yardstick, int frames) : _scene(yardstick.scene()), _walked(frames / 2) {
        const SceneCamera& camera = _scene.camera;
        const double depth = medianDepth(yardstick);
        const double w = camera.projection(3, 3) - camera.projection(2, 3) * depth;
        _length = pixelShare * 2.0 * w / (camera.projection(0, 0) * camera.width);
        _angle = _length / std::max(depth, _scene.radius); // without perspective the eye may be among what is seen
    }

    SceneCamera camera(int frame) const {
        SceneCamera camera = shifted(_scene, _length * std::min(frame, _walked));
        camera.view.postMult(osg::Matrixd::rotate(_angle * std::max(frame - _walked, 0), 0.0, 1.0, 0.0));
        return camera;
    }

private:
    const ChartScene& _scene;
    int _walked;
    double _length, _angle;
};

} // namespace

Film::Film(const Yardstick& yardstick, Motion motion, int frames, const std::function<bool()>& stops)
    : _origin(yardstick.truth().origin()) {
    const ChartScene& scene = yardstick.scene();
    const PixelSteps pixels(yardstick, frames);
    for (int k = 0; k < frames && !stops(); ++k) {
        Frame frame;
        frame.camera = motion == Motion::CAMERA   ? shifted(scene, stepShare * scene.radius * k)
                       : motion == Motion::PIXELS ? pixels.camera(k)
                                                  : scene.camera;
        frame.light = motion == Motion::LIGHT ? movedLight(scene, stepDegrees * k) : scene.light;
        frame.truth = yardstick.truth().maps(frame.camera, frame.light);
        frame.truth.blocker = {}; // nobody reads them here
        frame.truth.edgeLength = {};
        _frames.push_back(std::move(frame));
    }
}

metrics::FlickerMeter Film::measure(Sight& sight, const std::function<bool()>& stops, int objects,
                                    std::size_t* turnedAwayWrong) const {
    metrics::FlickerMeter meter;
    for (const Frame& frame : _frames) {
        if (stops()) break;
        sight.setCamera(frame.camera);
        sight.setLight(frame.light);
        metrics::Picture visibility = sight.visibility().value;
        metrics::PixelSets sets = metrics::pixelSets(frame.truth, visibility);
        for (std::size_t i = 0; i < sets.facing.cells.size(); ++i)
            if (frame.truth.receiver.cells[i] > objects) sets.facing.cells[i] = sets.turnedAway.cells[i] = 0;
        if (turnedAwayWrong)
            *turnedAwayWrong =
                std::max(*turnedAwayWrong, metrics::turnedAwayWrong(visibility, frame.truth, sets.turnedAway));
        const osg::Matrixd clip = osg::Matrixd::translate(_origin) * frame.camera.view * frame.camera.projection;
        meter.add({std::move(visibility), frame.truth, std::move(sets.facing), toGlm(clip)});
    }
    return meter;
}

} // namespace gnomon::examples
