// SPDX-License-Identifier: MIT
#include "StageViewer.h"

#include <osg/DisplaySettings>

#include <cstdlib>

namespace gnomon::examples {
namespace {

HeadlessContext::Options optionsOf(const SceneCamera& camera, StageViewer::Colour colour) {
    HeadlessContext::Options options;
    options.width = camera.width;
    options.height = camera.height;
    options.floatColor = colour == StageViewer::Colour::FLOATS;
    return options;
}

/// Near and far stay as they are given, whatever the content; nothing is left out for being small.
void settle(osg::Camera& camera) {
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
}

} // namespace

StageViewer::StageViewer(std::unique_ptr<Staging> staging, const SceneCamera& camera, Colour colour)
    : _context(optionsOf(camera, colour)), _staging(std::move(staging)) {
    _viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    _context.attach(*_viewer.getCamera());
    settle(*_viewer.getCamera());
    _viewer.getCamera()->setClearColor(_staging->background());
    setCamera(camera);
    _viewer.setSceneData(&_staging->root());
}

void StageViewer::setCamera(const SceneCamera& camera) {
    _viewer.getCamera()->setViewMatrix(camera.view);
    _viewer.getCamera()->setProjectionMatrix(camera.projection);
}

void StageViewer::draw() { time(); }

FrameTime StageViewer::time() {
    if (_first) std::srand(1); // SoftShadowMap draws its jitter in its first frame
    _first = false;
    return timeFrame(_viewer, 0.0);
}

} // namespace gnomon::examples
