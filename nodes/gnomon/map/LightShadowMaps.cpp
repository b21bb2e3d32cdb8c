// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/LightShadowMaps.h>
#include <gnomon/mapfit/CascadeSplits.h>
#include <gnomon/mapfit/MapFit.h>
#include <gnomon/mapfit/SpotCone.h>
#include <gnomon/mapfit/TexelDensity.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

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

} // namespace

void LightShadowMaps::setCause(const MapRequest& cause) {
    _light = cause.light;
    _cone = cause.cone;
    const MapRequest& old = _cause;
    const bool sameMaps = old.settings == cause.settings;
    if (old.casters && old.casters->layers->origin == cause.casters->layers->origin && old.flats == cause.flats &&
        sameMaps && isSame(cause.cone, old.cone) && isSame(cause.light, old.light, cause.casters->layers->widest) &&
        (old.casters == cause.casters ||
         areSame(_frames, framesOf(old.light, old.cone, *cause.casters->layers, old.settings.size))))
        return takeCasters(*cause.casters);
    if (!sameMaps) _map = nullptr;
    _cause = cause;
    _picture = nullptr;
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
/// change, so that it waits longer and longer where a scene rests for a few frames each time.
void LightShadowMaps::settle(const glm::dmat4& clipFromScene, const glm::dvec2& pixels,
                             const std::vector<MapReceiver>& receivers) {
    constexpr int longest = 64;
    if (_seen.clipFromScene == clipFromScene && _seen.pixels == pixels && _seen.receivers == receivers &&
        _seen.light == _light && _seen.casters == _cause.casters) {
        ++_rest;
        if (_settled || _rest < _patience) return;
        _settled = _anew = _again = true;
        _cause.light = _light;
        _cause.cone = _cone;
        _texels = _cause.settings.size;
        begin();
        return;
    }
    if (_rest >= longest)
        _patience = fewestAtRest;
    else if (_again)
        _patience = std::min(2 * _patience, longest);
    _settled = !_seen.casters; // the first frame
    _again = false;
    _rest = 0;
    _seen = {clipFromScene, pixels, receivers, _light, _cause.casters};
}

/// As seen from the same light.
void LightShadowMaps::takeCasters(const MapCasters& casters) {
    if (_cause.casters == &casters) return;
    _clear = std::nullopt;
    const bool sameStill = _cause.casters->still == casters.still;
    if (!sameStill) _clearOfStill = std::nullopt;
    _cause.casters = &casters;
    _picture = nullptr;
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

/// On a side of a texel, were there one map, at a distance along the line of sight, of a view that is `width` pixels wide.
double LightShadowMaps::pixelsATexel(double distance, const glm::dmat4& clipFromScene, double width) const {
    const auto side = [&](int axis) { return 2.0 * distance / glm::length(glm::dvec3(glm::row(clipFromScene, axis))); };
    const MapSlice& face = _faces.front();
    MapOutline all(face.frame);
    for (const MapBlocker& blocker : face.blockers) all.merge(blocker.outline);
    const glm::dvec2 most = fitMap(face.frame, all, all, 0.0, 0.0, 1.0).size;
    const double covered = std::min(std::max(most.x, most.y), std::max({side(0), side(1), distance}));
    return covered / _cause.settings.size / (side(0) / width);
}

void LightShadowMaps::findSplits(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene,
                                 double width) {
    if (!(_faces.size() > 1 && _faces.front().frame.sun)) return;
    SeenRange seen(clipFromScene);
    for (const MapBlocker& blocker : _faces.front().blockers) {
        std::vector<glm::dvec4> halfSpaces = viewPart(clipFromScene, {}, 0);
        for (const auto& more : {blocker.halfSpaces, blocker.outline.sides()})
            halfSpaces.insert(halfSpaces.end(), more.begin(), more.end());
        for (const MapReceiver& receiver : receivers)
            seen.addBox(receiver.low, receiver.high, receiver.sceneFromBox, halfSpaces);
    }
    if (!_cause.settings.cascades && !seen.empty())
        _cascades = cascadesFor(seen, pixelsATexel(seen.farthest, clipFromScene, width), _cascades);
    _splits = cascadeSplits(seen, std::max(_cascades, 1));
}

std::vector<glm::dvec4> LightShadowMaps::find(const std::vector<MapReceiver>& receivers,
                                              const glm::dmat4& clipFromScene, const glm::dvec2& pixels) {
    settle(clipFromScene, pixels, receivers);
    findSplits(receivers, clipFromScene, pixels.x);
    if (_faces.front().frame.sun)
        for (MapSlice& face : _faces) {
            face.isAlone = _splits.empty();
            if (face.part <= _splits.size())
                face.find(_cause, receivers, viewPart(clipFromScene, _splits, face.part),
                          TexelDensity(face.frame, clipFromScene, pixels), _texels);
            else
                face.clear();
        }
    else
        for (std::size_t i = 0; i < _faces.size(); i += 2)
            findLamp(_faces[i], _faces[i + 1], receivers, clipFromScene, pixels);
    std::vector<glm::dvec4> points;
    for (const MapSlice& face : _faces)
        for (const glm::dvec4& point : face.needed.body()) points.push_back(clipFromScene * point);
    return points;
}

/// Divides between two maps what one would hold too coarsely.
void LightShadowMaps::findLamp(MapSlice& far, MapSlice& near, const std::vector<MapReceiver>& receivers,
                               const glm::dmat4& clipFromScene, const glm::dvec2& pixels) {
    const auto find = [&](MapSlice& face, const std::vector<glm::dvec4>& more) {
        std::vector<glm::dvec4> halfSpaces = viewPart(clipFromScene, {}, 0);
        halfSpaces.insert(halfSpaces.end(), more.begin(), more.end());
        face.find(_cause, receivers, halfSpaces, TexelDensity(face.frame, clipFromScene, pixels), _texels);
    };
    find(far, {});
    near.clear();
    if (!(far.needed.split() > 0.0)) return;
    constexpr double corner = 1.8; // of a cube's face and what it is larger by: the way to it to its distance
    const glm::dvec4 beyondClear = fartherThan(far.frame, clearance() / corner);
    find(far, {beyondClear});
    const double split = far.needed.split();
    if (!(split > 0.0)) return;
    find(near, {beyondClear, nearerThan(near.frame, split)});
    find(far, {fartherThan(far.frame, split)});
}

MapForecast LightShadowMaps::forecast(const glm::dmat4& clipFromScene) const {
    MapForecast result;
    result.maps = mapsNeeded();
    result.most = largestTexture / std::clamp(result.maps, 1, columns());
    for (const MapSlice& face : _faces) {
        if (face.needed.empty()) continue;
        const MapFit fit = fitOf(face);
        const glm::dvec2 size = fit.size;
        result.each.push_back(
            {fit.mapFromScene, face.frame.sun ? viewPart(clipFromScene, _splits, face.part) : face.frame.halfSpaces});
        result.pixel = std::min(result.pixel, face.texel);
        result.texels = std::max(result.texels, std::max(size.x, size.y) / face.texel);
    }
    return result;
}

/// On a side of the map that needs most.
double LightShadowMaps::texelsWanted() const {
    double wanted = 0.0;
    for (const MapSlice& face : _faces) {
        if (face.needed.empty()) continue;
        if (_cause.isWide(face.frame)) wanted = std::max(wanted, fewestSoft);
        const glm::dvec2 size = holds(face) ? face.fit->size : fitOf(face).size;
        wanted = std::max(wanted, std::max(size.x, size.y) / (_cause.settings.pixels * face.texel));
    }
    return wanted;
}

int LightShadowMaps::mapsNeeded() const {
    const auto needed = [](const MapSlice& face) { return !face.needed.empty(); };
    return static_cast<int>(std::count_if(_faces.begin(), _faces.end(), needed));
}

/// No fewer than rows.
int LightShadowMaps::columns() const { return mapsNeeded() > 6 ? 4 : mapsNeeded() > 4 ? 3 : 2; }

/// On a side of a map: all that are beside one another are one texture.
int LightShadowMaps::mostTexels() const {
    return std::min(_cause.settings.size, largestTexture / std::clamp(mapsNeeded(), 1, columns()));
}

/// Takes other texels than before if need be, fewer only where a map is to be drawn anyway: none holds what it must then.
void LightShadowMaps::resize() {
    constexpr int rounds = 8; // what soft edges reach depends on how wide texels are
    int before = _map && !_anew ? _texels : 0;
    _anew = false;
    for (int round = 0; round < rounds; ++round) {
        const int texels = texelsFor(texelsWanted(), mostTexels(), before);
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

void LightShadowMaps::resizeGLObjectBuffers(unsigned maxSize) {
    if (_map) _map->resizeGLObjectBuffers(maxSize);
    if (_cause.casters) _cause.casters->resizeGLObjectBuffers(maxSize);
}

void LightShadowMaps::release(osg::State* state) {
    if (_map) _map->release(state);
    if (_cause.casters) _cause.casters->releaseGLObjects(state);
}

} // namespace gnomon
