// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/base/RecentCache.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/LightShadowMaps.h>

#include <OpenThreads/Mutex>
#include <OpenThreads/ScopedLock>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <memory>
#include <optional>

namespace gnomon {
namespace {

static_assert(ShadowMapOptions::mostCascades == mostCascades);

double within(double value, double most) { return value > 0.0 ? std::min(value, most) : 0.0; }

/// The value if it is one of its kind, whose last is given; else the default.
template <typename Kind>
Kind known(Kind value, Kind last, Kind byDefault) {
    return value >= 0 && value <= last ? value : byDefault;
}

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned keptRounds = 60;    // maps that nobody asked for since are let go, however many there are
constexpr std::size_t mostCasters = 8; // groups above one node, and views of different levels of detail

} // namespace

/// A technique's maps: of each light in each view those drawn last, and whether they still do.
///
/// Threads any number.
class ShadowMapCache {
public:
    /// The casters as maps draw them; made once for all lights, and for all views of the same levels of detail.
    osg::ref_ptr<const MapCasters> castersOf(const CasterLayers& layers);
    /// @param light  in the scene about the casters' origin, see localLight().
    /// @param cone   of a lamp that is a spot: nothing outside it is marked.
    /// @return the marks of a light; null if none of its shadow can be seen.
    osg::ref_ptr<Mark> mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                            const std::optional<SpotCone>& cone, const MapCasters& casters,
                            const ShadowMapOptions& settings);
    /// Drops the maps and meshes of retired casters.
    void letGo();

    const osg::ref_ptr<MapPrograms> resources{new MapPrograms};
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    LightShadowMaps& find(const ViewFrame& view, int lightNumber);
    osg::ref_ptr<const MapLayer> layerOf(const CasterLayer& layer) const;

    OpenThreads::Mutex _mutex;
    RecentCache<std::unique_ptr<LightShadowMaps>> _maps;
    RecentCache<osg::ref_ptr<const MapCasters>> _casters;
    MapBodies _bodies;
    unsigned _round = 0, _frame = 0; ///< a round is a frame, as views count them.
};

osg::ref_ptr<Mark> ShadowMapCache::mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                                        const std::optional<SpotCone>& cone, const MapCasters& casters,
                                        const ShadowMapOptions& settings) {
    const glm::dmat4 eyeFromScene = SceneFrame(casters.layers->origin).eyeFromScene(view);
    Lock lock(_mutex);
    LightShadowMaps& map = find(view, lightNumber);
    const std::vector<glm::dvec4> corners = map.find(view, {light, cone, &casters, false, settings});
    const auto bounds = corners.empty() ? std::nullopt : screenBounds(corners);
    const bool forPrograms = settings.programUnit >= 0;
    if (!bounds) {
        map.letGo();
        return forPrograms ? new ProgramMaps(unsigned(settings.programUnit)) : nullptr;
    }
    map.update(*resources, _bodies, casters.own.empty() ? OwnView() : OwnView(eyeFromScene, view.seen));
    MapLookupPass quad = map.quad();
    quad.resources = resources;
    quad.pushedBack = {view.pushedBack.x(), view.pushedBack.y()};
    quad.outline =
        screenOutline(corners, 4.0 / glm::dvec2(view.pixels.x(), view.pixels.y())); // two pixels more, against rounding
    if (forPrograms) return new ProgramMaps(quad, glm::inverse(eyeFromScene), unsigned(settings.programUnit));
    if (cone) quad.coneFromScene = coneFromScene(glm::dvec3(light), *cone);
    osg::ref_ptr<MapMark> mark = new MapMark;
    mark->quad = std::move(quad);
    mark->screenBounds = *bounds;
    mark->view = settings.view;
    return mark;
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
    resources->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->resizeGLObjectBuffers(maxSize);
    _bodies.resizeGLObjectBuffers(maxSize);
}

void ShadowMapCache::release(osg::State* state) {
    resources->release(state);
    Lock lock(_mutex);
    for (const auto& map : _maps) map->release(state);
    _bodies.releaseGLObjects(state);
}

ShadowMapOptions ShadowMapOptions::usable() const {
    const ShadowMapOptions fresh;
    ShadowMapOptions options;
    options.size = std::clamp(size, leastSize, mostSize);
    options.filter = known(filter, FINE, fresh.filter);
    options.cascades = std::clamp(cascades, 0, mostCascades);
    options.edges = known(edges, SOFT, fresh.edges);
    options.sunAngle = within(sunAngle, mostAngle);
    options.lampSize = within(lampSize, mostLength);
    options.radius = within(radius, mostLength);
    options.view = known(view, CASCADES, fresh.view);
    options.programUnit = known(programUnit, mostUnit, fresh.programUnit);
    return options;
}

ShadowMapTechnique::ShadowMapTechnique() : _maps(std::make_unique<ShadowMapCache>()) {}

ShadowMapTechnique::ShadowMapTechnique(const ShadowMapTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _options(other._options), _maps(std::make_unique<ShadowMapCache>()) {}

ShadowMapTechnique::~ShadowMapTechnique() = default;

unsigned ShadowMapTechnique::passes() const { return _maps->resources->passes; }

std::vector<osg::ref_ptr<Mark>> ShadowMapTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                            const FrameCasters& casters) const {
    const osg::ref_ptr<const MapCasters> drawn = _maps->castersOf(casters.layers());
    const auto usable = localLight(light.inGroup, SceneFrame(drawn->layers->origin));
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    const std::optional<SpotCone> cone = spotOf(light);
    std::vector<osg::ref_ptr<Mark>> marks;
    if (cone && _options.programUnit < 0 && view.group->getComposite() == ShadowCasterGroup::RELIGHT) {
        osg::ref_ptr<SpotMark> around = new SpotMark;
        around->resources = _maps->resources;
        around->clipFromScene = toGlm(view.projection) * SceneFrame(drawn->layers->origin).eyeFromScene(view);
        around->coneFromScene = coneFromScene(glm::dvec3(*usable), *cone);
        marks.emplace_back(around);
    }
    const osg::ref_ptr<Mark> mark = _maps->mark(view, light.number, *usable, cone, *drawn, _options);
    if (mark) marks.emplace_back(mark); // else out of sight: nothing to say
    return marks;
}

std::string ShadowMapTechnique::programFunction() const { return visibilityFunction(_options.filter); }

void ShadowMapTechnique::letGo() const { _maps->letGo(); }

void ShadowMapTechnique::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _maps->resizeGLObjectBuffers(maxSize);
}

void ShadowMapTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _maps->release(state);
}

} // namespace gnomon
