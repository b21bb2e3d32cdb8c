// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/LightShadowMaps.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon {
namespace {

constexpr double reserve = 1.0 / 16.0;         // of a map's sides
constexpr double leastReserve = reserve / 4.0; // of a map that is only moved
constexpr double mostWaste = 2.0;    // area of a map to the smallest that would do: edges may be a half coarser
constexpr double fewestSoft = 256.0; // texels of soft edges: with fewer, what 128 of them reach would be most of a map
constexpr double fitsOfAMap = 50.0;  // see MapForecast::fits
constexpr double keptClear = 3.0; // texels at a map's sides: what a comparison reaches over, and one against rounding

/// Beside the smallest one that would do.
bool isNarrow(const MapFit& fit, const MapFit& smallest) { return fit.area() <= mostWaste * smallest.area(); }

bool isSameRequest(const MapRequest& one, const MapRequest& other) {
    return one.light == other.light && one.cone == other.cone && one.casters == other.casters;
}

} // namespace

const std::vector<glm::dvec4>& LightShadowMaps::find(const ViewFrame& view, const MapRequest& request) {
    const glm::dmat4 eyeFromScene = SceneFrame(request.casters->layers.origin).eyeFromScene(view);
    SeenScene seen{toGlm(view.projection) * eyeFromScene, // clip space is the projection of eye space to the last bit
                   eyeFromScene,
                   {view.pixels.x(), view.pixels.y()},
                   view.seenValue};
    const bool sameView = seen.isAs(_faces.seen());
    if (!sameView) {
        seen.receivers = receiversOf(view, eyeFromScene);
        _faces.see(std::move(seen));
        _foundFor = 0;
    }
    const bool same = sameView && isSameRequest(request, _latest);
    take(request, same ? _faces.flatsCast() : anyIsBetween(*request.casters, request.light, _faces.seen().receivers));
    settle(same, request);
    if (_foundFor == _texels) return _needed;
    _faces.find(_texels);
    _foundFor = _texels;
    _needed.clear();
    const glm::dmat4& clipFromScene = _faces.seen().clipFromScene;
    for (const Face& face : _faces.each)
        for (const glm::dvec4& point : face.needed.corners3D()) _needed.push_back(clipFromScene * point);
    return _needed;
}

void LightShadowMaps::take(const MapRequest& request, bool flats) {
    const MapRequest& old = _faces.request();
    const CasterLayers& layers = request.casters->layers;
    const bool sameMaps = old.settings == request.settings;
    if (old.casters && old.casters->layers.origin == layers.origin && _faces.flatsCast() == flats && sameMaps &&
        isSameLight(request, old, layers.widest) && (old.casters == request.casters || _faces.haveSameSides(layers))) {
        if (old.casters != request.casters) _foundFor = 0;
        return _faces.takeCasters(*request.casters);
    }
    if (!sameMaps) _map = nullptr;
    _foundFor = 0;
    _faces.begin(request, flats);
    if (!_map) _texels = request.settings.size;
}

/// Where nothing changes any more, finds all anew, for what is kept of maps goes by frames before: at once, so that edges step
/// as the motion ends and not later. That is as dear as a change, so the wait doubles while rests prove short: what moves in
/// every second frame is soon not found anew each time.
///
/// @param same  view, light and casters are those of the last frame.
void LightShadowMaps::settle(bool same, const MapRequest& latest) {
    if (!same) {
        if (_rest > 0) _patience = _rest < longRest ? std::min(2 * _patience, longRest) : 1;
        _rest = _latest.casters ? 0 : longRest; // a light's first frame has none before
        _latest = latest;
    } else if (_rest < longRest && ++_rest == _patience) {
        MapRequest now = _faces.request();
        now.light = latest.light;
        now.cone = latest.cone;
        _texels = now.settings.size;
        _foundFor = 0;
        _faces.begin(now, _faces.flatsCast());
    }
}

void LightShadowMaps::update(const ViewFrame& view, MapMeshes& meshes) {
    const MapCasters& casters = *_faces.request().casters;
    const SelfDrawnCasters selfDrawn(casters.selfDrawn, SceneFrame(casters.layers.origin).eyeFromScene(view), view);
    resize();
    const bool due = anyDue();
    if (!due && isOfCasters() && _picture->selfDrawn.areSame(selfDrawn)) return;
    for (Face& face : _faces.each) {
        if (face.needed.empty())
            face.fit = std::nullopt;
        else if (!holds(face))
            face.fit = fitOf(face);
    }
    const bool stillAgain = _picture && _picture->still.of == casters.still,
               movingAgain = _picture && _picture->moving.of == casters.moving;
    const osg::ref_ptr<MapPicture> picture = new MapPicture;
    picture->selfDrawn = selfDrawn;
    meshes.startPicture();
    picture->still = stillAgain && !due ? _picture->still : drawnOf(*casters.still, stillAgain, meshes);
    picture->moving = drawnOf(*casters.moving, movingAgain, meshes);
    picture->size = _texels;
    const glm::ivec2 size = addTiles(*picture);
    if (!_map || _map->size != size)
        _map = new DepthMap(size, _faces.request().settings.blends ? osg::Texture::LINEAR : osg::Texture::NEAREST);
    _picture = picture;
}

/// On a side of the map that needs most.
double LightShadowMaps::texelsWanted() const {
    double wanted = 0.0;
    for (const Face& face : _faces.each) {
        if (face.needed.empty()) continue;
        if (_faces.request().isWide(face.side->frame)) wanted = std::max(wanted, fewestSoft);
        const double size = (holds(face) ? *face.fit : fitOf(face)).longer();
        wanted = std::max(wanted, size / (_faces.request().settings.widestTexel * face.texel));
    }
    return wanted;
}

int LightShadowMaps::mapsNeeded() const {
    const auto needed = [](const Face& face) { return !face.needed.empty(); };
    return static_cast<int>(std::count_if(_faces.each.begin(), _faces.each.end(), needed));
}

/// No fewer than rows.
int LightShadowMaps::columns() const { return mapsNeeded() > 6 ? 4 : mapsNeeded() > 4 ? 3 : 2; }

int LightShadowMaps::mostTexels() const { return MapFaces::largestTexture / std::clamp(mapsNeeded(), 1, columns()); }

/// Takes other texels than before if need be, fewer only where a map is to be drawn anyway: none holds what it must then.
void LightShadowMaps::resize() {
    constexpr int rounds = 8; // what soft edges reach depends on how wide texels are
    const int most = std::min(_faces.request().settings.size, mostTexels());
    const bool begun =
        std::none_of(_faces.each.begin(), _faces.each.end(), [](const Face& face) { return bool(face.fit); });
    int before = _map && !(begun && isSettled()) ? _texels : 0;
    for (int round = 0; round < rounds; ++round) {
        const int texels = texelsFor(texelsWanted(), most, before);
        if (texels == before || (texels < before && !anyDue())) return;
        before = _texels = texels;
        for (Face& face : _faces.each) {
            face.fit = std::nullopt;
            _faces.findHeld(face, _texels);
        }
    }
}

bool LightShadowMaps::anyDue() const {
    return std::any_of(_faces.each.begin(), _faces.each.end(),
                       [this](const Face& face) { return !face.needed.empty() && !holds(face); });
}

/// True if the face's map is not to be drawn again.
bool LightShadowMaps::holds(const Face& face) const {
    if (!face.fit || !face.fit->covers(face.held, (keptClear - 1.0) / _texels)) return false;
    return isNarrow(*face.fit, freshFit(face));
}

/// What moves will be beside what casters can darken now.
MapFit LightShadowMaps::freshFit(const Face& face) const {
    MapOutline most = face.reach;
    if (!isSettled() && !_faces.request().casters->moving->casters->pieces.empty()) {
        most.merge(face.held);
        most.grow(reserve * face.held.length());
    }
    return fitMap(face.side->frame, face.held, most, {reserve, keptClear / _texels, thickOf(face)});
}

/// The map that there was, moved by whole texels, if that does as well: edges stay where they are then. It must have some
/// reserve left, or a view that slowly widens would have it moved, and so drawn again, in one frame after the other.
MapFit LightShadowMaps::fitOf(const Face& face) const {
    const MapFit fresh = freshFit(face);
    if (!face.fit) return fresh;
    const MapFit slid = slidMap(*face.fit, face.side->frame, face.held, thickOf(face), _texels);
    const bool doesAsWell = slid.covers(face.held, keptClear / _texels + leastReserve) && isNarrow(slid, fresh);
    return doesAsWell ? slid : fresh;
}

/// Where nothing changes any more, as in a light's first picture: all triangles, for where only those turned to the light are
/// drawn, single texels at rims differ.
MapPicture::Layer LightShadowMaps::drawnOf(const MapLayer& layer, bool again, MapMeshes& meshes) const {
    MapPicture::Layer drawn{&layer};
    for (std::size_t i = 0; i < layer.meshes.size(); ++i) {
        const PlacedMesh& placed = layer.casters->meshes[i];
        const AlignedBox box = boxOf(placed, layer.casters->origin);
        for (const MapCutout& cutout : layer.meshes[i]->cutouts)
            if (_faces.flatsCast() || !cutout.flat) drawn.cutouts.push_back(cutout);
        if (placed.selfDrawn || (placed.isBody && isFlat(box) && !_faces.flatsCast())) continue;
        const bool moving = &layer == _faces.request().casters->moving;
        const auto triangles = meshes.trianglesOf(*layer.meshes[i], _faces.flatsCast(), again && !isSettled(), moving);
        if (!triangles) continue;
        bool outside = false;
        if (!isSettled()) outside = triangles->isOutside(glm::inverse(placed.sceneFromMesh) * _faces.request().light);
        drawn.meshes.push_back({triangles, placed.sceneFromMesh, box, outside});
    }
    return drawn;
}

/// @return texels of them all.
glm::ivec2 LightShadowMaps::addTiles(MapPicture& picture) {
    std::vector<std::pair<const Face*, glm::ivec2>> tiles;
    for (const Face& face : _faces.each) {
        const int tile = static_cast<int>(tiles.size());
        if (face.fit) tiles.emplace_back(&face, _texels * glm::ivec2(tile % columns(), tile / columns()));
    }
    std::stable_sort(tiles.begin(), tiles.end(),
                     [](const auto& a, const auto& b) { return a.first->fit->area() < b.first->fit->area(); });
    glm::ivec2 end(0);
    for (const auto& [face, corner] : tiles) {
        picture.tiles.push_back(tileOf(*face, corner));
        picture.divided = picture.divided || (face->part > 0 && tiles.size() > 1);
        end = glm::max(end, corner + _texels);
    }
    return end;
}

/// Before a lamp's nearest caster nothing is drawn: what is in a plane with the lamp would be anywhere, by floats.
MapPicture::Tile LightShadowMaps::tileOf(const Face& face, const glm::ivec2& corner) {
    constexpr double aside = 8.0;             // of the widest frame: the way to its corner to its distance
    constexpr double least = 1.0 / (1 << 20); // of the coordinates: what rays leave out, too
    const LightFrame& frame = face.side->frame;
    MapPicture::Tile tile{corner, face.fit->mapFromScene, mapErrors(frame, *face.fit, _faces.reachOf(face), _texels),
                          mapSpread(frame, *face.fit, _faces.request().lightRadius(frame),
                                    _faces.request().settings.blurRadius, _texels)};
    const double size = glm::length(glm::dvec3(_faces.request().light)) + glm::length(_faces.reachOf(face));
    if (!frame.isParallel) tile.nearest = std::max(std::min(_faces.clearance(), size) / aside, least * size);
    tile.movers = moversIn(tile);
    return tile;
}

/// Texels of a tile that what moves may cover.
PixelRect LightShadowMaps::moversIn(const MapPicture::Tile& tile) const {
    const glm::dmat4 clipFromScene = tile.clipFromScene();
    glm::dvec2 low(1.0), high(-1.0);
    const auto add = [&](const AlignedBox& box) {
        const auto corners = boxCorners(box.low, box.high, clipFromScene);
        const auto bounds = screenBounds(corners);
        if (!bounds) return;
        low = glm::min(low, bounds->low);
        high = glm::max(high, bounds->high);
    };
    const MapLayer& moving = *_faces.request().casters->moving;
    std::for_each(moving.unflats.begin(), moving.unflats.end(), add);
    if (_faces.flatsCast()) std::for_each(moving.flats.begin(), moving.flats.end(), add);
    for (const SelfDrawnCaster& caster : _faces.request().casters->selfDrawn) add(caster.box);
    if (!(low.x <= high.x && low.y <= high.y)) return {};
    const double more = 1.0 + std::max(tile.errors.nearest.texels, tile.errors.farthest.texels), size = _texels;
    const auto texel = [size](const glm::dvec2& place) { return glm::ivec2(glm::clamp(place, 0.0, size)); };
    const glm::ivec2 first = texel(glm::floor((low + 1.0) / 2.0 * size - more)),
                     end = texel(glm::ceil((high + 1.0) / 2.0 * size + more));
    return {tile.corner.x + first.x, tile.corner.y + first.y, end.x - first.x, end.y - first.y};
}

void LightShadowMaps::letGo() {
    if (isOfCasters()) return;
    _map = nullptr;
    _picture = nullptr;
}

MapForecast forecastMaps(const ViewFrame& view, const ShadowLight& light, const MapCasters& boxes,
                         const MapSettings& settings) {
    const auto usable = lightInScene(light.inGroup, SceneFrame(boxes.layers.origin));
    if (!usable) return {};
    LightShadowMaps maps;
    const auto corners = maps.find(view, {*usable, spotOf(light), &boxes, settings});
    MapForecast result = maps.forecast();
    if (!corners.empty()) result.bounds = screenBounds(corners);
    if (!result.bounds) result.maps = 0;
    return result;
}

MapForecast LightShadowMaps::forecast() const {
    MapForecast result;
    result.maps = mapsNeeded();
    result.most = mostTexels();
    result.touchesFlat = _faces.flatsCast() && anyTouchesBehind(*_faces.request().casters, _faces.request().light);
    for (const Face& face : _faces.each) {
        const double looks = face.side->frame.isParallel ? 1.0 : 2.0; // a lamp's are divided by distance
        result.fits += looks * (fitsOfAMap + double(face.side->blockers.size() * _faces.seen().receivers.size()));
        if (face.needed.empty()) continue;
        const MapFit fit = freshFit(face);
        result.each.push_back({fit.mapFromScene, _faces.placesOf(face)});
        result.pixel = std::min(result.pixel, face.texel);
        result.texels = std::max(result.texels, fit.longer() / face.texel);
    }
    return result;
}

} // namespace gnomon
