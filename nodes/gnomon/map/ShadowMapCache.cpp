// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/MapMark.h>
#include <gnomon/map/ProgramMaps.h>
#include <gnomon/map/ShadowMapCache.h>

#include <OpenThreads/ScopedLock>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned keptCalls = 256; // maps that nobody asked for since are let go

glm::dmat4 eyeFromScene(const ViewFrame& view, const CasterLayers& casters) {
    return glm::translate(toGlm(view.eyeFromGroup), toGlm(casters.origin));
}

/// True if what is flat, a ground for one, may stand between the light and any part of what is seen: not if all of that is
/// on the light's side of it, or in it.
bool isBetween(const CasterLayer::Box& flat, const glm::dvec4& light, const std::vector<MapReceiver>& receivers,
               const glm::dvec3& reach) {
    const glm::dvec4 half = beyond(flat, light, reach);
    return std::any_of(receivers.begin(), receivers.end(), [&](const MapReceiver& receiver) {
        const auto corners = boxCorners(receiver.low, receiver.high, receiver.sceneFromBox);
        return std::any_of(corners.begin(), corners.end(),
                           [&](const glm::dvec4& corner) { return !(glm::dot(half, corner) < 0.0); });
    });
}

bool anyIsBetween(const CasterLayers& casters, const glm::dvec4& light, const std::vector<MapReceiver>& receivers) {
    const auto between = [&](const auto& flat) { return isBetween(flat, light, receivers, casters.reach); };
    const auto &still = casters.still->flatBoxes, &moving = casters.moving->flatBoxes;
    return std::any_of(still.begin(), still.end(), between) || std::any_of(moving.begin(), moving.end(), between);
}

template <class Mark>
osg::ref_ptr<MarkJob> markOf(const MapLookupPass& quad, const ScreenRect& bounds, ShadowMapOptions::View view) {
    osg::ref_ptr<Mark> mark = new Mark;
    mark->quad = quad;
    mark->screenBounds = bounds;
    mark->view = view;
    return mark;
}

} // namespace

ShadowMapCache::ShadowMapCache() : _resources(new MapPrograms) {}
ShadowMapCache::~ShadowMapCache() = default;

osg::ref_ptr<SpotMark> ShadowMapCache::around(const ViewFrame& view, const glm::dvec4& light, const SpotCone& cone,
                                              const CasterLayers& casters) const {
    osg::ref_ptr<SpotMark> mark = new SpotMark;
    mark->resources = _resources;
    mark->clipFromScene = toGlm(view.projection) * eyeFromScene(view, casters);
    mark->coneFromScene = coneFromScene(glm::dvec3(light), cone);
    return mark;
}

osg::ref_ptr<MarkJob> ShadowMapCache::mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                                           const std::optional<SpotCone>& cone, const CasterLayers& casters,
                                           const MapSettings& settings) {
    const glm::dmat4 clipFromScene = toGlm(view.projection) * eyeFromScene(view, casters);
    Lock lock(_mutex);
    LightShadowMaps& map = find(view.stage, lightNumber);
    const std::vector<MapReceiver> receivers = receiversOf(view, eyeFromScene(view, casters));
    map.setCause({light, cone, &casters, anyIsBetween(casters, light, receivers), settings});
    const std::vector<glm::dvec4> corners = map.find(receivers, clipFromScene, {view.pixels.x(), view.pixels.y()});
    const auto bounds = corners.empty() ? std::nullopt : screenBounds(corners);
    const bool forPrograms = settings.programUnit >= 0;
    if (!bounds) return forPrograms ? new ProgramMaps(unsigned(settings.programUnit)) : nullptr;
    map.update(*_resources);
    MapLookupPass quad = map.quad(clipFromScene);
    quad.resources = _resources;
    quad.outline =
        screenOutline(corners, 4.0 / glm::dvec2(view.pixels.x(), view.pixels.y())); // two pixels more, against rounding
    if (forPrograms)
        return new ProgramMaps(quad, glm::inverse(eyeFromScene(view, casters)), unsigned(settings.programUnit));
    if (cone) quad.coneFromScene = coneFromScene(glm::dvec3(light), *cone);
    return quad.fades() ? markOf<SoftMapMark>(quad, *bounds, settings.view)
                        : markOf<MapMark>(quad, *bounds, settings.view);
}

osg::ref_ptr<const CasterLayers> ShadowMapCache::castersOf(const ShadowCasterGroup& group,
                                                           const CasterDrawables& pieces) {
    Lock lock(_mutex);
    const auto old = [this](const Known& known) { return _calls - known.lastCall > keptCalls; };
    _casters.erase(std::remove_if(_casters.begin(), _casters.end(), old), _casters.end());
    auto known = std::find_if(_casters.begin(), _casters.end(), [&](const Known& k) { return k.group == &group; });
    if (known == _casters.end()) known = _casters.insert(known, {&group, nullptr, 0});
    known->casters = CasterLayers::of(pieces, known->casters);
    known->lastCall = _calls;
    return known->casters;
}

LightShadowMaps& ShadowMapCache::find(const void* stage, int lightNumber) {
    ++_calls;
    const auto old = [this](const auto& map) { return _calls - map->lastCall > keptCalls; };
    _maps.erase(std::remove_if(_maps.begin(), _maps.end(), old), _maps.end());
    const auto found = std::find_if(_maps.begin(), _maps.end(), [&](const auto& map) {
        return map->stage == stage && map->lightNumber == lightNumber;
    });
    if (found == _maps.end())
        _maps.push_back(std::make_unique<LightShadowMaps>(stage, lightNumber));
    else
        std::rotate(found, found + 1, _maps.end());
    _maps.back()->lastCall = _calls;
    return *_maps.back();
}

void ShadowMapCache::resizeGLObjectBuffers(unsigned maxSize) {
    _resources->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->resizeGLObjectBuffers(maxSize);
}

void ShadowMapCache::release(osg::State* state) {
    _resources->release(state);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->release(state);
}

} // namespace gnomon
