// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/MapMark.h>
#include <gnomon/map/ShadowMapCache.h>

#include <OpenThreads/ScopedLock>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned keptRounds = 60;    // maps that nobody asked for since are let go, however many there are
constexpr std::size_t mostCasters = 8; // groups above one node, and views of different levels of detail

/// A view's two matrices. Clip space is the projection of eye space to the last bit.
struct SceneView {
    SceneView(const ViewFrame& view, const MapCasters& casters)
        : eyeFromScene(SceneFrame(casters.layers->origin).eyeFromScene(view)),
          clipFromScene(toGlm(view.projection) * eyeFromScene) {}

    glm::dmat4 eyeFromScene, clipFromScene;
};

/// Where what is flat, a ground for one, may stand between the light and a place. Of all that is level, each way, the one
/// nearest to the light says so for all.
std::vector<glm::dvec4> beyondFlats(const MapCasters& casters, const glm::dvec4& light) {
    std::vector<glm::dvec4> halves; // six at most
    for (const auto* flats : {&casters.still->flatBoxes, &casters.moving->flatBoxes})
        for (const MapLayer::Box& flat : *flats) {
            const glm::dvec4 half = beyond(flat, light, casters.layers->reach);
            const auto known = std::find_if(halves.begin(), halves.end(), [&](const glm::dvec4& other) {
                return glm::dvec3(other) == glm::dvec3(half);
            });
            if (known == halves.end())
                halves.push_back(half);
            else
                known->w = std::max(known->w, half.w);
        }
    return halves;
}

/// True if any part of what is seen is there: not if all of that is on the light's side of what is flat, or in it.
bool anyIsBetween(const MapCasters& casters, const glm::dvec4& light, const std::vector<MapReceiver>& receivers) {
    const std::vector<glm::dvec4> halves = beyondFlats(casters, light);
    if (halves.empty()) return false;
    return std::any_of(receivers.begin(), receivers.end(), [&](const MapReceiver& receiver) {
        const auto corners = boxCorners(receiver.low, receiver.high, receiver.sceneFromBox);
        return std::any_of(halves.begin(), halves.end(), [&](const glm::dvec4& half) {
            return std::any_of(corners.begin(), corners.end(),
                               [&](const glm::dvec4& corner) { return !(glm::dot(half, corner) < 0.0); });
        });
    });
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
                                              const MapCasters& casters) const {
    osg::ref_ptr<SpotMark> mark = new SpotMark;
    mark->resources = _resources;
    mark->clipFromScene = SceneView(view, casters).clipFromScene;
    mark->coneFromScene = coneFromScene(glm::dvec3(light), cone);
    return mark;
}

osg::ref_ptr<MarkJob> ShadowMapCache::mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                                           const std::optional<SpotCone>& cone, const MapCasters& casters,
                                           const MapSettings& settings) {
    const SceneView scene(view, casters);
    Lock lock(_mutex);
    LightShadowMaps& map = find(view, lightNumber);
    const std::vector<MapReceiver> receivers = receiversOf(view, scene.eyeFromScene);
    map.setCause({light, cone, &casters, anyIsBetween(casters, light, receivers), settings});
    const std::vector<glm::dvec4> corners =
        map.find(receivers, scene.clipFromScene, {view.pixels.x(), view.pixels.y()});
    const auto bounds = corners.empty() ? std::nullopt : screenBounds(corners);
    const bool forPrograms = settings.programUnit >= 0;
    if (!bounds) {
        map.letGo();
        return forPrograms ? new ProgramMaps(unsigned(settings.programUnit)) : nullptr;
    }
    map.update(*_resources, _bodies, casters.own.empty() ? OwnView() : OwnView(scene.eyeFromScene, view.seen));
    MapLookupPass quad = map.quad(scene.clipFromScene);
    quad.resources = _resources;
    quad.pushedBack = {view.pushedBack.x(), view.pushedBack.y()};
    quad.outline =
        screenOutline(corners, 4.0 / glm::dvec2(view.pixels.x(), view.pixels.y())); // two pixels more, against rounding
    if (forPrograms) return new ProgramMaps(quad, glm::inverse(scene.eyeFromScene), unsigned(settings.programUnit));
    if (cone) quad.coneFromScene = coneFromScene(glm::dvec3(light), *cone);
    return quad.fades() ? markOf<SoftMapMark>(quad, *bounds, settings.view)
                        : markOf<MapMark>(quad, *bounds, settings.view);
}

MapForecast ShadowMapCache::forecast(const ViewFrame& view, const ShadowLight& light, const MapCasters& boxes,
                                     const MapSettings& settings) {
    const auto usable = localLight(light.inGroup, SceneFrame(boxes.layers->origin));
    if (!usable) return {};
    const SceneView scene(view, boxes);
    const std::vector<MapReceiver> receivers = receiversOf(view, scene.eyeFromScene);
    LightShadowMaps maps(nullptr, light.number);
    maps.setCause({*usable, spotOf(light), &boxes, anyIsBetween(boxes, *usable, receivers), settings});
    const auto corners = maps.find(receivers, scene.clipFromScene, {view.pixels.x(), view.pixels.y()});
    MapForecast result = maps.forecast(scene.clipFromScene);
    result.bounds = corners.empty() ? std::nullopt : screenBounds(corners);
    if (!result.bounds) result.maps = 0;
    return result;
}

osg::ref_ptr<const MapCasters> ShadowMapCache::castersOf(const CasterLayers& layers) {
    Lock lock(_mutex);
    const auto* known = _casters.find([&](const auto& entry) { return entry->layers == &layers; });
    if (known) return *known;
    const osg::ref_ptr<const MapCasters> made = new MapCasters(layers, layerOf(*layers.still), layerOf(*layers.moving));
    _casters.dropIf([](const auto& entry) { return entry->layers->isRetired(); });
    _casters.dropOldestBeyond(mostCasters - 1);
    _bodies.prune();
    return _casters.add(made);
}

/// The one that is known, or else one that takes what it can of others.
osg::ref_ptr<const MapLayer> ShadowMapCache::layerOf(const CasterLayer& layer) const {
    std::vector<osg::ref_ptr<const MapLayer>> known;
    for (const auto& entry : _casters)
        for (const auto& each : {entry->still, entry->moving}) {
            if (each->casters == &layer) return each;
            known.push_back(each);
        }
    return new MapLayer(layer, known);
}

/// A map that is asked for twice begins a round as well, for views may count no frames.
LightShadowMaps& ShadowMapCache::find(const ViewFrame& view, int lightNumber) {
    auto* known =
        _maps.find([&](const auto& map) { return map->stage == view.stage && map->lightNumber == lightNumber; });
    LightShadowMaps& map = known ? **known : *_maps.add(std::make_unique<LightShadowMaps>(view.stage, lightNumber));
    if (view.frameNumber != _frame || (known && map.lastRound == _round)) {
        _frame = view.frameNumber;
        ++_round;
    }
    map.lastRound = _round;
    _maps.dropWhile([this](const auto& old) { return _round - old->lastRound > keptRounds; });
    return map;
}

void ShadowMapCache::letGo() {
    Lock lock(_mutex);
    _maps.dropIf([](const auto& map) { return map->areCastersRetired(); });
    _casters.dropIf([](const auto& entry) { return entry->layers->isRetired(); });
    _bodies.prune();
}

void ShadowMapCache::resizeGLObjectBuffers(unsigned maxSize) {
    _resources->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->resizeGLObjectBuffers(maxSize);
    _bodies.resizeGLObjectBuffers(maxSize);
}

void ShadowMapCache::release(osg::State* state) {
    _resources->release(state);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->release(state);
    _bodies.releaseGLObjects(state);
}

} // namespace gnomon
