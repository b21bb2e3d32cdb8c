// SPDX-License-Identifier: MIT
#include <gnomon/CascadeSplits.h>
#include <gnomon/Convert.h>
#include <gnomon/LightFrames.h>
#include <gnomon/LightMap.h>
#include <gnomon/ScreenBounds.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double reserve = 1.0 / 16.0;  // of a map's sides
constexpr double mostWaste = 2.0;       // area of a map to the smallest that would do: edges may be a half coarser
constexpr double fewestSoft = 256.0; // texels of soft edges: with fewer, what 128 of them reach would be most of a map
constexpr double border = 3.0;       // texels: what a comparison reaches over, and one against rounding
constexpr double widestSpread = 128.0; // texels: as map_filter.frag has it
constexpr int largestTexture = 16384;  // texels on a side: what OpenGL has in most places
constexpr double sameLight = 1e-7;     // of the distance: what OSG's matrices and floats make of a light at rest

bool isSame(const glm::dvec4& a, const glm::dvec4& b, double size) {
    return a.w == b.w && glm::distance(a, b) <= sameLight * (glm::length(glm::dvec3(b)) + size);
}

bool isSame(const std::optional<SpotCone>& a, const std::optional<SpotCone>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->cutoff == b->cutoff && glm::distance(a->axis, b->axis) <= sameLight;
}

} // namespace

std::vector<MapReceiver> receiversOf(const ViewFrame& view, const glm::dmat4& eyeFromScene) {
    const glm::dmat4 sceneFromEye = glm::inverse(eyeFromScene);
    std::vector<MapReceiver> result;
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid()) continue;
        MapReceiver receiver{toGlm(osg::Vec3d(box._min)), toGlm(osg::Vec3d(box._max)),
                             sceneFromEye * toGlm(*leaf->_modelview), 0.0};
        receiver.size = glm::length(glm::dvec3(receiver.sceneFromBox * glm::dvec4(receiver.high - receiver.low, 0.0)));
        result.push_back(receiver);
    }
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.size > b.size; });
    return result;
}

glm::dvec4 beyond(const MapLayer::Box& flat, const glm::dvec4& light, const glm::dvec3& reach) {
    const glm::dvec3 size = flat.high - flat.low;
    const int axis = size.x == 0.0 ? 0 : size.y == 0.0 ? 1 : 2;
    const double level = flat.low[axis], side = light[axis] - light.w * level > 0.0 ? 1.0 : -1.0;
    glm::dvec4 result(0.0, 0.0, 0.0, side * level - 1e-6 * glm::length(reach)); // what eye space makes of a place in it
    result[axis] = -side;
    return result;
}

void LightMap::setCause(const glm::dvec4& light, const std::optional<SpotCone>& cone, const MapCasters& casters,
                        bool flats, const MapWish& wish) {
    const bool sameMaps = _wish == wish;
    if (_casters && _casters->origin == casters.origin && _flats == flats && sameMaps && isSame(cone, _cone) &&
        isSame(light, _light, glm::length(casters.reach)) &&
        (_casters == &casters || areSame(_frames, framesOf(_light, _cone, casters, _wish.size))))
        return takeCasters(casters);
    if (!sameMaps) _map = nullptr;
    _light = light;
    _cone = cone;
    _casters = &casters;
    _flats = flats;
    _wish = wish;
    _picture = nullptr;
    _faces.clear();
    _splits.clear();
    _cascades = wish.cascades;
    if (!_map) _texels = wish.size;
    _frames = framesOf(_light, _cone, casters, _wish.size);
    for (const LightFrame& frame : _frames) addFaces(frame);
}

/// As seen from the same light.
void LightMap::takeCasters(const MapCasters& casters) {
    if (_casters == &casters) return;
    const bool sameStill = _casters->still == casters.still;
    _casters = &casters;
    _picture = nullptr;
    const MapFace* before = nullptr; // of the same frame
    for (MapFace& face : _faces) {
        if (face.part > 0) {
            face.still = before->still;
            face.blockers = before->blockers;
        } else {
            if (!sameStill) face.still = outlinesOf(*_casters->still, face.frame);
            face.blockers = blockersOf(face);
        }
        before = &face;
    }
}

void LightMap::addFaces(const LightFrame& frame) {
    MapFace face(frame);
    face.still = outlinesOf(*_casters->still, frame);
    face.blockers = blockersOf(face);
    const int most = 2 * _wish.size <= largestTexture ? mostCascades : 1;
    const std::size_t parts = frame.sun ? std::size_t(_wish.cascades ? _wish.cascades : most) : 1;
    for (; face.part < parts; ++face.part) _faces.push_back(face);
}

/// True of what the light sees edge-on, and of triangles of no area: hard edges have nothing between them.
bool isThin(const LightFrame& frame, const MapOutline& outline) {
    const glm::dvec2 size = fitMap(frame, outline, outline, 0.0, 0.0, 1.0).size;
    return std::min(size.x, size.y) <= 2e-6 * std::max(size.x, size.y); // fitMap() makes no side less than half of that
}

LayerOutlines LightMap::outlinesOf(const MapLayer& layer, const LightFrame& frame) const {
    LayerOutlines outlines{MapOutline(frame), {}};
    for (const MapLayer::Box& box : layer.bodyBoxes) outlines.bodies.addBox(box.low, box.high, glm::dmat4(1.0));
    if (!_flats) return outlines;
    for (const MapLayer::Box& box : layer.flatBoxes) {
        outlines.flats.emplace_back(frame);
        outlines.flats.back().addBox(box.low, box.high, glm::dmat4(1.0));
    }
    return outlines;
}

/// In the face's frame; of those that are empty none, and none of what is flat and behind the bodies: it darkens nothing that
/// they may not, but widens edges where it is far from where they are.
std::vector<MapBlocker> LightMap::blockersOf(const MapFace& face) const {
    std::vector<MapBlocker> blockers;
    const auto add = [&](const MapOutline& outline, const std::vector<glm::dvec4>& halfSpaces) {
        if (!outline.empty() && (isWide(face.frame) || !isThin(face.frame, outline)))
            blockers.push_back({outline, halfSpaces});
    };
    const auto addFlats = [&](const LayerOutlines& outlines, const MapLayer& layer, const MapOutline& bodies) {
        for (std::size_t i = 0; i < outlines.flats.size(); ++i)
            if (isWide(face.frame) || !bodies.isBefore(outlines.flats[i]))
                add(outlines.flats[i], {beyond(layer.flatBoxes[i], _light, _casters->reach)});
    };
    const LayerOutlines moving = outlinesOf(*_casters->moving, face.frame);
    MapOutline bodies = face.still.bodies;
    bodies.merge(moving.bodies);
    add(bodies, {});
    addFlats(face.still, *_casters->still, bodies);
    addFlats(moving, *_casters->moving, bodies);
    return blockers;
}

/// On a side of a texel, were there one map, at a distance along the line of sight, of a view that is `width` pixels wide.
double LightMap::pixelsATexel(double distance, const glm::dmat4& clipFromScene, double width) const {
    const auto side = [&](int axis) { return 2.0 * distance / glm::length(glm::dvec3(glm::row(clipFromScene, axis))); };
    const MapFace& face = _faces.front();
    MapOutline all(face.frame);
    for (const MapBlocker& blocker : face.blockers) all.merge(blocker.outline);
    const glm::dvec2 most = fitMap(face.frame, all, all, 0.0, 0.0, 1.0).size;
    const double covered = std::min(std::max(most.x, most.y), std::max(side(0), side(1)));
    return covered / _wish.size / (side(0) / width);
}

void LightMap::findSplits(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene, double width) {
    if (!(_faces.size() > 1 && _faces.front().frame.sun)) return;
    SeenRange seen(clipFromScene);
    for (const MapBlocker& blocker : _faces.front().blockers) {
        std::vector<glm::dvec4> halfSpaces = viewPart(clipFromScene, {}, 0);
        for (const auto& more : {blocker.halfSpaces, blocker.outline.sides()})
            halfSpaces.insert(halfSpaces.end(), more.begin(), more.end());
        for (const MapReceiver& receiver : receivers)
            seen.addBox(receiver.low, receiver.high, receiver.sceneFromBox, halfSpaces);
    }
    if (!_wish.cascades && !seen.empty())
        _cascades = cascadesFor(seen, pixelsATexel(seen.farthest, clipFromScene, width), _cascades);
    _splits = cascadeSplits(seen, std::max(_cascades, 1));
}

std::vector<glm::dvec4> LightMap::find(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene,
                                       const glm::dvec2& pixels) {
    findSplits(receivers, clipFromScene, pixels.x);
    std::vector<glm::dvec4> points;
    for (MapFace& face : _faces) {
        face.reach = face.needed = face.held = MapOutline(face.frame);
        if (face.part > _splits.size()) continue;
        findNeeded(face, receivers, viewPart(clipFromScene, _splits, face.part),
                   SeenPixels(face.frame, clipFromScene, pixels));
        for (const glm::dvec4& point : face.needed.body()) points.push_back(clipFromScene * point);
    }
    return points;
}

void LightMap::findNeeded(MapFace& face, const std::vector<MapReceiver>& receivers, const std::vector<glm::dvec4>& part,
                          SeenPixels pixels) const {
    for (const MapBlocker& blocker : face.blockers) {
        std::vector<glm::dvec4> halfSpaces = part;
        halfSpaces.insert(halfSpaces.end(), blocker.halfSpaces.begin(), blocker.halfSpaces.end());
        addNeeded(face, blocker, receivers, std::move(halfSpaces), pixels);
    }
    face.texel = pixels.side;
    face.needed.limitNearest();
    findHeld(face);
}

/// Of edges that are wider than the filter: what is about each place, too, and how far away what blocks the light is.
void LightMap::findHeld(MapFace& face) const {
    face.held = face.needed;
    if (!isWide(face.frame) || face.needed.empty()) return;
    const double most = 1.5 * widestSpread / _texels * face.needed.length(); // a map so much larger has wider texels
    MapOutline blockers = face.reach;
    blockers.nearest = face.nearestBlocker;
    face.held.grow(std::min(softness(face.frame, blockers, face.needed.farthest), most));
    face.held.cut(face.reach);
    face.held.nearest = std::min(face.held.nearest, face.nearestBlocker);
    face.held.limitNearest();
}

/// What of what one of them can darken is seen.
void LightMap::addNeeded(MapFace& face, const MapBlocker& blocker, const std::vector<MapReceiver>& receivers,
                         std::vector<glm::dvec4> halfSpaces, SeenPixels& pixels) const {
    const auto add = [&](MapOutline& to) {
        for (const MapReceiver& receiver : receivers)
            to.addBox(receiver.low, receiver.high, receiver.sceneFromBox, halfSpaces);
    };
    MapOutline reach = blocker.outline, needed(face.frame);
    if (isWide(face.frame)) {
        MapOutline seen(face.frame);
        add(seen);
        if (seen.empty()) return;
        reach.grow(softness(face.frame, blocker.outline, seen.farthest));
    }
    if (face.frame.sun) // a lamp's have sides of their own
        for (const glm::dvec4& side : reach.sides()) halfSpaces.push_back(side);
    add(needed);
    needed.cut(reach);
    if (needed.empty()) return;
    for (const MapReceiver& receiver : receivers)
        pixels.addBox(receiver.low, receiver.high, receiver.sceneFromBox, halfSpaces);
    face.nearestBlocker =
        face.needed.empty() ? blocker.outline.nearest : std::min(face.nearestBlocker, blocker.outline.nearest);
    face.needed.merge(needed);
    face.reach.merge(reach);
}

/// See softReach().
double LightMap::lightRadius(const LightFrame& frame) const {
    if (!_wish.soft) return 0.0;
    if (!frame.sun) return _wish.soft->lamp;
    return _light.w == 0.0 ? _wish.soft->sun : _wish.soft->lamp / glm::length(glm::dvec3(_light));
}

/// True if edges are wider than the filter makes them.
bool LightMap::isWide(const LightFrame& frame) const {
    return lightRadius(frame) > 0.0 || (_wish.soft && _wish.soft->radius > 0.0);
}

/// How far edges of what blocks the light are spread where it is as far as that from the light.
double LightMap::softness(const LightFrame& frame, MapOutline blocker, double farthest) const {
    blocker.limitNearest();
    return softReach(frame, blocker.nearest, farthest, lightRadius(frame), _wish.soft->radius);
}

/// On a side of the map that needs most.
double LightMap::texelsWanted() const {
    double wanted = 0.0;
    for (const MapFace& face : _faces) {
        if (face.needed.empty()) continue;
        if (isWide(face.frame)) wanted = std::max(wanted, fewestSoft);
        const glm::dvec2 size = holds(face) ? face.fit->size : fitOf(face).size;
        wanted = std::max(wanted, std::max(size.x, size.y) / (_wish.pixels * face.texel));
    }
    return wanted;
}

/// On a side of a map: all that are beside one another are one texture.
int LightMap::mostTexels() const {
    const auto needed = [](const MapFace& face) { return !face.needed.empty(); };
    const auto maps = static_cast<int>(std::count_if(_faces.begin(), _faces.end(), needed));
    return std::min(_wish.size, largestTexture / std::clamp(maps, 1, columns()));
}

/// Takes other texels than before if need be, fewer only where a map is to be drawn anyway: none holds what it must then.
void LightMap::resize() {
    constexpr int rounds = 8; // what soft edges reach depends on how wide texels are
    int before = _map ? _texels : 0;
    for (int round = 0; round < rounds; ++round) {
        const int texels = texelsFor(texelsWanted(), mostTexels(), before);
        if (texels == before || (texels < before && !anyDue())) return;
        before = _texels = texels;
        for (MapFace& face : _faces) {
            face.fit = std::nullopt;
            findHeld(face);
        }
    }
}

bool LightMap::anyDue() const {
    return std::any_of(_faces.begin(), _faces.end(),
                       [this](const MapFace& face) { return !face.needed.empty() && !holds(face); });
}

/// True if the face's map is not to be drawn again.
bool LightMap::holds(const MapFace& face) const {
    if (!face.fit || !face.fit->covers(face.held, (border - 1.0) / _texels)) return false;
    return face.fit->area() <= mostWaste * fitOf(face).area();
}

/// What moves will be beside what casters can darken now.
MapFit LightMap::fitOf(const MapFace& face) const {
    MapOutline most = face.reach;
    if (!_casters->moving->pieces.empty()) {
        most.merge(face.held);
        most.grow(reserve * face.held.length());
    }
    return fitMap(face.frame, face.held, most, reserve, border / _texels, glm::length(_casters->reach) / 64.0);
}

/// Without its tiles. @param due  some are to be drawn from the first.
osg::ref_ptr<MapPicture> LightMap::pictureOf(const MapResources& resources, bool due) {
    osg::ref_ptr<MapPicture> picture = new MapPicture;
    const bool stillAgain = _drawnStill == _casters->still, movingAgain = _drawnMoving == _casters->moving;
    if (!stillAgain || due) _still = drawnOf(*_casters->still, stillAgain);
    picture->still = _still;
    picture->moving = drawnOf(*_casters->moving, movingAgain);
    _drawnStill = _casters->still;
    _drawnMoving = _casters->moving;
    picture->program = resources.casterProgram;
    picture->cutoutProgram = resources.cutoutProgram;
    picture->size = _texels;
    picture->slopeOffset = 0.5; // with as much of the slope that is seen: see map.frag
    return picture;
}

MapPicture::Layer LightMap::drawnOf(const MapLayer& layer, bool again) const {
    MapPicture::Layer drawn{layer.faces(_flats, again), {}, {}};
    if (drawn.casters) drawn.outside = drawn.casters->outside(_light);
    for (const MapLayer::Cutout& cutout : layer.cutouts)
        if (_flats || !cutout.flat) drawn.cutouts.push_back(cutout);
    return drawn;
}

/// Texels of a tile that what moves may cover.
PixelRect LightMap::moversIn(const MapPicture::Tile& tile, const MapErrors& errors) const {
    const MapLayer& moving = *_casters->moving;
    glm::dvec2 low(1.0), high(-1.0);
    const auto add = [&](const MapLayer::Box& box) {
        const auto corners = boxCorners(box.low, box.high, tile.clipFromCaster);
        const auto bounds = screenBounds({corners.begin(), corners.end()});
        if (!bounds) return;
        low = glm::min(low, bounds->low);
        high = glm::max(high, bounds->high);
    };
    std::for_each(moving.bodyBoxes.begin(), moving.bodyBoxes.end(), add);
    if (_flats) std::for_each(moving.flatBoxes.begin(), moving.flatBoxes.end(), add);
    if (!(low.x <= high.x && low.y <= high.y)) return {};
    const double more = 1.0 + std::max(errors.nearest.texels, errors.farthest.texels), size = _texels;
    const auto texel = [size](const glm::dvec2& place) { return glm::ivec2(glm::clamp(place, 0.0, size)); };
    const glm::ivec2 first = texel(glm::floor((low + 1.0) / 2.0 * size - more)),
                     end = texel(glm::ceil((high + 1.0) / 2.0 * size + more));
    return {tile.corner.x + first.x, tile.corner.y + first.y, end.x - first.x, end.y - first.y};
}

MapLookUp LightMap::lookUpOf(const MapFace& face) const {
    const double radius = _wish.soft ? _wish.soft->radius : 0.0;
    return {face.fit->mapFromScene, mapErrors(face.frame, *face.fit, _casters->reach, _texels),
            mapSpread(face.frame, *face.fit, lightRadius(face.frame), radius, _texels)};
}

/// The finest map comes first, for pixels take the first that holds them.
void LightMap::update(const MapResources& resources) {
    resize();
    const bool due = anyDue();
    if (_picture && !due) return;
    const osg::ref_ptr<MapPicture> picture = pictureOf(resources, due);
    std::vector<std::pair<const MapFace*, glm::ivec2>> tiles;
    for (MapFace& face : _faces) {
        if (face.needed.empty())
            face.fit = std::nullopt;
        else if (!holds(face))
            face.fit = fitOf(face);
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
        picture->tiles.push_back({corner, clipFromMap * face->fit->mapFromScene, {}});
        picture->tiles.back().movers = moversIn(picture->tiles.back(), _lookUps.back().errors);
        end = glm::max(end, corner + picture->size);
    }
    if (!_map || _map->size != end) _map = new DepthMap(end, _wish.compare);
    _picture = picture;
}

MapQuad LightMap::quad(const glm::dmat4& clipFromScene) const {
    MapQuad quad;
    quad.map = _map;
    quad.picture = _picture;
    quad.lookUps = _lookUps;
    quad.clipFromScene = clipFromScene;
    quad.defines = _wish.defines;
    quad.cascades = _faces.front().frame.sun && _lookUps.size() > 1;
    quad.smooth = _wish.smooth;
    quad.soft = _wish.soft.has_value();
    quad.penumbra = lightRadius(_faces.front().frame) > 0.0;
    return quad;
}

void LightMap::resizeGLObjectBuffers(unsigned maxSize) {
    if (_map) _map->resizeGLObjectBuffers(maxSize);
    if (_casters) _casters->resizeGLObjectBuffers(maxSize);
}

void LightMap::release(osg::State* state) {
    if (_map) _map->release(state);
    if (_casters) _casters->releaseGLObjects(state);
}

} // namespace gnomon
