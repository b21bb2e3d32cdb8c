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

glm::dmat4 eyeFromScene(const ViewFrame& view, const MapCasters& casters) {
    return glm::translate(toGlm(view.eyeFromGroup), toGlm(casters.origin));
}

/// True if what is flat, a ground for one, may stand between the light and any part of what is seen: not if all of that is
/// on the light's side of it, or in it.
bool isBetween(const MapLayer::Box& flat, const glm::dvec4& light, const std::vector<MapReceiver>& receivers,
               const glm::dvec3& reach) {
    const glm::dvec4 half = beyond(flat, light, reach);
    return std::any_of(receivers.begin(), receivers.end(), [&](const MapReceiver& receiver) {
        const auto corners = boxCorners(receiver.low, receiver.high, receiver.sceneFromBox);
        return std::any_of(corners.begin(), corners.end(),
                           [&](const glm::dvec4& corner) { return !(glm::dot(half, corner) < 0.0); });
    });
}

bool anyIsBetween(const MapCasters& casters, const glm::dvec4& light, const std::vector<MapReceiver>& receivers) {
    const auto between = [&](const auto& flat) { return isBetween(flat, light, receivers, casters.reach); };
    const auto &still = casters.still->flatBoxes, &moving = casters.moving->flatBoxes;
    return std::any_of(still.begin(), still.end(), between) || std::any_of(moving.begin(), moving.end(), between);
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
                                         const MapCasters& casters) const {
    osg::ref_ptr<ConeMark> mark = new ConeMark;
    mark->resources = _resources;
    mark->clipFromScene = toGlm(view.projection) * eyeFromScene(view, casters);
    mark->coneFromScene = coneFromScene(glm::dvec3(light), cone);
    return mark;
}

osg::ref_ptr<MarkJob> LightMaps::mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                                      const std::optional<SpotCone>& cone, const MapCasters& casters,
                                      const MapWish& wish) {
    const glm::dmat4 clipFromScene = toGlm(view.projection) * eyeFromScene(view, casters);
    Lock lock(_mutex);
    LightMap& map = find(view.stage, lightNumber);
    const std::vector<MapReceiver> receivers = receiversOf(view, eyeFromScene(view, casters));
    map.setCause({light, cone, &casters, anyIsBetween(casters, light, receivers), wish});
    const std::vector<glm::dvec4> corners = map.find(receivers, clipFromScene, {view.pixels.x(), view.pixels.y()});
    const auto bounds = corners.empty() ? std::nullopt : screenBounds(corners);
    const bool forPrograms = wish.unit >= 0;
    if (!bounds) return forPrograms ? new MapProgram(unsigned(wish.unit)) : nullptr;
    map.update(*_resources);
    MapQuad quad = map.quad(clipFromScene);
    quad.resources = _resources;
    quad.outline =
        screenOutline(corners, 4.0 / glm::dvec2(view.pixels.x(), view.pixels.y())); // two pixels more, against rounding
    if (forPrograms) return new MapProgram(quad, glm::inverse(eyeFromScene(view, casters)), unsigned(wish.unit));
    if (cone) quad.coneFromScene = coneFromScene(glm::dvec3(light), *cone);
    return quad.fades() ? markOf<SoftMapMark>(quad, *bounds, wish.view) : markOf<MapMark>(quad, *bounds, wish.view);
}

osg::ref_ptr<const MapCasters> LightMaps::castersOf(const ShadowCasterGroup& group, const CasterPieces& pieces) {
    Lock lock(_mutex);
    const auto old = [this](const Known& known) { return _calls - known.lastCall > keptCalls; };
    _casters.erase(std::remove_if(_casters.begin(), _casters.end(), old), _casters.end());
    auto known = std::find_if(_casters.begin(), _casters.end(), [&](const Known& k) { return k.group == &group; });
    if (known == _casters.end()) known = _casters.insert(known, {&group, nullptr, 0});
    known->casters = MapCasters::of(pieces, known->casters);
    known->lastCall = _calls;
    return known->casters;
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
