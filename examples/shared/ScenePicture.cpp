// SPDX-License-Identifier: MIT
#include "ScenePicture.h"

#include <osg/DisplaySettings>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace gnomon::examples {
namespace {

constexpr double frameRate = 30.0;                 // frames a second of simulation time
constexpr double goldenRatio = 0.6180339887498949; // whose multiples lie evenly between whole numbers

HeadlessContext::Options contextFor(const ViewOptions& view, int stencilBits) {
    HeadlessContext::Options options;
    options.width = view.width;
    options.height = view.height;
    options.stencilBits = stencilBits;
    return options;
}

} // namespace

ScenePicture::ScenePicture(const ViewOptions& view, SceneSetup& setup, int stencilBits)
    : _samples(view.samples), _setup(setup), _context(contextFor(view, stencilBits)) {
    osg::DisplaySettings::instance()->setMinimumNumStencilBits(static_cast<unsigned>(stencilBits));
    _viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    _context.attach(*_viewer.getCamera());
    placeCamera(*_viewer.getCamera(), view, setup);
    _viewer.setSceneData(setup.root);
}

double ScenePicture::nextTime() { return _drawn++ / frameRate; }

/// Of several samples it is the mean of pictures of the same moment, each moved by another part of a pixel: so shadows' edges
/// become smooth, too, whatever draws them, and no context needs to have samples.
osg::ref_ptr<osg::Image> ScenePicture::image() {
    osg::ref_ptr<osg::Image> result = _context.image();
    if (_samples == 1) return result;
    osg::Camera& camera = *_viewer.getCamera();
    const osg::Matrixd projection = camera.getProjectionMatrix();
    std::vector<unsigned short> sums(result->getTotalSizeInBytes(),
                                     static_cast<unsigned short>(_samples / 2)); // rounds
    for (int i = 0; i < _samples; ++i) {
        const double x = (i + 0.5) / _samples - 0.5, y = std::fmod(0.5 + i * goldenRatio, 1.0) - 0.5;
        camera.setProjectionMatrix(projection *
                                   osg::Matrixd::translate(2.0 * x / result->s(), 2.0 * y / result->t(), 0.0));
        _viewer.frame((_drawn - 1) / frameRate);
        const osg::ref_ptr<osg::Image> one = _context.image();
        std::transform(sums.begin(), sums.end(), one->data(), sums.begin(), std::plus<>());
    }
    camera.setProjectionMatrix(projection);
    std::transform(sums.begin(), sums.end(), result->data(),
                   [&](int sum) { return static_cast<unsigned char>(sum / _samples); });
    return result;
}

osg::ref_ptr<osg::Image> ScenePicture::draw(int frames) {
    for (int i = 0; i < frames; ++i) {
        if (i + 1 == frames) _setup.diagnose(); // so that the last frame looks for all causes
        frame();
    }
    return image();
}

} // namespace gnomon::examples
