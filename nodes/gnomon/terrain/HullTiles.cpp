// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/terrain/HullTiles.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Below it a shadow holds the middle of one pixel at most and of most of them none: what is left of it is noise.
constexpr double leastPixels = 1.0;
constexpr double unseenPixels = 0.25; // half of what the edges of a picture are off by themselves
constexpr std::size_t aFrame = 32;    // of the tiles that may wait, one of so many is found in a frame, and 4 at least

/// How many pixels long what has a length of 1 can be where w is 1. A short way on the screen is (x - u w, y - v w) / w for
/// one of (x, y, w) in clip space from a place that is seen at (u, v); its length is convex in u and v, so that the most is
/// at a corner of the screen.
double mostPixelsOf(const glm::dmat4& clipFromScene, const osg::Vec2d& pixels) {
    const auto part = [&](int row) { return glm::dvec3(glm::row(clipFromScene, row)); };
    double most = 0.0;
    for (const double u : {-1.0, 1.0})
        for (const double v : {-1.0, 1.0}) {
            const glm::dvec3 x = 0.5 * pixels[0] * (part(0) - u * part(3)),
                             y = 0.5 * pixels[1] * (part(1) - v * part(3));
            const double half = 0.5 * (glm::dot(x, x) + glm::dot(y, y)), cross = glm::dot(x, y);
            const double apart = 0.5 * (glm::dot(x, x) - glm::dot(y, y));
            most = std::max(most, std::sqrt(half + std::hypot(apart, cross))); // the larger singular value of (x, y)
        }
    return most;
}

/// False if all points are beyond one side of the view, or behind the eye: quick, for it is asked of all that is not seen.
bool mayBeInView(const std::array<glm::dvec4, 16>& clipPoints) {
    for (const auto& side : {glm::dvec4(1, 0, 0, 1), glm::dvec4(-1, 0, 0, 1), glm::dvec4(0, 1, 0, 1),
                             glm::dvec4(0, -1, 0, 1), glm::dvec4(0, 0, 0, 1)})
        if (std::all_of(clipPoints.begin(), clipPoints.end(),
                        [&](const glm::dvec4& point) { return glm::dot(side, point) < 0.0; }))
            return false;
    return true;
}

bool isSun(const glm::dvec4& light) { return light.w == 0.0 && light.z > 0.0; }

/// In radians; infinite where one of them is no sun.
double turnBetween(const glm::dvec4& a, const glm::dvec4& b) {
    if (!isSun(a) || !isSun(b)) return infinite;
    const glm::dvec3 from(a), to(b);
    return std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
}

/// Whether the steepest of a ground is steep enough to be turned away from a light, and for a lamp also far enough from
/// it. It may face the light: only its slope is known. What lies so far from a lamp is beyond one side of a square.
bool mayShadowItself(const HullGround& ground, const glm::dvec4& light) {
    const double steepest = ground.all.steepest;
    if (light.w == 0.0) return steepest * glm::length(glm::dvec2(light)) >= light.z;
    const glm::dvec3 lamp = glm::dvec3(light) / light.w;
    const double half = (lamp.z - ground.all.high) / steepest * std::sqrt(0.5);
    const auto hasGround = [&](double left, double front, double right, double back) {
        return ground.ground.range({left, front}, {right, back}).has_value();
    };
    return hasGround(-infinite, -infinite, lamp.x - half, infinite) ||
           hasGround(lamp.x + half, -infinite, infinite, infinite) ||
           hasGround(-infinite, -infinite, infinite, lamp.y - half) ||
           hasGround(-infinite, lamp.y + half, infinite, infinite);
}

std::string sentenceOf(HullOutcome outcome) {
    switch (outcome) {
    case HullOutcome::boxed:
        return "its shadow is that of its bounding box, whose outline differs from the caster's in this light or on "
               "this ground. Use hull.";
    case HullOutcome::lightInside:
        return "all the ground is dark, because the light is inside the caster. Move the light out of it.";
    case HullOutcome::lightBelow:
        return "no shadow, because the light is below the horizon or in the ground. Raise the light.";
    case HullOutcome::noGround:
        return "no shadow, because it meets no ground. Extend the terrain, or raise the light.";
    case HullOutcome::cast:
    case HullOutcome::unseen:
        break;
    }
    return {};
}

} // namespace

TileView::TileView(const ViewFrame& view, const glm::dvec3& origin)
    : _skipsUntouched(view.options.skipsUntouched),
      _clipFromScene(SceneFrame(origin).clipFromScene(view)),
      _mostPixels(mostPixelsOf(_clipFromScene, view.pixels)) {}

TileView::Shown TileView::shown(const HullSolids& solids) const {
    if (solids.corners.empty()) return {};
    const auto corners = boxCorners(solids.low, solids.high, _clipFromScene);
    double nearest = infinite;
    for (const glm::dvec4& corner : corners) nearest = std::min(nearest, corner.w);
    thread_local std::vector<glm::dvec4> points; // memory that is used again
    points.assign(corners.begin(), corners.end());
    const auto bounds = screenBounds(points);
    const bool isBeforeEye = nearest > 0.0;
    const double pixels = isBeforeEye ? _mostPixels / nearest : infinite;
    if (!_skipsUntouched) return {bounds.value_or(ScreenRect{{1.0, 1.0}, {-1.0, -1.0}}), infinite, isBeforeEye};
    const bool isTooSmall = solids.widest * pixels < leastPixels;
    return {isTooSmall ? std::nullopt : bounds, pixels, isBeforeEye};
}

bool TileView::maySeeShadowsOf(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& light,
                               double lowest) const {
    if (!_skipsUntouched || !isSun(light)) return true;
    const double fall = std::max(0.0, high.z - lowest);
    const glm::dvec3 way = -glm::dvec3(light) / light.z * fall; // of the highest, to the lowest ground
    std::array<glm::dvec4, 16> corners;
    const auto from = boxCorners(low, high, _clipFromScene), to = boxCorners(low + way, high + way, _clipFromScene);
    std::copy(to.begin(), to.end(), std::copy(from.begin(), from.end(), corners.begin()));
    return mayBeInView(corners);
}

HullSolids shadowsOf(std::size_t tile, const CasterTiles& town, const HullGround& ground, const glm::dvec4& light) {
    const CasterTiles::Tile& casters = town.tiles()[tile];
    return town.asBoxes() ? boxSolids(ground, casters.boxes, light, town.origin())
                          : hullSolids(ground, casters.parts, light, town.origin());
}

/// Whether a tile must be found at once. What may wait becomes late; what is out of sight and not right any more is let go.
bool HullTiles::isDue(std::size_t tile, const CasterTiles& town, const HullGround& ground, const TileView& view) {
    const CasterTiles::Tile& casters = town.tiles()[tile];
    osg::ref_ptr<const TileShadows>& shadows = _shadows[tile];
    const bool isCurrent = shadows && _states[tile] == casters.revision;
    if (isCurrent && shadows->found == _light) return false;
    const double turned = isCurrent ? turnBetween(shadows->found, _light) : infinite;
    if (isCurrent && turned <= shadows->solids.turn) {
        const TileView::Shown shown = view.shown(shadows->solids);
        if (!shown.bounds) return false;
        const double off = turned * shadows->solids.largest / _light.z * shown.pixels / unseenPixels;
        if (off <= 1.0) _late.push_back({tile, std::max(off, turned / shadows->solids.turn)});
        return !(off <= 1.0);
    }
    const glm::dvec3& origin = town.origin();
    if (town.asBoxes() ||
        view.maySeeShadowsOf(casters.low - origin, casters.high - origin, _light, ground.all.low - origin.z))
        return true;
    shadows = nullptr;
    return false;
}

void HullTiles::update(const CasterTiles& town, const HullGround& ground, const glm::dvec4& light,
                       const TileView& view) {
    const bool still = light == _light;
    _light = light;
    _groundShadowsItself = !isLightBelow(ground.ground, light) && mayShadowItself(ground, light);
    _shadows.resize(town.tiles().size());
    _states.resize(town.tiles().size(), 0);
    std::vector<std::size_t> due;
    _late.clear();
    for (std::size_t i = 0; i < _shadows.size(); ++i)
        if (isDue(i, town, ground, view)) due.push_back(i);
    std::sort(_late.begin(), _late.end(), [](const Late& a, const Late& b) { return a.off > b.off; });
    const std::size_t most = std::max(std::size_t{4}, _shadows.size() / aFrame);
    for (std::size_t i = 0; i < std::min(most, _late.size()); ++i)
        if (still || _late[i].off > 0.5) due.push_back(_late[i].tile);
    find(town, ground, due);
}

void HullTiles::find(const CasterTiles& town, const HullGround& ground, const std::vector<std::size_t>& tiles) {
    if (tiles.empty()) return;
    List found(tiles.size());
    ProgressLine progress("gnomon: finding shadows on terrain");
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
        found[i] = new TileShadows(shadowsOf(tiles[i], town, ground, _light), _light);
        progress.show(double(++done) / double(tiles.size()));
    });
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        _shadows[tiles[i]] = found[i];
        _states[tiles[i]] = town.tiles()[tiles[i]].revision;
    }
    _found += static_cast<unsigned>(tiles.size());
}

std::vector<std::string> HullTiles::causes() const {
    std::array<std::size_t, hullOutcomes> counts{};
    std::size_t all = 0;
    for (const auto& shadows : _shadows)
        for (std::size_t i = 0; shadows && i < hullOutcomes; ++i)
            counts[i] += shadows->solids.outcomes[i], all += shadows->solids.outcomes[i];
    std::vector<std::string> causes;
    for (std::size_t i = 0; i < hullOutcomes; ++i)
        if (const std::string sentence = sentenceOf(HullOutcome(i)); counts[i] > 0 && !sentence.empty())
            causes.push_back(std::to_string(counts[i]) + " of " + std::to_string(all) + " casters: " + sentence);
    if (_groundShadowsItself)
        causes.push_back(
            "the terrain may be turned away from the light in places, for it is steep enough, and what it throws on "
            "itself is not drawn. Unless its steep sides face the light, use map, volume or traced, or raise the "
            "light.");
    return causes;
}

void HullTiles::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& one : _shadows)
        if (one) one->geometry->resizeGLObjectBuffers(maxSize);
}

void HullTiles::releaseGLObjects(osg::State* state) const {
    for (const auto& one : _shadows)
        if (one) one->geometry->releaseGLObjects(state);
}

} // namespace gnomon
