// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/MapFaces.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace gnomon {
namespace {

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
glm::dvec4 beyond(const AlignedBox& flat, const glm::dvec4& light, const glm::dvec3& reach) {
    const glm::dvec3 size = flat.high - flat.low;
    const int axis = size.x == 0.0 ? 0 : size.y == 0.0 ? 1 : 2;
    const double level = flat.low[axis], side = light[axis] - light.w * level > 0.0 ? 1.0 : -1.0;
    const double rounding =
        1e-7 * std::abs(level) + 1e-10 * glm::length(reach); // floats', and what eye space makes of a place
    glm::dvec4 result(0.0, 0.0, 0.0, side * level - rounding);
    result[axis] = -side;
    return result;
}

/// True of what the light sees edge-on, and of triangles of no area: hard edges have nothing between them.
bool isThin(const LightFrame& frame, const MapOutline& outline) {
    const glm::dvec2 size = fitMap(frame, outline, outline, {0.0, 0.0, 1.0}).size;
    return std::min(size.x, size.y) <= 2e-6 * std::max(size.x, size.y); // fitMap() makes no side less than half of that
}

} // namespace

/// True if what is flat, a ground for one, may stand between the light and a place that is seen: not if all of those are on the
/// light's side of it, or in it. Of all that is level, each way, the one nearest to the light says so for all.
bool anyIsBetween(const MapCasters& casters, const glm::dvec4& light, const std::vector<PlacedBox>& receivers) {
    std::map<std::array<double, 3>, glm::dvec4> halves; // by the way; six at most
    for (const MapLayer* layer : {casters.still.get(), casters.moving.get()})
        for (const MapPiece& flat : layer->flats) {
            const glm::dvec4 half = beyond(flat, light, casters.layers.reach);
            glm::dvec4& known = halves.try_emplace(std::array{half.x, half.y, half.z}, half).first->second;
            known.w = std::max(known.w, half.w);
        }
    return std::any_of(receivers.begin(), receivers.end(), [&](const PlacedBox& receiver) {
        return std::any_of(halves.begin(), halves.end(),
                           [&](const auto& half) { return !cornersWithin(receiver, {half.second}).empty(); });
    });
}

bool anyTouchesBehind(const MapCasters& casters, const glm::dvec4& light) {
    constexpr double close = 1e-3; // of the other's height over it
    const auto touches = [&](const AlignedBox& flat, const AlignedBox& unflat) {
        const glm::dvec4 half = beyond(flat, light, casters.layers.reach);
        for (int axis = 0; axis < 3; ++axis)
            if (half[axis] == 0.0 && (unflat.low[axis] > flat.high[axis] || unflat.high[axis] < flat.low[axis]))
                return false;
        const double low = glm::dot(half, glm::dvec4(unflat.low, 1.0)),
                     high = glm::dot(half, glm::dvec4(unflat.high, 1.0));
        return std::abs(std::min(low, high)) <= close * std::abs(high - low) && std::max(low, high) > 0.0;
    };
    const MapLayer* layers[] = {casters.still.get(), casters.moving.get()};
    for (const MapLayer* of : layers)
        for (const MapPiece& flat : of->flats)
            for (const MapLayer* all : layers)
                if (std::any_of(all->unflats.begin(), all->unflats.end(),
                                [&](const MapPiece& unflat) { return touches(flat, unflat); }))
                    return true;
    return false;
}

void MapFaces::begin(const MapRequest& request, bool flats) {
    _request = request;
    _flats = flats;
    _clearOfStill = std::nullopt;
    each.clear();
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
        for (std::size_t part = 0; part < parts; ++part) each.emplace_back(side, part);
    }
}

void MapFaces::takeCasters(const MapCasters& casters) {
    if (_request.casters == &casters) return;
    const bool sameStill = _request.casters->still == casters.still;
    if (!sameStill) _clearOfStill = std::nullopt;
    _request.casters = &casters;
    for (Side& side : _sides) {
        if (!sameStill) side.still = outlinesOf(*casters.still, side.frame);
        findBlockers(side);
    }
}

bool MapFaces::haveSameSides(const CasterLayers& casters) const {
    const auto frames = framesOf(_request.light, _request.cone, casters, _request.settings.size);
    return std::equal(_sides.begin(), _sides.end(), frames.begin(), frames.end(),
                      [](const Side& side, const LightFrame& frame) { return areSame(side.frame, frame); });
}

MapFaces::Outlines MapFaces::outlinesOf(const MapLayer& layer, const LightFrame& frame) const {
    Outlines outlines{MapOutline(frame), {}};
    for (const MapPiece& unflat : layer.unflats) outlines.unflats.addBox({unflat.low, unflat.high});
    if (!_flats) return outlines;
    for (const MapPiece& flat : layer.flats) {
        outlines.flats.emplace_back(frame);
        outlines.flats.back().addBox({flat.low, flat.high});
    }
    return outlines;
}

/// Skips what is empty, and what is flat and behind all that is not: it darkens nothing that they may not, but widens edges where
/// it is far from where they are.
void MapFaces::findBlockers(Side& side) const {
    const bool wide = _request.isWide(side.frame);
    side.blockers.clear();
    const auto add = [&](const MapOutline& outline, const HalfSpaces& halfSpaces) {
        if (!outline.empty()) side.blockers.push_back({outline, halfSpaces});
    };
    const MapCasters& casters = *_request.casters;
    const Outlines moving = outlinesOf(*casters.moving, side.frame);
    MapOutline unflats = side.still.unflats;
    unflats.merge(moving.unflats);
    for (const SelfDrawnCaster& caster : casters.selfDrawn) unflats.addBox({caster.box.low, caster.box.high});
    if (wide || !areThin(side.frame)) add(unflats, {});
    const auto addFlats = [&](const Outlines& outlines, const MapLayer& layer) {
        for (std::size_t i = 0; i < outlines.flats.size(); ++i)
            if (wide || !(unflats.isBefore(outlines.flats[i]) || isThin(side.frame, outlines.flats[i])))
                add(outlines.flats[i], {beyond(layer.flats[i], _request.light, casters.layers.reach)});
    };
    addFlats(side.still, *casters.still);
    addFlats(moving, *casters.moving);
}

/// True of each that is not flat: all of them together may be thin where they are not, for one is very far away.
bool MapFaces::areThin(const LightFrame& frame) const {
    const auto isBoxThin = [&frame](const AlignedBox& box) {
        MapOutline outline(frame);
        outline.addBox({box.low, box.high});
        return outline.empty() || isThin(frame, outline);
    };
    const MapCasters& casters = *_request.casters;
    const auto &still = casters.still->unflats, &moving = casters.moving->unflats;
    return std::all_of(still.begin(), still.end(), isBoxThin) && std::all_of(moving.begin(), moving.end(), isBoxThin) &&
           std::all_of(casters.selfDrawn.begin(), casters.selfDrawn.end(),
                       [&](const auto& caster) { return isBoxThin(caster.box); });
}

void MapFaces::find(int texels) {
    findSplits();
    if (_sides.front().frame.isParallel)
        for (Face& face : each)
            face.part <= _splits.size() ? findFace(face, viewPart(_seen.clipFromScene, _splits, face.part), texels)
                                        : face.clear();
    else
        for (std::size_t i = 0; i < each.size(); i += 2) findLamp(each[i], each[i + 1], texels);
}

void MapFaces::findSplits() {
    const Side& side = _sides.front();
    if (!(each.size() > 1 && side.frame.isParallel)) return;
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
double MapFaces::pixelsATexel(double distance) const {
    const auto side = [&](int axis) {
        return 2.0 * distance / glm::length(glm::dvec3(glm::row(_seen.clipFromScene, axis)));
    };
    MapOutline all(_sides.front().frame);
    for (const Blocker& blocker : _sides.front().blockers) all.merge(blocker.outline);
    const double most = fitMap(_sides.front().frame, all, all, {0.0, 0.0, 1.0}).longer();
    const double covered = std::min(most, std::max({side(0), side(1), distance}));
    return covered / _request.settings.size / (side(0) / _seen.pixels.x);
}

/// What of a part of the scene is needed.
void MapFaces::findFace(Face& face, const HalfSpaces& halfSpaces, int texels) const {
    face.clear();
    TexelDensity pixels(face.side->frame, _seen.clipFromScene, _seen.pixels);
    for (const Blocker& blocker : face.side->blockers)
        addNeeded(face, blocker, both(halfSpaces, blocker.halfSpaces), pixels);
    face.texel = pixels.side;
    face.needed.limitNearest(atLamp);
    findHeld(face, texels);
}

/// Divides between two maps what one would hold too coarsely.
void MapFaces::findLamp(Face& far, Face& near, int texels) {
    const HalfSpaces inView = viewPart(_seen.clipFromScene, {}, 0);
    const LightFrame& frame = far.side->frame;
    findFace(far, inView, texels);
    near.clear();
    if (!(far.needed.split() > 0.0)) return;
    constexpr double corner = 1.8; // of a cube's face and what it is larger by: the way to it to its distance
    const HalfSpaces beyondClear = both(inView, {fartherThan(frame, clearance() / corner)});
    findFace(far, beyondClear, texels);
    const double split = far.needed.split();
    if (!(split > 0.0)) return;
    findFace(near, both(beyondClear, {nearerThan(frame, split)}), texels);
    findFace(far, both(inView, {fartherThan(frame, split)}), texels);
}

/// What of what a blocker can darken is seen.
void MapFaces::addNeeded(Face& face, const Blocker& blocker, HalfSpaces halfSpaces, TexelDensity& pixels) const {
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
void MapFaces::findHeld(Face& face, int texels) const {
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
    const double most = 1.5 * widestSpread / texels * face.needed.length(); // a map so much larger has wider texels
    MapOutline blocking = face.reach;
    blocking.nearest = face.nearestBlocker;
    held.grow(std::min(_request.softness(frame, blocking, face.needed.farthest), most));
    held.cut(face.reach);
    blocking.farthest = face.needed.farthest;
    blocking.limitNearest(MapRequest::widestRatio);
    held.nearest = std::min(held.nearest, blocking.nearest);
}

double MapFaces::clearance() {
    const MapCasters& casters = *_request.casters;
    const glm::dvec3 lamp(_request.light);
    if (!_clearOfStill) _clearOfStill = casters.still->clearanceOf(lamp);
    return std::min(*_clearOfStill, casters.clearanceOfMoving(lamp));
}

glm::dvec3 MapFaces::reachOf(const Face& face) const {
    glm::dvec3 result(0.0);
    for (const glm::dvec4& point : face.held.corners3D())
        result = glm::max(result, glm::abs(glm::dvec3(point) / point.w));
    const CasterLayers& layers = _request.casters->layers;
    return glm::min(layers.reach, result + (_flats ? layers.widest : layers.widestUnflat));
}

HalfSpaces MapFaces::placesOf(const Face& face) const {
    const LightFrame& frame = face.side->frame;
    return frame.isParallel ? viewPart(_seen.clipFromScene, _splits, face.part) : frame.halfSpaces;
}

} // namespace gnomon
