// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/LightShadowMaps.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

/// Of a sun one; of a lamp that sees all casters to one side one, else those of a cube, a little larger so that what is
/// on an edge is in both. Of a spot one about its cone, unless that is nearly flat.
///
/// A lamp is a sun where that moves no shadow by more than an eighth of a texel: else its depths would be rounded off.
///
/// @param light, cone  about the casters' origin. @param texels  on a map's side.
std::vector<LightFrame> framesOf(const glm::dvec4& light, const std::optional<SpotCone>& cone,
                                 const CasterLayers& casters, int texels) {
    const glm::dvec3 at(light);
    if (light.w == 0.0 || glm::length(at) > 8.0 * texels * glm::length(casters.reach))
        return {sunFrame(glm::normalize(at))};
    constexpr double onEdges = 1.05, flat = 4.0;
    if (cone && std::tan(cone->cutoff) < flat) return {lampFrame(at, cone->axis, onEdges * std::tan(cone->cutoff))};
    std::vector<LightFrame> frames;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 way(0.0);
            way[axis] = sign;
            frames.push_back(lampFrame(at, way, onEdges));
        }
    constexpr double wide = 2.0;
    const LightFrame ahead = lampFrame(at, glm::normalize(-at), wide);
    const auto corners = boxCorners(casters.low, casters.high, glm::dmat4(1.0));
    const bool holdsAll = std::all_of(ahead.halfSpaces.begin(), ahead.halfSpaces.end(), [&](const glm::dvec4& half) {
        return std::all_of(corners.begin(), corners.end(), [&](const auto& p) { return glm::dot(half, p) > 0.0; });
    });
    return holdsAll ? std::vector{ahead} : frames;
}

bool areSame(const std::vector<LightFrame>& a, const std::vector<LightFrame>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LightFrame& one, const LightFrame& other) {
        return one.sun == other.sun && one.lightFromScene == other.lightFromScene && one.halfSpaces == other.halfSpaces;
    });
}

constexpr double reserve = 1.0 / 16.0; // of a map's sides
constexpr double mostWaste = 2.0;      // area of a map to the smallest that would do: edges may be a half coarser
constexpr double fewestSoft = 256.0;  // texels of soft edges: with fewer, what 128 of them reach would be most of a map
constexpr double border = 3.0;        // texels: what a comparison reaches over, and one against rounding
constexpr int largestTexture = 16384; // texels on a side: what OpenGL has in most places
constexpr double sameLight = 1e-7;    // of the distance: what floats make of a light at rest
constexpr double sameAmong = 1e-10;   // of what is about a lamp: what doubles do

/// @param widest  of the drawables, which a lamp may be within.
bool isSame(const glm::dvec4& a, const glm::dvec4& b, double widest) {
    const double off = sameLight * glm::length(glm::dvec3(b)) + (b.w == 0.0 ? 0.0 : sameAmong * widest);
    return a.w == b.w && glm::distance(a, b) <= off;
}

bool isSame(const std::optional<SpotCone>& a, const std::optional<SpotCone>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->cutoff == b->cutoff && glm::distance(a->axis, b->axis) <= sameLight;
}

/// True if the maps are the same, whatever the view and the unit.
bool haveSameMaps(const ShadowMapOptions& a, const ShadowMapOptions& b) {
    const auto key = [](const ShadowMapOptions& o) { return std::tie(o.size, o.filter, o.cascades, o.edges); };
    const auto softness = [](const ShadowMapOptions& o) { return std::tie(o.sunAngle, o.lampSize, o.radius); };
    return key(a) == key(b) && (a.edges != ShadowMapOptions::SOFT || softness(a) == softness(b));
}

/// Where what is flat, a ground for one, may stand between the light and a place. Of all that is level, each way, the one
/// nearest to the light says so for all.
HalfSpaces beyondFlats(const MapCasters& casters, const glm::dvec4& light) {
    HalfSpaces halves; // six at most
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
    const HalfSpaces halves = beyondFlats(casters, light);
    if (halves.empty()) return false;
    return std::any_of(receivers.begin(), receivers.end(), [&](const MapReceiver& receiver) {
        const auto corners = boxCorners(receiver.low, receiver.high, receiver.sceneFromBox);
        return std::any_of(halves.begin(), halves.end(), [&](const glm::dvec4& half) {
            return std::any_of(corners.begin(), corners.end(),
                               [&](const glm::dvec4& corner) { return !(glm::dot(half, corner) < 0.0); });
        });
    });
}

/// All faces, as in a light's first picture: where only those turned to it are drawn, single texels at rims differ.
constexpr CullableFaces::Outside wholly{false, false};

bool isWhole(const MapPicture::Layer& layer) {
    return std::all_of(layer.meshes.begin(), layer.meshes.end(), [](const MapLayer::Drawn& mesh) {
        return (!mesh.faces->solids || !mesh.outside.solids) && (!mesh.faces->holed || !mesh.outside.holed);
    });
}

} // namespace

void LightShadowMaps::setCause(const MapRequest& cause) {
    _light = cause.light;
    _cone = cause.cone;
    const MapRequest& old = _cause;
    const bool sameMaps = haveSameMaps(old.settings, cause.settings);
    if (old.casters && old.casters->layers->origin == cause.casters->layers->origin && old.flats == cause.flats &&
        sameMaps && isSame(cause.cone, old.cone) && isSame(cause.light, old.light, cause.casters->layers->widest) &&
        (old.casters == cause.casters ||
         areSame(_frames, framesOf(old.light, old.cone, *cause.casters->layers, old.settings.size))))
        return takeCasters(*cause.casters);
    if (!sameMaps) _map = nullptr;
    _cause = cause;
    _stale = true;
    begin();
    if (!_map) _texels = cause.settings.size;
}

void LightShadowMaps::begin() {
    _clear = _clearOfStill = std::nullopt;
    _faces.clear();
    _splits.clear();
    _cascades = _cause.settings.cascades;
    _frames = framesOf(_cause.light, _cause.cone, *_cause.casters->layers, _cause.settings.size);
    for (const LightFrame& frame : _frames) addFaces(frame);
}

/// From a lamp to the nearest caster: nothing that is nearer is dark.
double LightShadowMaps::clearance() {
    const glm::dvec3 lamp(_cause.light);
    if (!_clearOfStill) _clearOfStill = _cause.casters->still->clearanceOf(lamp);
    if (!_clear)
        _clear = std::min(
            {*_clearOfStill, _cause.casters->moving->clearanceOf(lamp), clearanceOf(_cause.casters->own, lamp)});
    return *_clear;
}

/// Distance along a frame's axis before which nothing is drawn. What is in a plane with the lamp would be anywhere, by
/// floats. 0 for a sun.
double LightShadowMaps::nearestDrawn(const MapSlice& face) {
    constexpr double corner = 8.0;            // of the widest frame: the way to it to its distance
    constexpr double least = 1.0 / (1 << 20); // of the coordinates: what rays leave out, too
    if (face.frame.sun) return 0.0;
    const double size = glm::length(glm::dvec3(_cause.light)) + glm::length(reachOf(face));
    return std::max(std::min(clearance(), size) / corner, least * size);
}

/// Where nothing changes any more, finds all anew, for what is kept of maps goes by frames before. That is as dear as a
/// change: what moves in every second frame, say, is not found anew each time.
void LightShadowMaps::settle(Seen seen) {
    constexpr int fewestAtRest = 8; // frames
    if (seen == _seen) {
        if (_settled || ++_rest < fewestAtRest) return;
        _settled = _anew = true;
        _cause.light = _light;
        _cause.cone = _cone;
        _texels = _cause.settings.size;
        begin();
        return;
    }
    _settled = !_seen.casters; // the first frame
    _rest = 0;
    _seen = std::move(seen);
}

/// As seen from the same light.
void LightShadowMaps::takeCasters(const MapCasters& casters) {
    if (_cause.casters == &casters) return;
    _clear = std::nullopt;
    const bool sameStill = _cause.casters->still == casters.still;
    if (!sameStill) _clearOfStill = std::nullopt;
    _cause.casters = &casters;
    _stale = true;
    const MapSlice* before = nullptr; // of the same frame
    for (MapSlice& face : _faces) {
        if (face.part > 0) {
            face.still = before->still;
            face.blockers = before->blockers;
        } else {
            if (!sameStill) face.takeStill(_cause);
            face.takeBlockers(_cause);
        }
        before = &face;
    }
}

void LightShadowMaps::addFaces(const LightFrame& frame) {
    MapSlice face(frame, _cause);
    const int wanted = _cause.settings.cascades, most = 2 * _cause.settings.size <= largestTexture ? mostCascades : 1;
    const std::size_t parts = frame.sun ? std::size_t(wanted ? wanted : most) : 2;
    for (; face.part < parts; ++face.part) _faces.push_back(face);
}

/// On a side of a texel, were there one map, at a distance along the line of sight.
double LightShadowMaps::pixelsATexel(double distance) const {
    const auto side = [&](int axis) {
        return 2.0 * distance / glm::length(glm::dvec3(glm::row(_seen.clipFromScene, axis)));
    };
    const MapSlice& face = _faces.front();
    MapOutline all(face.frame);
    for (const MapBlocker& blocker : face.blockers) all.merge(blocker.outline);
    const glm::dvec2 most = fitMap(face.frame, all, all, 0.0, 0.0, 1.0).size;
    const double covered = std::min(std::max(most.x, most.y), std::max({side(0), side(1), distance}));
    return covered / _cause.settings.size / (side(0) / _seen.pixels.x);
}

void LightShadowMaps::findSplits() {
    if (!(_faces.size() > 1 && _faces.front().frame.sun)) return;
    SeenRange seen(_seen.clipFromScene);
    for (const MapBlocker& blocker : _faces.front().blockers) {
        const HalfSpaces halfSpaces =
            both(both(viewPart(_seen.clipFromScene, {}, 0), blocker.halfSpaces), blocker.outline.sides());
        for (const MapReceiver& receiver : _seen.receivers) seen.addBox(receiver, halfSpaces);
    }
    if (!_cause.settings.cascades && !seen.empty())
        _cascades = cascadesFor(seen, pixelsATexel(seen.farthest), _cascades);
    _splits = cascadeSplits(seen, std::max(_cascades, 1));
}

std::vector<glm::dvec4> LightShadowMaps::find(const ViewFrame& view, MapRequest wanted) {
    const glm::dmat4 eyeFromScene = SceneFrame(wanted.casters->layers->origin).eyeFromScene(view);
    Seen seen{toGlm(view.projection) * eyeFromScene, // clip space is the projection of eye space to the last bit
              {view.pixels.x(), view.pixels.y()},
              receiversOf(view, eyeFromScene),
              wanted.light,
              wanted.casters};
    wanted.flats = anyIsBetween(*wanted.casters, wanted.light, seen.receivers);
    setCause(wanted);
    settle(std::move(seen));
    findSplits();
    if (_faces.front().frame.sun)
        for (MapSlice& face : _faces) {
            face.isAlone = _splits.empty();
            if (face.part <= _splits.size())
                findFace(face, viewPart(_seen.clipFromScene, _splits, face.part));
            else
                face.clear();
        }
    else
        for (std::size_t i = 0; i < _faces.size(); i += 2) findLamp(_faces[i], _faces[i + 1]);
    std::vector<glm::dvec4> points;
    for (const MapSlice& face : _faces)
        for (const glm::dvec4& point : face.needed.body()) points.push_back(_seen.clipFromScene * point);
    return points;
}

void LightShadowMaps::findFace(MapSlice& face, const HalfSpaces& halfSpaces) {
    face.find(_cause, _seen.receivers, halfSpaces, TexelDensity(face.frame, _seen.clipFromScene, _seen.pixels),
              _texels);
}

/// Divides between two maps what one would hold too coarsely.
void LightShadowMaps::findLamp(MapSlice& far, MapSlice& near) {
    const HalfSpaces inView = viewPart(_seen.clipFromScene, {}, 0);
    findFace(far, inView);
    near.clear();
    if (!(far.needed.split() > 0.0)) return;
    constexpr double corner = 1.8; // of a cube's face and what it is larger by: the way to it to its distance
    const HalfSpaces beyondClear = both(inView, {fartherThan(far.frame, clearance() / corner)});
    findFace(far, beyondClear);
    const double split = far.needed.split();
    if (!(split > 0.0)) return;
    findFace(near, both(beyondClear, {nearerThan(near.frame, split)}));
    findFace(far, both(inView, {fartherThan(far.frame, split)}));
}

MapForecast LightShadowMaps::forecast() const {
    MapForecast result;
    result.maps = mapsNeeded();
    result.most = largestTexture / std::clamp(result.maps, 1, columns());
    for (const MapSlice& face : _faces) {
        if (face.needed.empty()) continue;
        const MapFit fit = fitOf(face);
        const glm::dvec2 size = fit.size;
        result.each.push_back({fit.mapFromScene, face.frame.sun ? viewPart(_seen.clipFromScene, _splits, face.part)
                                                                : face.frame.halfSpaces});
        result.pixel = std::min(result.pixel, face.texel);
        result.texels = std::max(result.texels, std::max(size.x, size.y) / face.texel);
    }
    return result;
}

MapForecast forecastMaps(const ViewFrame& view, const ShadowLight& light, const MapCasters& boxes,
                         const ShadowMapOptions& settings) {
    const auto usable = localLight(light.inGroup, SceneFrame(boxes.layers->origin));
    if (!usable) return {};
    LightShadowMaps maps(nullptr, light.number);
    const auto corners = maps.find(view, {*usable, spotOf(light), &boxes, false, settings});
    MapForecast result = maps.forecast();
    result.bounds = corners.empty() ? std::nullopt : screenBounds(corners);
    if (!result.bounds) result.maps = 0;
    return result;
}

/// On a side of the map that needs most.
double LightShadowMaps::texelsWanted() const {
    double wanted = 0.0;
    for (const MapSlice& face : _faces) {
        if (face.needed.empty()) continue;
        if (_cause.isWide(face.frame)) wanted = std::max(wanted, fewestSoft);
        const glm::dvec2 size = holds(face) ? face.fit->size : fitOf(face).size;
        wanted = std::max(wanted, std::max(size.x, size.y) / (widestTexel(_cause.settings) * face.texel));
    }
    return wanted;
}

int LightShadowMaps::mapsNeeded() const {
    const auto needed = [](const MapSlice& face) { return !face.needed.empty(); };
    return static_cast<int>(std::count_if(_faces.begin(), _faces.end(), needed));
}

/// No fewer than rows.
int LightShadowMaps::columns() const { return mapsNeeded() > 6 ? 4 : mapsNeeded() > 4 ? 3 : 2; }

/// Takes other texels than before if need be, fewer only where a map is to be drawn anyway: none holds what it must then.
void LightShadowMaps::resize() {
    constexpr int rounds = 8; // what soft edges reach depends on how wide texels are
    const int most = std::min(_cause.settings.size, largestTexture / std::clamp(mapsNeeded(), 1, columns()));
    int before = _map && !_anew ? _texels : 0;
    _anew = false;
    for (int round = 0; round < rounds; ++round) {
        const int texels = texelsFor(texelsWanted(), most, before);
        if (texels == before || (texels < before && !anyDue())) return;
        before = _texels = texels;
        for (MapSlice& face : _faces) {
            face.fit = std::nullopt;
            face.findHeld(_cause, _texels);
        }
    }
}

bool LightShadowMaps::anyDue() const {
    return std::any_of(_faces.begin(), _faces.end(),
                       [this](const MapSlice& face) { return !face.needed.empty() && !holds(face); });
}

/// True if the face's map is not to be drawn again.
bool LightShadowMaps::holds(const MapSlice& face) const {
    if (!face.fit || !face.fit->covers(face.held, (border - 1.0) / _texels)) return false;
    return face.fit->area() <= mostWaste * fitOf(face).area();
}

/// What moves will be beside what casters can darken now.
MapFit LightShadowMaps::fitOf(const MapSlice& face) const {
    MapOutline most = face.reach;
    if (!_settled && !_cause.casters->moving->casters->pieces.empty()) {
        most.merge(face.held);
        most.grow(reserve * face.held.length());
    }
    return fitMap(face.frame, face.held, most, reserve, border / _texels, glm::length(reachOf(face)) / 64.0);
}

/// Half sides of a box about the origin that holds what its map draws: no further than the map and the widest drawable.
glm::dvec3 LightShadowMaps::reachOf(const MapSlice& face) const {
    glm::dvec3 result(0.0);
    for (const glm::dvec4& point : face.held.body()) result = glm::max(result, glm::abs(glm::dvec3(point) / point.w));
    const CasterLayers& layers = *_cause.casters->layers;
    return glm::min(layers.reach, result + (_cause.flats ? layers.widest : layers.widestBody));
}

/// Without its tiles. @param due  some are to be drawn from the first.
osg::ref_ptr<MapPicture> LightShadowMaps::pictureOf(const MapPrograms& resources, bool due, MapBodies& bodies,
                                                    const OwnView& view) {
    osg::ref_ptr<MapPicture> picture = new MapPicture;
    const bool stillAgain = _picture && _picture->still.of == _cause.casters->still,
               movingAgain = _picture && _picture->moving.of == _cause.casters->moving;
    bodies.startPicture();
    picture->still = stillAgain && !due ? _picture->still : drawnOf(*_cause.casters->still, stillAgain, bodies);
    picture->moving = drawnOf(*_cause.casters->moving, movingAgain, bodies);
    picture->own = {_cause.casters->own, view};
    picture->program = _frames.front().sun ? resources.casterProgram : resources.casterByLampProgram;
    picture->cutoutProgram = resources.cutoutProgram;
    picture->size = _texels;
    return picture;
}

MapPicture::Layer LightShadowMaps::drawnOf(const MapLayer& layer, bool again, MapBodies& bodies) const {
    MapPicture::Layer drawn{&layer, layer.faces(_cause.flats, again, &layer == _cause.casters->moving, bodies), {}};
    for (MapLayer::Drawn& mesh : drawn.meshes)
        mesh.outside = _settled ? wholly : mesh.faces->outside(glm::inverse(mesh.sceneFromMesh) * _cause.light);
    for (const MapLayer::Cutout& cutout : layer.cutouts)
        if (_cause.flats || !cutout.flat) drawn.cutouts.push_back(cutout);
    return drawn;
}

/// Texels of a tile that what moves may cover.
PixelRect LightShadowMaps::moversIn(const MapPicture::Tile& tile, const MapErrors& errors) const {
    const MapLayer& moving = *_cause.casters->moving;
    glm::dvec2 low(1.0), high(-1.0);
    const auto add = [&](const MapLayer::Box& box) {
        const auto corners = boxCorners(box.low, box.high, tile.clipFromScene);
        const auto bounds = screenBounds({corners.begin(), corners.end()});
        if (!bounds) return;
        low = glm::min(low, bounds->low);
        high = glm::max(high, bounds->high);
    };
    std::for_each(moving.bodyBoxes.begin(), moving.bodyBoxes.end(), add);
    if (_cause.flats) std::for_each(moving.flatBoxes.begin(), moving.flatBoxes.end(), add);
    for (const OwnCaster& caster : _cause.casters->own) add(caster.box);
    if (!(low.x <= high.x && low.y <= high.y)) return {};
    const double more = 1.0 + std::max(errors.nearest.texels, errors.farthest.texels), size = _texels;
    const auto texel = [size](const glm::dvec2& place) { return glm::ivec2(glm::clamp(place, 0.0, size)); };
    const glm::ivec2 first = texel(glm::floor((low + 1.0) / 2.0 * size - more)),
                     end = texel(glm::ceil((high + 1.0) / 2.0 * size + more));
    return {tile.corner.x + first.x, tile.corner.y + first.y, end.x - first.x, end.y - first.y};
}

MapLookUp LightShadowMaps::lookUpOf(const MapSlice& face) const {
    return {face.fit->mapFromScene, mapErrors(face.frame, *face.fit, reachOf(face), _texels),
            mapSpread(face.frame, *face.fit, _cause.lightRadius(face.frame), _cause.settings.radius, _texels)};
}

/// True if the last picture is of the same maps, and drawn in the same way if that is settled.
bool LightShadowMaps::isShown() const {
    const auto tiles = std::count_if(_faces.begin(), _faces.end(), [](const MapSlice& face) { return bool(face.fit); });
    const auto shows = [this](const MapSlice& face) {
        const auto same = [&face](const MapLookUp& lookUp) { return lookUp.mapFromScene == face.fit->mapFromScene; };
        return !face.fit || std::any_of(_lookUps.begin(), _lookUps.end(), same);
    };
    if (_settled && !(isWhole(_picture->still) && isWhole(_picture->moving))) return false;
    return _picture->size == _texels && std::size_t(tiles) == _lookUps.size() &&
           std::all_of(_faces.begin(), _faces.end(), shows);
}

/// The finest map comes first, for pixels take the first that holds them.
void LightShadowMaps::update(const MapPrograms& resources, MapBodies& bodies, const OwnView& view) {
    if (_picture && !_picture->own.areSame({_cause.casters->own, view})) _stale = true;
    resize();
    const bool due = anyDue();
    if (!_stale && !due) return;
    for (MapSlice& face : _faces) {
        if (face.needed.empty())
            face.fit = std::nullopt;
        else if (!holds(face))
            face.fit = fitOf(face);
    }
    if (!_stale && isShown()) return;
    const osg::ref_ptr<MapPicture> picture = pictureOf(resources, due, bodies, view);
    std::vector<std::pair<const MapSlice*, glm::ivec2>> tiles;
    for (const MapSlice& face : _faces) {
        const int tile = static_cast<int>(tiles.size());
        if (face.fit) tiles.emplace_back(&face, picture->size * glm::ivec2(tile % columns(), tile / columns()));
    }
    std::stable_sort(tiles.begin(), tiles.end(),
                     [](const auto& a, const auto& b) { return a.first->fit->area() < b.first->fit->area(); });
    _lookUps.clear();
    glm::ivec2 end(0);
    const glm::dmat4 clipFromMap = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)), glm::dvec3(2.0));
    for (const auto& [face, corner] : tiles) {
        _lookUps.push_back(lookUpOf(*face));
        picture->tiles.push_back({corner, clipFromMap * face->fit->mapFromScene, nearestDrawn(*face), {}});
        picture->tiles.back().movers = moversIn(picture->tiles.back(), _lookUps.back().errors);
        end = glm::max(end, corner + picture->size);
    }
    if (!_map || _map->size != end)
        _map = new DepthMap(end, _cause.settings.filter == ShadowMapOptions::NEAREST ? osg::Texture::NEAREST
                                                                                     : osg::Texture::LINEAR);
    _picture = picture;
    _stale = false;
}

void LightShadowMaps::letGo() {
    if (_picture && _picture->still.of == _cause.casters->still && _picture->moving.of == _cause.casters->moving)
        return;
    _map = nullptr;
    _picture = nullptr;
    _stale = true;
}

/// True if several maps may hold a place of their light's frame, but not its depth.
bool LightShadowMaps::isDivided() const {
    const auto further = [](const MapSlice& face) { return face.part > 0 && face.fit; };
    return _lookUps.size() > 1 && std::any_of(_faces.begin(), _faces.end(), further);
}

MapLookupPass LightShadowMaps::quad() const {
    MapLookupPass quad;
    quad.map = _map;
    quad.picture = _picture;
    quad.lookUps = _lookUps;
    quad.rounding = _cause.casters->layers->rounding;
    quad.clipFromScene = _seen.clipFromScene;
    quad.filter = _cause.settings.filter;
    quad.cascades = isDivided();
    quad.soft = _cause.settings.edges == ShadowMapOptions::SOFT;
    quad.smooth = _cause.settings.edges == ShadowMapOptions::SMOOTH && quad.filter != ShadowMapOptions::NEAREST;
    quad.penumbra = _cause.lightRadius(_faces.front().frame) > 0.0;
    return quad;
}

void LightShadowMaps::resizeGLObjectBuffers(unsigned maxSize) {
    if (_map) _map->resizeGLObjectBuffers(maxSize);
    if (_cause.casters) _cause.casters->resizeGLObjectBuffers(maxSize);
}

void LightShadowMaps::release(osg::State* state) {
    if (_map) _map->release(state);
    if (_cause.casters) _cause.casters->releaseGLObjects(state);
}

} // namespace gnomon
