// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/LightShadowMaps.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

constexpr double reserve = 1.0 / 16.0; // of a map's sides
constexpr double mostWaste = 2.0;      // area of a map to the smallest that would do: edges may be a half coarser
constexpr double fewestSoft = 256.0; // texels of soft edges: with fewer, what 128 of them reach would be most of a map
constexpr double keptClear = 3.0; // texels at a map's sides: what a comparison reaches over, and one against rounding
constexpr int largestTexture = 16384;  // texels on a side: what OpenGL has in most places
constexpr double atLamp = 1e6;         // of a lamp's distances: what is nearer is at the lamp itself
constexpr double widestSpread = 128.0; // texels: as map_soft.frag has it

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

bool areSame(const LightFrame& a, const LightFrame& b) {
    return a.isParallel == b.isParallel && a.lightFromScene == b.lightFromScene && a.halfSpaces == b.halfSpaces;
}

/// Half-space of what something flat can darken: what is beyond it, seen from the light.
glm::dvec4 beyond(const MapBox& flat, const glm::dvec4& light, const glm::dvec3& reach) {
    const glm::dvec3 size = flat.high - flat.low;
    const int axis = size.x == 0.0 ? 0 : size.y == 0.0 ? 1 : 2;
    const double level = flat.low[axis], side = light[axis] - light.w * level > 0.0 ? 1.0 : -1.0;
    glm::dvec4 result(0.0, 0.0, 0.0, side * level - 1e-6 * glm::length(reach)); // what eye space makes of a place in it
    result[axis] = -side;
    return result;
}

/// True if what is flat, a ground for one, may stand between the light and a place that is seen: not if all of those are on the
/// light's side of it, or in it. Of all that is level, each way, the one nearest to the light says so for all.
bool anyIsBetween(const MapCasters& casters, const glm::dvec4& light, const std::vector<PlacedBox>& receivers) {
    std::map<std::array<double, 3>, glm::dvec4> halves; // by the way; six at most
    for (const MapLayer* layer : {casters.still.get(), casters.moving.get()})
        for (const MapPart& flat : layer->flats) {
            const glm::dvec4 half = beyond(flat, light, casters.layers.reach);
            glm::dvec4& known = halves.try_emplace(std::array{half.x, half.y, half.z}, half).first->second;
            known.w = std::max(known.w, half.w);
        }
    return std::any_of(receivers.begin(), receivers.end(), [&](const PlacedBox& receiver) {
        return std::any_of(halves.begin(), halves.end(),
                           [&](const auto& half) { return !cornersWithin(receiver, {half.second}).empty(); });
    });
}

/// True of what the light sees edge-on, and of triangles of no area: hard edges have nothing between them.
bool isThin(const LightFrame& frame, const MapOutline& outline) {
    const glm::dvec2 size = fitMap(frame, outline, outline, 0.0, 0.0, 1.0).size;
    return std::min(size.x, size.y) <= 2e-6 * std::max(size.x, size.y); // fitMap() makes no side less than half of that
}

} // namespace

std::vector<glm::dvec4> LightShadowMaps::find(const ViewFrame& view, const MapRequest& request) {
    const glm::dmat4 eyeFromScene = SceneFrame(request.casters->layers.origin).eyeFromScene(view);
    Seen seen{toGlm(view.projection) * eyeFromScene, // clip space is the projection of eye space to the last bit
              {view.pixels.x(), view.pixels.y()},
              receiversOf(view, eyeFromScene),
              request};
    setRequest(request, anyIsBetween(*request.casters, request.light, seen.receivers));
    settle(std::move(seen));
    findSplits();
    if (_sides.front().frame.isParallel)
        for (Face& face : _faces)
            face.part <= _splits.size() ? findFace(face, viewPart(_seen.clipFromScene, _splits, face.part))
                                        : face.clear();
    else
        for (std::size_t i = 0; i < _faces.size(); i += 2) findLamp(_faces[i], _faces[i + 1]);
    std::vector<glm::dvec4> points;
    for (const Face& face : _faces)
        for (const glm::dvec4& point : face.needed.body()) points.push_back(_seen.clipFromScene * point);
    return points;
}

void LightShadowMaps::setRequest(const MapRequest& request, bool flats) {
    const MapRequest& old = _request;
    const CasterLayers& layers = request.casters->layers;
    const auto areSameSides = [&] {
        const auto frames = framesOf(old.light, old.cone, layers, old.settings.size);
        return std::equal(_sides.begin(), _sides.end(), frames.begin(), frames.end(),
                          [](const Side& side, const LightFrame& frame) { return areSame(side.frame, frame); });
    };
    const bool sameMaps = old.settings == request.settings;
    if (old.casters && old.casters->layers.origin == layers.origin && _flats == flats && sameMaps &&
        isSameLight(request, old, layers.widest) && (old.casters == request.casters || areSameSides()))
        return takeCasters(*request.casters);
    if (!sameMaps) _map = nullptr;
    _request = request;
    _flats = flats;
    begin();
    if (!_map) _texels = request.settings.size;
}

/// As seen from the same light.
void LightShadowMaps::takeCasters(const MapCasters& casters) {
    if (_request.casters == &casters) return;
    const bool sameStill = _request.casters->still == casters.still;
    if (!sameStill) _clearOfStill = std::nullopt;
    _request.casters = &casters;
    for (Side& side : _sides) {
        if (!sameStill) side.still = outlinesOf(*casters.still, side.frame);
        findBlockers(side);
    }
}

/// Where nothing changes any more, finds all anew, for what is kept of maps goes by frames before. That is as dear as a
/// change: what moves in every second frame, say, is not found anew each time.
void LightShadowMaps::settle(Seen seen) {
    if (!(seen == _seen)) {
        _rest = _seen.latest.casters ? 0 : fewestAtRest; // a light's first frame has none before
        _seen = std::move(seen);
    } else if (!isSettled() && ++_rest == fewestAtRest) {
        _request.light = _seen.latest.light;
        _request.cone = _seen.latest.cone;
        _texels = _request.settings.size;
        begin();
    }
}

void LightShadowMaps::begin() {
    _clearOfStill = std::nullopt;
    _faces.clear();
    _sides.clear();
    _splits.clear();
    const int wanted = _request.settings.cascades,
              most = 2 * _request.settings.size <= largestTexture ? mostCascades : 1;
    _cascades = wanted;
    for (const LightFrame& frame :
         framesOf(_request.light, _request.cone, _request.casters->layers, _request.settings.size)) {
        _sides.push_back({frame, outlinesOf(*_request.casters->still, frame), {}});
        findBlockers(_sides.back());
    }
    for (const Side& side : _sides) {
        const std::size_t parts = side.frame.isParallel ? std::size_t(wanted ? wanted : most) : 2;
        for (std::size_t part = 0; part < parts; ++part) _faces.emplace_back(side, part);
    }
}

LightShadowMaps::Outlines LightShadowMaps::outlinesOf(const MapLayer& layer, const LightFrame& frame) const {
    Outlines outlines{MapOutline(frame), {}};
    for (const MapPart& body : layer.bodies) outlines.bodies.addBox({body.low, body.high});
    if (!_flats) return outlines;
    for (const MapPart& flat : layer.flats) {
        outlines.flats.emplace_back(frame);
        outlines.flats.back().addBox({flat.low, flat.high});
    }
    return outlines;
}

/// Skips what is empty, and what is flat and behind the bodies: it darkens nothing that they may not, but widens edges where it
/// is far from where they are.
void LightShadowMaps::findBlockers(Side& side) const {
    const bool wide = _request.isWide(side.frame);
    side.blockers.clear();
    const auto add = [&](const MapOutline& outline, const HalfSpaces& halfSpaces) {
        if (!outline.empty()) side.blockers.push_back({outline, halfSpaces});
    };
    const MapCasters& casters = *_request.casters;
    const Outlines moving = outlinesOf(*casters.moving, side.frame);
    MapOutline bodies = side.still.bodies;
    bodies.merge(moving.bodies);
    for (const OwnCaster& caster : casters.own) bodies.addBox({caster.box.low, caster.box.high});
    if (wide || !areThin(side.frame)) add(bodies, {});
    const auto addFlats = [&](const Outlines& outlines, const MapLayer& layer) {
        for (std::size_t i = 0; i < outlines.flats.size(); ++i)
            if (wide || !(bodies.isBefore(outlines.flats[i]) || isThin(side.frame, outlines.flats[i])))
                add(outlines.flats[i], {beyond(layer.flats[i], _request.light, casters.layers.reach)});
    };
    addFlats(side.still, *casters.still);
    addFlats(moving, *casters.moving);
}

/// True of each body: all of them together may be thin where they are not, for one is very far away.
bool LightShadowMaps::areThin(const LightFrame& frame) const {
    const auto isBoxThin = [&frame](const MapBox& box) {
        MapOutline outline(frame);
        outline.addBox({box.low, box.high});
        return outline.empty() || isThin(frame, outline);
    };
    const MapCasters& casters = *_request.casters;
    const auto &still = casters.still->bodies, &moving = casters.moving->bodies;
    return std::all_of(still.begin(), still.end(), isBoxThin) && std::all_of(moving.begin(), moving.end(), isBoxThin) &&
           std::all_of(casters.own.begin(), casters.own.end(), [&](const auto& own) { return isBoxThin(own.box); });
}

void LightShadowMaps::findSplits() {
    const Side& side = _sides.front();
    if (!(_faces.size() > 1 && side.frame.isParallel)) return;
    SeenRange seen(_seen.clipFromScene);
    for (const Blocker& blocker : side.blockers) {
        const HalfSpaces halfSpaces =
            both(both(viewPart(_seen.clipFromScene, {}, 0), blocker.halfSpaces), blocker.outline.sides());
        for (const PlacedBox& receiver : _seen.receivers) seen.addBox(receiver, halfSpaces);
    }
    if (!_request.settings.cascades && !seen.empty())
        _cascades = cascadesFor(seen, pixelsATexel(seen.farthest), _cascades);
    _splits = cascadeSplits(seen, std::max(_cascades, 1));
}

/// On a side of a texel, were there one map, at a distance along the line of sight.
double LightShadowMaps::pixelsATexel(double distance) const {
    const auto side = [&](int axis) {
        return 2.0 * distance / glm::length(glm::dvec3(glm::row(_seen.clipFromScene, axis)));
    };
    MapOutline all(_sides.front().frame);
    for (const Blocker& blocker : _sides.front().blockers) all.merge(blocker.outline);
    const double most = fitMap(_sides.front().frame, all, all, 0.0, 0.0, 1.0).longer();
    const double covered = std::min(most, std::max({side(0), side(1), distance}));
    return covered / _request.settings.size / (side(0) / _seen.pixels.x);
}

/// What of a part of the scene is needed.
void LightShadowMaps::findFace(Face& face, const HalfSpaces& halfSpaces) const {
    face.clear();
    TexelDensity pixels(face.side->frame, _seen.clipFromScene, _seen.pixels);
    for (const Blocker& blocker : face.side->blockers)
        addNeeded(face, blocker, both(halfSpaces, blocker.halfSpaces), pixels);
    face.texel = pixels.side;
    face.needed.limitNearest(atLamp);
    findHeld(face);
}

/// Divides between two maps what one would hold too coarsely.
void LightShadowMaps::findLamp(Face& far, Face& near) {
    const HalfSpaces inView = viewPart(_seen.clipFromScene, {}, 0);
    const LightFrame& frame = far.side->frame;
    findFace(far, inView);
    near.clear();
    if (!(far.needed.split() > 0.0)) return;
    constexpr double corner = 1.8; // of a cube's face and what it is larger by: the way to it to its distance
    const HalfSpaces beyondClear = both(inView, {fartherThan(frame, clearance() / corner)});
    findFace(far, beyondClear);
    const double split = far.needed.split();
    if (!(split > 0.0)) return;
    findFace(near, both(beyondClear, {nearerThan(frame, split)}));
    findFace(far, both(inView, {fartherThan(frame, split)}));
}

/// What of what a blocker can darken is seen.
void LightShadowMaps::addNeeded(Face& face, const Blocker& blocker, HalfSpaces halfSpaces, TexelDensity& pixels) const {
    const LightFrame& frame = face.side->frame;
    const auto add = [&](auto& to) {
        for (const PlacedBox& receiver : _seen.receivers) to.addBox(receiver, halfSpaces);
    };
    MapOutline dark = blocker.outline, seen(frame);
    if (_request.isWide(frame)) {
        MapOutline all(frame);
        add(all);
        if (all.empty()) return;
        dark.grow(_request.softness(frame, blocker.outline, all.farthest));
    }
    if (frame.isParallel) halfSpaces = both(std::move(halfSpaces), dark.sides()); // a lamp's have sides of their own
    add(seen);
    seen.cut(dark);
    if (seen.empty()) return;
    add(pixels);
    const double nearest = blocker.outline.nearest;
    face.nearestBlocker = face.needed.empty() ? nearest : std::min(face.nearestBlocker, nearest);
    face.needed.merge(seen);
    face.reach.merge(dark);
}

/// Of edges that are wider than the filter: what is about each place, too, and how far away what blocks the light is.
void LightShadowMaps::findHeld(Face& face) const {
    const LightFrame& frame = face.side->frame;
    MapOutline& held = face.held;
    held = face.needed;
    if (face.needed.empty()) return;
    if (!_request.isWide(frame)) {
        // What is beyond all that blocks the light, a sky say, is compared as if it were there.
        if (frame.isParallel && _splits.empty())
            held.farthest = std::min(held.farthest, std::max(held.nearest, face.reach.farthest));
        return;
    }
    const double most = 1.5 * widestSpread / _texels * face.needed.length(); // a map so much larger has wider texels
    MapOutline blocking = face.reach;
    blocking.nearest = face.nearestBlocker;
    held.grow(std::min(_request.softness(frame, blocking, face.needed.farthest), most));
    held.cut(face.reach);
    blocking.farthest = face.needed.farthest;
    blocking.limitNearest(MapRequest::widestRatio);
    held.nearest = std::min(held.nearest, blocking.nearest);
}

/// From a lamp to the nearest caster: nothing that is nearer is dark.
double LightShadowMaps::clearance() {
    const MapCasters& casters = *_request.casters;
    const glm::dvec3 lamp(_request.light);
    if (!_clearOfStill) _clearOfStill = casters.still->clearanceOf(lamp);
    return std::min(*_clearOfStill, casters.clearanceOfMoving(lamp));
}

void LightShadowMaps::update(const ViewFrame& view, MapMeshes& meshes) {
    const MapCasters& casters = *_request.casters;
    const OwnCasters own(casters.own, SceneFrame(casters.layers.origin).eyeFromScene(view), view.seen);
    resize();
    const bool due = anyDue();
    if (!due && isOfCasters() && _picture->own.areSame(own)) return;
    for (Face& face : _faces) {
        if (face.needed.empty())
            face.fit = std::nullopt;
        else if (!holds(face))
            face.fit = fitOf(face);
    }
    const bool stillAgain = _picture && _picture->still.of == casters.still,
               movingAgain = _picture && _picture->moving.of == casters.moving;
    const osg::ref_ptr<MapPicture> picture = new MapPicture;
    picture->own = own;
    meshes.startPicture();
    picture->still = stillAgain && !due ? _picture->still : drawnOf(*casters.still, stillAgain, meshes);
    picture->moving = drawnOf(*casters.moving, movingAgain, meshes);
    picture->size = _texels;
    const glm::ivec2 size = addTiles(*picture);
    if (!_map || _map->size != size)
        _map = new DepthMap(size, _request.settings.blends ? osg::Texture::LINEAR : osg::Texture::NEAREST);
    _picture = picture;
}

/// On a side of the map that needs most.
double LightShadowMaps::texelsWanted() const {
    double wanted = 0.0;
    for (const Face& face : _faces) {
        if (face.needed.empty()) continue;
        if (_request.isWide(face.side->frame)) wanted = std::max(wanted, fewestSoft);
        const double size = (holds(face) ? *face.fit : fitOf(face)).longer();
        wanted = std::max(wanted, size / (_request.settings.widestTexel * face.texel));
    }
    return wanted;
}

int LightShadowMaps::mapsNeeded() const {
    const auto needed = [](const Face& face) { return !face.needed.empty(); };
    return static_cast<int>(std::count_if(_faces.begin(), _faces.end(), needed));
}

/// No fewer than rows.
int LightShadowMaps::columns() const { return mapsNeeded() > 6 ? 4 : mapsNeeded() > 4 ? 3 : 2; }

int LightShadowMaps::mostTexels() const { return largestTexture / std::clamp(mapsNeeded(), 1, columns()); }

/// Takes other texels than before if need be, fewer only where a map is to be drawn anyway: none holds what it must then.
void LightShadowMaps::resize() {
    constexpr int rounds = 8; // what soft edges reach depends on how wide texels are
    const int most = std::min(_request.settings.size, mostTexels());
    const bool begun = std::none_of(_faces.begin(), _faces.end(), [](const Face& face) { return bool(face.fit); });
    int before = _map && !(begun && isSettled()) ? _texels : 0;
    for (int round = 0; round < rounds; ++round) {
        const int texels = texelsFor(texelsWanted(), most, before);
        if (texels == before || (texels < before && !anyDue())) return;
        before = _texels = texels;
        for (Face& face : _faces) {
            face.fit = std::nullopt;
            findHeld(face);
        }
    }
}

bool LightShadowMaps::anyDue() const {
    return std::any_of(_faces.begin(), _faces.end(),
                       [this](const Face& face) { return !face.needed.empty() && !holds(face); });
}

/// True if the face's map is not to be drawn again.
bool LightShadowMaps::holds(const Face& face) const {
    if (!face.fit || !face.fit->covers(face.held, (keptClear - 1.0) / _texels)) return false;
    return face.fit->area() <= mostWaste * fitOf(face).area();
}

/// What moves will be beside what casters can darken now.
MapFit LightShadowMaps::fitOf(const Face& face) const {
    MapOutline most = face.reach;
    if (!isSettled() && !_request.casters->moving->casters->pieces.empty()) {
        most.merge(face.held);
        most.grow(reserve * face.held.length());
    }
    return fitMap(face.side->frame, face.held, most, reserve, keptClear / _texels, glm::length(reachOf(face)) / 64.0);
}

/// Half sides of a box about the origin that holds what its map draws: no further than the map and the widest drawable.
glm::dvec3 LightShadowMaps::reachOf(const Face& face) const {
    glm::dvec3 result(0.0);
    for (const glm::dvec4& point : face.held.body()) result = glm::max(result, glm::abs(glm::dvec3(point) / point.w));
    const CasterLayers& layers = _request.casters->layers;
    return glm::min(layers.reach, result + (_flats ? layers.widest : layers.widestBody));
}

/// Where nothing changes any more, as in a light's first picture: all faces, for where only those turned to the light are drawn,
/// single texels at rims differ.
MapPicture::Layer LightShadowMaps::drawnOf(const MapLayer& layer, bool again, MapMeshes& meshes) const {
    MapPicture::Layer drawn{&layer};
    for (std::size_t i = 0; i < layer.meshes.size(); ++i) {
        const PlacedMesh& placed = layer.casters->meshes[i];
        const MapBox box = boxOf(placed, layer.casters->origin);
        for (const MapCutout& cutout : layer.meshes[i]->cutouts)
            if (_flats || !cutout.flat) drawn.cutouts.push_back(cutout);
        if (placed.ownDrawn || (placed.isBody && isFlat(box) && !_flats)) continue;
        const bool moving = &layer == _request.casters->moving;
        const auto faces = meshes.facesOf(*layer.meshes[i], _flats, again && !isSettled(), moving);
        if (!faces) continue;
        CullableFaces::Outside outside{false, false};
        if (!isSettled()) outside = faces->outside(glm::inverse(placed.sceneFromMesh) * _request.light);
        drawn.meshes.push_back({faces, placed.sceneFromMesh, box, outside});
    }
    return drawn;
}

/// @return texels of them all.
glm::ivec2 LightShadowMaps::addTiles(MapPicture& picture) {
    std::vector<std::pair<const Face*, glm::ivec2>> tiles;
    for (const Face& face : _faces) {
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
    MapPicture::Tile tile{
        corner, face.fit->mapFromScene, mapErrors(frame, *face.fit, reachOf(face), _texels),
        mapSpread(frame, *face.fit, _request.lightRadius(frame), _request.settings.blurRadius, _texels)};
    const double size = glm::length(glm::dvec3(_request.light)) + glm::length(reachOf(face));
    if (!frame.isParallel) tile.nearest = std::max(std::min(clearance(), size) / aside, least * size);
    tile.movers = moversIn(tile);
    return tile;
}

/// Texels of a tile that what moves may cover.
PixelRect LightShadowMaps::moversIn(const MapPicture::Tile& tile) const {
    const glm::dmat4 clipFromScene = tile.clipFromScene();
    glm::dvec2 low(1.0), high(-1.0);
    const auto add = [&](const MapBox& box) {
        const auto corners = boxCorners(box.low, box.high, clipFromScene);
        const auto bounds = screenBounds({corners.begin(), corners.end()});
        if (!bounds) return;
        low = glm::min(low, bounds->low);
        high = glm::max(high, bounds->high);
    };
    const MapLayer& moving = *_request.casters->moving;
    std::for_each(moving.bodies.begin(), moving.bodies.end(), add);
    if (_flats) std::for_each(moving.flats.begin(), moving.flats.end(), add);
    for (const OwnCaster& caster : _request.casters->own) add(caster.box);
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
    const auto usable = localLight(light.inGroup, SceneFrame(boxes.layers.origin));
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
    for (const Face& face : _faces) {
        if (face.needed.empty()) continue;
        const MapFit fit = fitOf(face);
        const LightFrame& frame = face.side->frame;
        result.each.push_back({fit.mapFromScene, frame.isParallel ? viewPart(_seen.clipFromScene, _splits, face.part)
                                                                  : frame.halfSpaces});
        result.pixel = std::min(result.pixel, face.texel);
        result.texels = std::max(result.texels, fit.longer() / face.texel);
    }
    return result;
}

} // namespace gnomon
