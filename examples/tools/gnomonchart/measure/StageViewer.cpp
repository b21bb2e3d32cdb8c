// SPDX-License-Identifier: MIT
#include "StageViewer.h"
#include "ImageFile.h"

#include <osg/DisplaySettings>

#include <algorithm>
#include <cctype>
#include <cmath>
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

unsigned char byteOf(double value) {
    return static_cast<unsigned char>(value > 0.0 ? std::lround(255.0 * std::min(value, 1.0)) : 0); // NaN is black
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
    if (camera.fraction > 0.0)
        _viewer.getCamera()->setViewport(new osg::Viewport(
            camera.fraction, camera.fraction, camera.width + camera.fraction, camera.height + camera.fraction));
    _viewer.setSceneData(_staging->shown());
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

ShadedPicture coloursOf(const osg::Image& image) {
    ShadedPicture picture(image.s(), image.t());
    auto colour = picture.cells.begin();
    readColours(image, [&](float r, float g, float b) { *colour++ = glm::dvec3(double(r), double(g), double(b)); });
    return picture;
}

osg::ref_ptr<osg::Image> bytesOf(const ShadedPicture& picture) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(picture.width, picture.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c)
                image->data(static_cast<unsigned>(x), static_cast<unsigned>(y))[c] = byteOf(picture.at(x, y)[c]);
    return image;
}

std::string fileName(const std::vector<std::string>& parts, const std::string& ending) {
    std::string name;
    for (const std::string& part : parts) {
        if (!name.empty()) name += '-';
        for (const char c : part)
            name += std::isalnum(static_cast<unsigned char>(c))
                        ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                        : '-';
    }
    return name + ending;
}

Sight::Sight(const Contender& contender, const ChartScene& scene)
    : _viewer(contender.stage(scene, Look::VISIBILITY), scene.camera, StageViewer::Colour::FLOATS) {
    for (int frame = 0; frame < scene.framesBefore; ++frame) _viewer.draw();
}

metrics::Picture Sight::frame() {
    _viewer.draw();
    return greysOf(*_viewer.image());
}

metrics::Visibility Sight::visibility() {
    _viewer.staging().diagnose(); // so that the frame looks for all causes
    const metrics::Picture casting = frame();
    _diagnosis = _viewer.staging().diagnose();
    _decisions = _viewer.staging().decisions();
    _viewer.staging().setCasting(false);
    const metrics::Picture notCasting = frame();
    _viewer.staging().setCasting(true);
    return metrics::visibility(casting, notCasting, metrics::Picture(casting.width, casting.height));
}

ShadedPicture shadedPicture(const Contender& contender, const ChartScene& scene, bool shines) {
    StageViewer viewer(contender.stage(scene, Look::SHADED), scene.camera, StageViewer::Colour::FLOATS);
    viewer.staging().setShining(shines);
    viewer.draw();
    return coloursOf(*viewer.image());
}

} // namespace gnomon::examples
