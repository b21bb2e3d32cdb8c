// SPDX-License-Identifier: MIT
#include "Yardstick.h"
#include "Contender.h"
#include "ImageFile.h"

#include <gnomon/NamedNode.h>
#include <metrics/PixelSets.h>

#include <glm/common.hpp>
#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr double contactShare = 0.01; // of the scene's radius

ShadedPicture mixed(const ShadedPicture& lit, const ShadedPicture& dark, const metrics::TruthMaps& maps) {
    ShadedPicture result = lit;
    for (std::size_t i = 0; i < lit.cells.size(); ++i)
        if (maps.receiver.cells[i] != 0) result.cells[i] = glm::mix(dark.cells[i], lit.cells[i], maps.lit.cells[i]);
    return result;
}

/// Share of R+ where the centre's ray says other than most of the pixel's.
double misclassifiedFloor(const metrics::TruthMaps& maps, const metrics::Mask& facing) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < facing.cells.size(); ++i)
        wrong += facing.cells[i] && (maps.litCentre.cells[i] != 0) != (maps.lit.cells[i] >= 0.5);
    const std::size_t all = metrics::count(facing);
    return all ? static_cast<double>(wrong) / static_cast<double>(all) : 0.0;
}

/// Degrees; 0 of an orthographic camera.
double fovyOf(const osg::Matrixd& projection) {
    double fovy = 0.0, aspect, near, far;
    return projection.getPerspective(fovy, aspect, near, far) ? fovy : 0.0;
}

std::string numbers(const std::initializer_list<double>& values) {
    std::ostringstream out;
    out.precision(10);
    for (const double value : values) out << (value == *values.begin() && out.str().empty() ? "" : ",") << value;
    return out.str();
}

} // namespace

/// What the light gives each pixel of the round body on which nothing else casts.
static metrics::Picture smoothLight(const ChartScene& scene, const SceneTruth& truth, osg::Node& seen) {
    const std::optional<NamedNode> body = findNamed(seen, scene.round);
    if (!body) throw std::invalid_argument("the scene has no body named \"" + scene.round + "\".");
    StageViewer viewer(plainContender().stage(scene, Look::VISIBILITY), scene.camera, StageViewer::Colour::FLOATS);
    for (int frame = 0; frame <= scene.framesBefore; ++frame) viewer.draw();
    metrics::Picture light = greysOf(*viewer.image());
    const metrics::Mask alone = truth.alone(scene.camera, scene.light, *body->node);
    for (std::size_t i = 0; i < light.cells.size(); ++i)
        if (!alone.cells[i]) light.cells[i] = 0.0;
    return light;
}

metrics::Visibility raysOf(const metrics::Mask& lit) {
    metrics::Visibility result;
    result.value = metrics::Picture(lit.width, lit.height);
    for (std::size_t i = 0; i < result.value.cells.size(); ++i) result.value.cells[i] = lit.cells[i] ? 1.0 : 0.0;
    return result;
}

Yardstick::Yardstick(const ChartScene& scene, bool withDisc, osg::Node* seen)
    : _scene(scene),
      _truth(seen ? *seen : *scene.content, seen ? Clear::HIDES : Clear::PASSES),
      _maps(_truth.maps(scene.camera, scene.light)) {
    if (withDisc && scene.light.w() == 0.0) _maps.litByDisc = _truth.litByDisc(scene.camera, scene.light);
    if (!scene.round.empty()) _maps.smoothLight = smoothLight(scene, _truth, seen ? *seen : *scene.content);
    const metrics::Picture measured(scene.camera.width, scene.camera.height, 1.0);
    _agreeing = metrics::pixelSets(_maps, measured).agreeing;
}

const ShadedPicture& Yardstick::shaded() const {
    if (_shaded.empty())
        _shaded = mixed(shadedPicture(plainContender(), _scene), shadedPicture(plainContender(), _scene, false), _maps);
    return _shaded;
}

metrics::CauseLimits Yardstick::limits() const {
    metrics::CauseLimits limits;
    limits.contact = contactShare * _scene.radius;
    return limits;
}

void Yardstick::describe(ChartSceneResult& into) const {
    const metrics::Visibility rays = raysOf(_maps.litCentre);
    const metrics::Mask facing = metrics::pixelSets(_maps, rays.value).facing;
    into.name = _scene.name;
    into.title = _scene.title;
    into.triangles = _truth.triangles();
    into.misclassifiedFloor = misclassifiedFloor(_maps, facing);
    if (const auto boundary = metrics::boundaryDistance(rays.value, _maps.lit, facing))
        into.boundaryFloor = boundary->p95;
    osg::Vec3d eye, center, up;
    _scene.camera.view.getLookAt(eye, center, up);
    const osg::Vec4d& light = _scene.light;
    into.view = {{"--light", numbers({light.x(), light.y(), light.z(), light.w()})},
                 {"--eye", numbers({eye.x(), eye.y(), eye.z()})},
                 {"--center", numbers({center.x(), center.y(), center.z()})},
                 {"--fovy", numbers({fovyOf(_scene.camera.projection)})},
                 {"--size", std::to_string(_scene.camera.width) + "x" + std::to_string(_scene.camera.height)}};
}

} // namespace gnomon::examples
