// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/LightMaps.h>
#include <gnomon/MapMark.h>
#include <gnomon/MapProgram.h>
#include <gnomon/ScreenBounds.h>

#include <OpenThreads/ScopedLock>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned keptCalls = 256; // maps that nobody asked for since are let go

glm::dmat4 eyeFromScene(const ViewFrame& view, const CasterMesh& mesh) {
    return glm::translate(toGlm(view.eyeFromGroup), toGlm(mesh.origin));
}

/// True if what is flat, a ground for one, may stand between the light and any part of what is seen: not if all of that is
/// on the light's side of it, or in it.
bool isBetween(const MapCasters::Box& flat, const glm::dvec4& light, const std::vector<MapReceiver>& receivers,
               const glm::dvec3& reach) {
    const glm::dvec4 half = beyond(flat, light, reach);
    return std::any_of(receivers.begin(), receivers.end(), [&](const MapReceiver& receiver) {
        const auto corners = boxCorners(receiver.low, receiver.high, receiver.sceneFromBox);
        return std::any_of(corners.begin(), corners.end(),
                           [&](const glm::dvec4& corner) { return !(glm::dot(half, corner) < 0.0); });
    });
}

template <class Mark>
osg::ref_ptr<MarkJob> markOf(const MapQuad& quad, const ScreenRect& bounds, MapView view) {
    osg::ref_ptr<Mark> mark = new Mark;
    mark->quad = quad;
    mark->screenBounds = bounds;
    mark->view = view;
    return mark;
}

} // namespace

LightMaps::LightMaps() : _resources(new MapResources) {}
LightMaps::~LightMaps() = default;

osg::ref_ptr<ConeMark> LightMaps::around(const ViewFrame& view, const glm::dvec4& light, const SpotCone& cone,
                                         const CasterMesh& mesh) const {
    osg::ref_ptr<ConeMark> mark = new ConeMark;
    mark->resources = _resources;
    mark->clipFromScene = toGlm(view.projection) * eyeFromScene(view, mesh);
    mark->coneFromScene = coneFromScene(glm::dvec3(light), cone);
    return mark;
}

osg::ref_ptr<MarkJob> LightMaps::mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                                      const std::optional<SpotCone>& cone, const CasterMesh& mesh,
                                      const MapWish& wish) {
    const glm::dmat4 clipFromScene = toGlm(view.projection) * eyeFromScene(view, mesh);
    Lock lock(_mutex);
    LightMap& map = find(view.stage, lightNumber);
    const osg::ref_ptr<const MapCasters> casters = castersOf(mesh);
    const std::vector<MapReceiver> receivers = receiversOf(view, eyeFromScene(view, mesh));
    const bool flats = std::any_of(casters->flatBoxes.begin(), casters->flatBoxes.end(),
                                   [&](const auto& flat) { return isBetween(flat, light, receivers, casters->reach); });
    map.setCause(light, cone, *casters, flats, wish);
    const std::vector<glm::dvec4> corners = map.find(receivers, clipFromScene, view.pixels.x());
    const auto bounds = corners.empty() ? std::nullopt : screenBounds(corners);
    const bool forPrograms = wish.unit >= 0;
    if (!bounds) return forPrograms ? new MapProgram(unsigned(wish.unit)) : nullptr;
    map.update(*_resources);
    MapQuad quad = map.quad(clipFromScene);
    quad.resources = _resources;
    quad.outline =
        screenOutline(corners, 4.0 / glm::dvec2(view.pixels.x(), view.pixels.y())); // two pixels more, against rounding
    if (forPrograms) return new MapProgram(quad, glm::inverse(eyeFromScene(view, mesh)), unsigned(wish.unit));
    if (cone) quad.coneFromScene = coneFromScene(glm::dvec3(light), *cone);
    return wish.soft ? markOf<SoftMapMark>(quad, *bounds, wish.view) : markOf<MapMark>(quad, *bounds, wish.view);
}

LightMap& LightMaps::find(const void* stage, int lightNumber) {
    ++_calls;
    const auto old = [this](const auto& map) { return _calls - map->lastCall > keptCalls; };
    _maps.erase(std::remove_if(_maps.begin(), _maps.end(), old), _maps.end());
    const auto found = std::find_if(_maps.begin(), _maps.end(), [&](const auto& map) {
        return map->stage == stage && map->lightNumber == lightNumber;
    });
    if (found == _maps.end())
        _maps.push_back(std::make_unique<LightMap>(stage, lightNumber));
    else
        std::rotate(found, found + 1, _maps.end());
    _maps.back()->lastCall = _calls;
    return *_maps.back();
}

osg::ref_ptr<const MapCasters> LightMaps::castersOf(const CasterMesh& mesh) {
    if (!_casters || _casters->mesh != &mesh) _casters = new MapCasters(mesh);
    return _casters;
}

void LightMaps::resizeGLObjectBuffers(unsigned maxSize) {
    _resources->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->resizeGLObjectBuffers(maxSize);
}

void LightMaps::release(osg::State* state) {
    _resources->release(state);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->release(state);
}

} // namespace gnomon
