// SPDX-License-Identifier: MIT
#include "ScenePicture.h"

#include <osg/DisplaySettings>

namespace gnomon::examples {
namespace {

constexpr double frameRate = 30.0; // frames a second of simulation time

HeadlessContext::Options contextFor(const ViewOptions& view, int stencilBits) {
    HeadlessContext::Options options;
    options.width = view.width;
    options.height = view.height;
    options.stencilBits = stencilBits;
    return options;
}

} // namespace

ScenePicture::ScenePicture(const ViewOptions& view, SceneSetup& setup, int stencilBits)
    : _context(contextFor(view, stencilBits)) {
    osg::DisplaySettings::instance()->setMinimumNumStencilBits(static_cast<unsigned>(stencilBits));
    _viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    _context.attach(*_viewer.getCamera());
    placeCamera(*_viewer.getCamera(), view, setup.bounds);
    _viewer.setSceneData(setup.root);
}

osg::ref_ptr<osg::Image> ScenePicture::draw(int frames) {
    for (int i = 0; i < frames; ++i) _viewer.frame(_drawn++ / frameRate);
    return _context.image();
}

} // namespace gnomon::examples
