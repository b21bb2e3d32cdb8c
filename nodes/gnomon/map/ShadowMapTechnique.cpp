// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/base/RecentCache.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/geometry/DrawnError.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/LitCauses.h>
#include <gnomon/group/PerView.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/LightShadowMaps.h>
#include <gnomon/map/MapMarks.h>

#include <OpenThreads/Mutex>
#include <OpenThreads/ScopedLock>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
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

constexpr double mostOff = 16.0;      // texels: things of some pixels have no shadow where depths are off by more
constexpr double mostDrawnOff = 32.0; // pixels along the line of sight: what is seen is compared as so much nearer
constexpr const char* coarse =
    "one of the casters is so large that floats place depths only to more than 16 texels of the map, or 32 pixels, so "
    "what is nearer to its receiver casts no shadow. Divide that caster, leave it out of the casters, or use traced.";

bool isCoarse(const MapPicture& picture) {
    return std::any_of(picture.tiles.begin(), picture.tiles.end(),
                       [](const MapPicture::Tile& tile) { return tile.errors.texelsOff() > mostOff; });
}

/// True of casters so large that their own vertices are too coarse; drawnOffItsPlace() tells of those that lie far from their origin.
bool areDrawnOff(const CasterLayers& layers, const ViewFrame& view, const glm::dmat4& clipFromScene) {
    const double rounding = std::min(layers.rounding, std::ldexp(layers.widest, -24));
    const DrawnError off = drawnError(clipFromScene, toGlm(view.projection), view.pixels.x(), rounding, 0.0);
    return std::ldexp(off.depth, 24) > mostDrawnOff * coarseDepthFrom(view.projection, {view.pixels, 1.0});
}

constexpr std::size_t mostCasters = 8; // groups above one node, and views of different levels of detail

} // namespace

/// A technique's maps: of each light in each view those drawn last, and whether they still do.
///
/// Threads any number.
class ShadowMapCache {
public:
    const osg::ref_ptr<MapPrograms> programs{new MapPrograms};

    /// The casters as maps draw them; made once for all lights, and for all views of the same levels of detail.
    osg::ref_ptr<const MapCasters> castersOf(const Casters& casters) {
        const CasterLayers& layers = casters.layers();
        Lock lock(_mutex);
        const auto* known = _casters.find([&](const auto& entry) { return entry->of == &casters; });
        if (known) return *known;
        const auto still = layerOf(*layers.still), moving = layerOf(*layers.moving);
        dropRetired();
        _casters.dropOldestBeyond(mostCasters - 1);
        return _casters.add(new MapCasters(casters, still, moving));
    }

    /// Makes the maps of a light anew where they do not show what they must. @return none if none of its shadow can be seen.
    std::optional<MapsInView> update(const ViewFrame& view, int lightNumber, const MapRequest& request) {
        Lock lock(_mutex);
        LightShadowMaps& maps = _maps.of(view.key, lightNumber, view.frameNumber);
        const std::vector<glm::dvec4>& corners = maps.find(view, request);
        const auto bounds = corners.empty() ? std::nullopt : screenBounds(corners);
        if (!bounds) {
            maps.letGo();
            return std::nullopt;
        }
        maps.update(view, _meshes);
        const glm::dvec2 rounding = 4.0 / glm::dvec2(view.pixels.x(), view.pixels.y()); // two pixels more
        return MapsInView{programs, maps.map(), maps.picture(), screenOutline(corners, rounding), *bounds};
    }

    /// Drops the maps and meshes of retired casters.
    void letGo() {
        Lock lock(_mutex);
        _maps.dropIf([](const LightShadowMaps& maps) { return maps.areCastersRetired(); });
        dropRetired();
    }

    void resizeGLObjectBuffers(unsigned maxSize) {
        programs->resizeGLObjectBuffers(maxSize);
        Lock lock(_mutex);
        for (const auto& entry : _maps)
            if (entry->value.map()) entry->value.map()->resizeGLObjectBuffers(maxSize);
        _meshes.resizeGLObjectBuffers(maxSize);
    }

    void release(osg::State* state) {
        programs->release(state);
        Lock lock(_mutex);
        for (const auto& entry : _maps)
            if (entry->value.map()) entry->value.map()->release(state);
        _meshes.releaseGLObjects(state);
    }

private:
    osg::ref_ptr<const MapLayer> layerOf(const CasterLayer& layer) {
        for (const auto& entry : _casters)
            for (const auto& known : {entry->still, entry->moving})
                if (known->casters == &layer) return known;
        return new MapLayer(layer, &_meshes);
    }

    void dropRetired() {
        _casters.dropIf([](const auto& entry) { return entry->of->isRetired(); });
        _meshes.prune();
    }

    OpenThreads::Mutex _mutex;
    PerView<LightShadowMaps> _maps;
    RecentCache<osg::ref_ptr<const MapCasters>> _casters;
    MapMeshes _meshes;
};

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

unsigned ShadowMapTechnique::passes() const { return _maps->programs->passes; }

std::vector<osg::ref_ptr<Mark>> ShadowMapTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                            const Casters& casters) const {
    const osg::ref_ptr<const MapCasters> drawn = _maps->castersOf(casters);
    const SceneFrame scene(drawn->layers.origin);
    const auto usable = lightInScene(light.inGroup, scene);
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    const std::optional<SpotCone> cone = spotOf(light);
    const std::optional<MapsInView> maps =
        _maps->update(view, light.number, {*usable, cone, drawn, MapSettings(_options)});
    if ((maps && isCoarse(*maps->picture)) ||
        areDrawnOff(drawn->layers, view, toGlm(view.projection) * scene.eyeFromScene(view)))
        report(view.frameNumber, coarse);
    if (_options.programUnit >= 0)
        return {programMaps(_options.programUnit, maps, glm::inverse(scene.eyeFromScene(view)))};
    LookupPlaces places{toGlm(view.projection) * scene.eyeFromScene(view),
                        std::nullopt,
                        {view.pushedBack.x(), view.pushedBack.y()},
                        drawn->layers.rounding};
    if (cone) places.coneFromScene = coneFromScene(glm::dvec3(*usable), *cone);
    std::vector<osg::ref_ptr<Mark>> marks;
    if (cone && view.group->getComposite() == ShadowCasterGroup::RELIGHT)
        marks.push_back(spotMark(_maps->programs, places));
    if (maps) // else out of sight: nothing to say
        marks.push_back(new MapLookup(_options, places, *maps));
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
