// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/auto/CandidateFacts.h>
#include <gnomon/auto/CandidateList.h>
#include <gnomon/base/NumberText.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/gl/TriangleClusters.h>
#include <gnomon/mapfit/MapFit.h>
#include <gnomon/volume/VolumeForecast.h>

#include <osg/Geometry>

#include <algorithm>
#include <optional>

namespace gnomon {
namespace {

using Map = ShadowMapOptions;
using Kind = AutoCandidate::Kind;

constexpr double leastShadow = 0.5; // pixels across
constexpr double usualShare = 0.95; // of the edges: what errors are given for

struct MapQuality {
    Map::Filter filter;
    Map::Edges edges;
    EdgeFilter edge;
};
/// Spread: of hard edges at random; of smooth ones on the tuning scenes of gnomonchart. Pixel: of a sphere and a cube on a
/// ground, with small texels.
constexpr MapQuality qualities[] = {
    {Map::NEAREST, Map::HARD, {0.51, 0.42, 0.25, false}}, {Map::BILINEAR, Map::HARD, {0.41, 0.41, 1.0, false}},
    {Map::BICUBIC, Map::HARD, {0.35, 0.40, 4.0, false}},  {Map::BILINEAR, Map::SMOOTH, {0.25, 0.36, 1.0, false}},
    {Map::BICUBIC, Map::SMOOTH, {0.22, 0.15, 4.0, true}}, {Map::FINE, Map::SMOOTH, {0.15, 0.075, 16.0, true}},
};
// What is counted of a technique, by what tests/bench/bench_processor counts; see CandidateChoice.cpp.
constexpr double callsOfAll = 6.0;     // of what every technique needs, and one full-screen step
constexpr double callsToRelight = 3.0; // to take depth back where marks are
constexpr double callsAMap = 4.0;      // to switch to its framebuffer and back
constexpr double darkened = 0.25;      // of the pixels where a shadow can be
constexpr double relitAnew = 0.5;      // the same, besides, where all that is there is drawn again
constexpr double faded = 1.6;          // times as many leaves are relit where pixels have a share of the light
constexpr double readBack = 0.5;       // what a pixel's depth takes that the processor reads, to one that a step copies
constexpr double lookedUp = 0.2;       // for each further map of a light a pixel takes so much longer
constexpr double redrawn = 0.15;       // of the frames of a moving view: a map is drawn again
constexpr double callsToSmooth = 8.0;  // to find where marks end within pixels
constexpr double pixelsToSmooth = 3.0; // of the same, times those where a shadow can be
constexpr double raysToSmooth = 0.9;   // for a pixel where a shadow can be: 32 where marks end, which few are
constexpr double smoothError = 0.25;   // of a share of a pixel, to one sample
constexpr double looksOfAHull = 3.0;   // at each caster in a frame, where others look once
constexpr double trianglesOfAHull = 3.0; // of a dense mesh, whose shadow takes as long as that of so many boxes
constexpr double drawnOfDense = 35.0;    // triangles for one of a dense mesh, whose shadows overlap

/// Smaller ones leak light between fins that lie a few pixels apart, where no edge of a shadow tells it.
constexpr int sizes[] = {512, 1024, 2048, 4096};

/// Why a candidate would leave a caster out; empty if it would not.
std::string whyOnlyMaps(const AutoCandidate& candidate, const Casters& casters) {
    return candidate.kind == Kind::Map || casters.selfDrawings.empty()
               ? ""
               : "a caster draws itself, and only maps can let it";
}

std::string whyNotTraced(const Casters& casters) {
    return hasPart(OptionalPart::Traced) ? whyDrawnCutOut(casters) : "this build has no Embree";
}

/// True if it finds the place of a shadow by the depths of what is seen.
bool needsDepths(Kind kind) { return kind != Kind::Nothing && kind != Kind::Traced; }

/// Why rays alone tell where shadows fall; empty if others do, too, or if rays cannot be had.
std::string whyOnlyRays(const ShadowInView& shadow) {
    return whyNotTraced(shadow.casters).empty() && shadow.casters.selfDrawings.empty() ? whyCoarse(shadow) : "";
}

/// Of meshes whose parts are no boxes, but for grounds: each triangle may be on an outline.
double denseTriangles(const Casters& casters) {
    constexpr double large = 0.5; // of the radius of all
    double sum = 0.0;
    for (const auto& piece : casters.list)
        if (piece->triangles >= fewestOfABody && piece->bounds.radius() < large * casters.bounds.radius())
            sum += double(piece->triangles);
    return sum;
}

osg::ref_ptr<const MapCasters> mapBoxesOf(const Casters& casters) {
    const CasterLayers& layers = casters.layers();
    return new MapCasters(casters, new MapLayer(*layers.still), new MapLayer(*layers.moving));
}

constexpr double ofAShape = 200.0; // triangles: a ShapeDrawable's sphere has some hundred, its box 12

/// How much of a leaf is drawn again, as LeafReplay does.
double shareWithin(const osgUtil::RenderLeaf& leaf, const ScreenRect& bounds) {
    const osg::ref_ptr<const TriangleClusters> clusters = TriangleClusters::of(*leaf._drawable);
    if (!clusters) return 1.0;
    double drawn = 0.0, all = 0.0;
    for (const auto& run : clusters->touching(bounds, modelviewOf(leaf) * projectionOf(leaf))) drawn += run.count;
    for (const auto& set : leaf._drawable->asGeometry()->getPrimitiveSetList()) all += set->getNumIndices();
    return std::min(1.0, drawn / all);
}

/// By its primitives; an estimate where it is no geometry.
double trianglesOf(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry) return ofAShape;
    double triangles = 0.0;
    for (const auto& set : geometry->getPrimitiveSetList()) triangles += set->getNumPrimitives();
    return triangles;
}

/// Triangles of these leaves that are drawn again where marks are within these bounds.
double trianglesWithin(const std::vector<const osgUtil::RenderLeaf*>& leaves, const ScreenRect& bounds) {
    double triangles = 0.0;
    TouchTest touches(bounds);
    for (const osgUtil::RenderLeaf* leaf : leaves)
        if (touches(*leaf)) triangles += shareWithin(*leaf, bounds) * trianglesOf(*leaf->_drawable);
    return triangles;
}

double pixelsOf(const ViewFrame& frame, const ScreenRect& bounds) {
    const glm::dvec2 size = (bounds.high - bounds.low) / 2.0;
    return size.x > 0.0 && size.y > 0.0 ? size.x * frame.pixels.x() * size.y * frame.pixels.y() : 0.0;
}

} // namespace

/// Does the parts of a search in one frame.
class Lister {
public:
    Lister(CandidateSearch& search, const ShadowInView& shadow, const Selection& receiver, AutoKnowledge& known)
        : _search(search),
          _one(search._one),
          _shadow(shadow),
          _receiver(receiver),
          _known(known),
          _layers(search._boxes->layers) {}

    /// @return true if no more is to be found.
    bool findFirst() {
        _one = forecast(1, sizes[0]);
        _result.nothing = whyNothing();
        if (_result.nothing.empty())
            _search._volumes = forecastVolumes(_shadow.view, _layers, _shadow.towards, _known.open);
        return !_result.nothing.empty();
    }

    CandidateList list() {
        if (!_result.nothing.empty()) return only();
        measure();
        _widths = _search._edges->in(_one);
        _sampled = _widths->empty() ? sampledEdge : _widths->usual(usualShare, sampledError);
        addTerrain();
        addMaps();
        addVolume();
        addTraced();
        const std::string onlyRays = whyOnlyRays(_shadow);
        for (AutoCandidate& candidate : _result.all) {
            if (candidate.obstacle.empty()) candidate.obstacle = whyOnlyMaps(candidate, _shadow.casters);
            if (candidate.obstacle.empty() && needsDepths(candidate.kind)) candidate.obstacle = onlyRays;
            if (candidate.kind == Kind::Traced && !onlyRays.empty()) candidate.why = "rays alone tell, as " + onlyRays;
        }
        return _result;
    }

private:
    std::string whyNothing() const {
        if (_shadow.view.seen.empty()) return "no receiver is in sight";
        if (_one.maps == 0) return "no shadow can fall on what is in sight";
        if (_one.texels < leastShadow) return "the shadow is narrower than half a pixel";
        if (isFaint(_shadow)) return "the light is so faint that nobody could see its shadow";
        if (blends() && _shadow.view.group->getDark() >= 1.0f - float(leastContrast))
            return "the shadow would not be seen, as its factor is 1";
        return {};
    }

    CandidateList only() {
        AutoCandidate none;
        none.error = _one.texels < leastShadow ? _one.texels : 0.0;
        _result.all = {none};
        return _result;
    }

    /// Of the casters' triangles.
    double movingShare() const { return double(_layers.moving->triangles) / std::max(_casters, 1.0); }
    bool blends() const { return _shadow.view.group->getComposite() == ShadowCasterGroup::BLEND; }

    /// What every technique costs: the compositor's part.
    void measure() {
        _pixels = pixelsOf(_shadow.view, *_one.bounds);
        _casters = double(_layers.triangles());
        _pieces = double(_shadow.casters.list.size());
        const std::vector<PlacedMesh> meshes = _layers.meshes();
        _smooth = std::any_of(meshes.begin(), meshes.end(),
                              [](const PlacedMesh& placed) { return offsetsOf(*placed.mesh) != nullptr; });
        _compose.calls = callsOfAll;
        _compose.casters = _pieces;
        _compose.filled = darkened * _pixels;
        if (blends()) return;
        _compose.calls += callsToRelight;
        _compose.leaves = double(_shadow.view.seen.size());
        _compose.filled += relitAnew * _pixels;
        _compose.relit = trianglesWithin(_shadow.view.seen, *_one.bounds);
    }

    void addTerrain() {
        const TerrainFacts facts = _known.terrain.of(_shadow, _receiver);
        AutoCandidate hull;
        hull.kind = Kind::Terrain;
        hull.obstacle = facts.obstacle;
        hull.why = "the named terrain shadows no part of itself";
        hull.error = polygonError(facts.off / _one.pixel);
        const double dense = denseTriangles(_shadow.casters);
        hull.still = _compose;
        hull.still.casters *= looksOfAHull;
        hull.still.triangles = 6.0 * _pieces + drawnOfDense * dense;
        hull.light.hulls = _pieces + dense / trianglesOfAHull;
        hull.casters = hull.light;
        findEdges(addBoth(hull, facts.off / _one.pixel), hull.still.triangles);
    }

    /// The same with smooth edges, too. @param off  by so many pixels its edges lie elsewhere. @return the smooth one.
    AutoCandidate& addBoth(const AutoCandidate& hard, double off) {
        _result.all.push_back(hard);
        AutoCandidate smooth = hard;
        smooth.smooth = true;
        smooth.error = std::hypot(smoothError * _sampled, off);
        if (!blends()) smooth.still.leaves *= faded;
        _result.all.push_back(smooth);
        return _result.all.back();
    }

    /// By the triangles that edges are sides of.
    void findEdges(AutoCandidate& smooth, double sides) const {
        smooth.still.calls += callsToSmooth;
        smooth.still.pixels += pixelsToSmooth * _pixels;
        smooth.still.triangles += sides;
    }

    MapForecast forecast(int cascades, int size) const {
        ShadowMapOptions options;
        options.cascades = cascades;
        options.size = size;
        return forecastMaps(_shadow.view, _shadow.light, *_search._boxes, MapSettings(options));
    }

    /// One map, and as many as the size asks for, where those are more: larger ones ask for fewer.
    void addMaps() {
        bool severalDiffer = _shadow.towards.w == 0.0;
        for (const int size : sizes) {
            for (const MapQuality& quality : qualities) _result.all.push_back(mapOf(_one, *_widths, 1, size, quality));
            if (!severalDiffer) continue;
            const MapForecast several = forecast(0, size);
            severalDiffer = several.maps != _one.maps;
            if (!severalDiffer) continue;
            const EdgeWidths each = _search._edges->in(several);
            for (const MapQuality& quality : qualities) _result.all.push_back(mapOf(several, each, 0, size, quality));
        }
    }

    AutoCandidate mapOf(const MapForecast& forecast, const EdgeWidths& edges, int cascades, int size,
                        const MapQuality& quality) const {
        AutoCandidate map;
        map.kind = Kind::Map;
        map.map.size = size;
        map.map.filter = quality.filter;
        map.map.edges = quality.edges;
        map.map.cascades = cascades;
        // Dark pixels along the facets of smooth bodies; and light along the foot of what stands on a ground that hides it:
        // among leaves that is less than the rays of a garden cost, three times as long as its maps.
        const bool darkens = quality.edges == Map::SMOOTH && quality.filter == Map::BILINEAR;
        map.flawed = (_smooth && darkens) || (forecast.touchesFlat && _shadow.casters.cutouts == 0);
        const double wish = MapSettings(map.map).widestTexel;
        const int texels = texelsFor(forecast.texels / wish, std::min(size, forecast.most), 0);
        map.error = edges.empty() ? mapError(quality.edge, forecast.texels / texels)
                                  : edges.usual(usualShare,
                                                [&](const auto& edge) { return mapError(edge, quality.edge, texels); });
        map.error = std::max(map.error, edges.leak(texels));
        map.why = "its texels are as large as " + roundedText(forecast.texels / texels) + " px";
        const double passes = quality.edges == Map::SMOOTH && !blends() ? 2.0 : 1.0;
        map.still = _compose;
        map.still.calls += 3.0 * passes;
        map.still.leaves *= passes > 1.0 ? faded : 1.0;
        map.still.pixels = passes * _pixels * (1.0 + lookedUp * (forecast.maps - 1));
        map.still.taps = passes * _pixels * quality.edge.compared;
        const auto drawAgain = [&](ShadowWork& work, double share) {
            work.fits = forecast.fits;
            work.calls = share * callsAMap * forecast.maps;
            work.casters = share * _pieces;
            work.texels = share * forecast.maps * texels * texels;
            work.triangles = share * forecast.maps * _casters;
        };
        drawAgain(map.light, 1.0);
        drawAgain(map.view, redrawn);
        drawAgain(map.casters, 1.0);
        map.casters.triangles *= movingShare();
        return map;
    }

    void addVolume() {
        AutoCandidate volume;
        volume.kind = Kind::Volume;
        volume.error = _sampled;
        volume.obstacle = whyCutOut(_shadow.casters);
        volume.still = _compose;
        const VolumeForecast& forecast = _search._volumes;
        volume.still.triangles += 2.0 * forecast.sides + forecast.caps;
        volume.still.texels += forecast.pixels + _pixels; // counts become marks
        volume.light.volumes = volume.casters.volumes = volume.view.volumes = _pieces;
        volume.light.faced = _casters;
        volume.light.sides = forecast.sides + forecast.caps;
        volume.casters.faced = movingShare() * volume.light.faced;
        volume.casters.sides = movingShare() * volume.light.sides;
        volume.why = "its volumes have some " + roundedText(forecast.sides) + " sides";
        findEdges(addBoth(volume, 0.0), 2.0 * forecast.sides);
    }

    void addTraced() {
        AutoCandidate traced;
        traced.kind = Kind::Traced;
        traced.error = _sampled;
        traced.why = "rays are cast for some " + roundedText(_pixels) + " pixels";
        traced.obstacle = whyNotTraced(_shadow.casters);
        traced.still = _compose;
        traced.still.pixels = readBack * _pixels;
        // A still picture keeps them. They count all the same: else its first frame of motion would be the dearest of all.
        traced.still.rays = _pixels;
        addBoth(traced, 0.0).still.rays += raysToSmooth * _pixels;
    }

    CandidateSearch& _search;
    MapForecast& _one; ///< of the search.
    const ShadowInView& _shadow;
    const Selection& _receiver;
    AutoKnowledge& _known;
    const CasterLayers& _layers;
    double _pixels = 0.0, _casters = 0.0, _pieces = 0.0;
    bool _smooth = false;              ///< bodies cast from farther on, see CasterMesh::offsets.
    std::optional<EdgeWidths> _widths; ///< of edges in `_one`.
    double _sampled = sampledEdge;     ///< error of one ray a pixel.
    ShadowWork _compose;
    CandidateList _result;
};

std::optional<CandidateList> CandidateSearch::look(const ShadowInView& shadow, const Selection& receiver,
                                                   AutoKnowledge& known) {
    if (_part == 0) _boxes = mapBoxesOf(shadow.casters);
    Lister lister(*this, shadow, receiver, known);
    switch (_part++) {
    case 0:
        return lister.findFirst() ? std::optional(lister.list()) : std::nullopt;
    case 1:
        _edges.emplace(shadow, *_boxes, _one);
        return std::nullopt;
    default:
        return lister.list();
    }
}

std::string whyWrong(const AutoCandidate& candidate, const ShadowInView& shadow, const Selection& receiver,
                     AutoKnowledge& known) {
    const std::string why = whyOnlyMaps(candidate, shadow.casters);
    if (!why.empty()) return why;
    if (candidate.kind == Kind::Nothing) return "a shadow may be needed now";
    if (needsDepths(candidate.kind))
        if (const std::string coarse = whyOnlyRays(shadow); !coarse.empty()) return coarse;
    if (candidate.kind == Kind::Terrain) return known.terrain.of(shadow, receiver).obstacle;
    if (candidate.kind == Kind::Volume) return whyCutOut(shadow.casters);
    if (candidate.kind == Kind::Traced) return whyDrawnCutOut(shadow.casters);
    return {};
}

} // namespace gnomon
