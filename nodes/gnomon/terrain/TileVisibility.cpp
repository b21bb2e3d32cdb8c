// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/terrain/TileShadows.h>
#include <gnomon/terrain/TileVisibility.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Below it a shadow holds the middle of one pixel at most and of most of them none: what is left of it is noise.
constexpr double leastPixels = 1.0;
constexpr double unseenPixels = 0.25; // half of what the edges of a picture are off by themselves

// Of a texel's side where it is nearest: what is drawn by texels is off by half their diagonal at most.
constexpr double texelPixels = 0.4;
constexpr double mostTexels = 1 << 20; // 128 KB of bits
constexpr double mostOnASide = 4096.0; // and ground that is not much longer than wide

double nearestOf(const std::array<glm::dvec4, 8>& corners) {
    double nearest = infinite;
    for (const glm::dvec4& corner : corners) nearest = std::min(nearest, corner.w);
    return nearest;
}

/// How many pixels long what has a length of 1 can be where w is 1. A short way on the screen is (x - u w, y - v w) / w for
/// one of (x, y, w) in clip space from a place that is seen at (u, v); its length is convex in u and v, so that the most is
/// at a corner of the screen.
double mostPixelsOf(const glm::dmat4& clipFromTiles, const osg::Vec2d& pixels) {
    const auto part = [&](int row) { return glm::dvec3(glm::row(clipFromTiles, row)); };
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

/// By how much shadows leave their bounds that move in plan on the ground under them.
glm::dvec3 marginOf(const TileShadows& tile, double moved) {
    if (!(moved > 0.0)) return glm::dvec3(0.0);
    return {moved, moved, moved * tile.found.steepest};
}

} // namespace

TileVisibility::TileVisibility(const ViewFrame& view, const glm::dvec3& origin)
    : _options(view.options),
      _clipFromTiles(glm::translate(toGlm(view.eyeFromGroup * view.projection), origin)),
      _mostPixels(mostPixelsOf(_clipFromTiles, view.pixels)) {}

TileVisibility::Shown TileVisibility::shown(const TileMesh& mesh, const TileShadows& tile, double moved) const {
    if (mesh.layers() == 0) return {};
    const glm::dvec3 margin = marginOf(tile, moved);
    const auto corners = boxCorners(mesh.low - margin, mesh.high + margin, _clipFromTiles);
    thread_local std::vector<glm::dvec4> points; // memory that is used again
    points.assign(corners.begin(), corners.end());
    const auto bounds = screenBounds(points);
    const double nearest = nearestOf(corners), pixels = nearest > 0.0 ? _mostPixels / nearest : infinite;
    if (!_options.filter) return {bounds.value_or(ScreenRect{{1.0, 1.0}, {-1.0, -1.0}}), pixels};
    const bool isTooSmall = (tile.widest + 2.0 * moved) * pixels < leastPixels;
    return {isTooSmall ? std::nullopt : bounds, pixels};
}

std::optional<ScreenRect> TileVisibility::seen(const TileMesh& mesh, const TileShadows& tile) const {
    return shown(mesh, tile, 0.0).bounds;
}

std::optional<int> TileVisibility::bitmapLevel(const TileShadows& tile) const {
    const Shown now = shown(*tile.decals, tile, 0.0);
    if (!now.bounds || !std::isfinite(now.pixels)) return std::nullopt;
    const double onSlope = std::sqrt(1.0 + tile.slope * tile.slope); // of a length of 1 in plan
    const double level = std::floor(2.0 * std::log2(texelPixels / (onSlope * now.pixels)));
    return isBitmapSmall(tile, int(level)) ? std::optional(int(level)) : std::nullopt;
}

bool TileVisibility::isBitmapSmall(const TileShadows& tile, int level) {
    const glm::dvec2 texels = glm::dvec2(tile.decals->high - tile.decals->low) / bitmapTexel(level);
    return std::max(texels.x, texels.y) <= mostOnASide && texels.x * texels.y <= mostTexels;
}

double TileVisibility::bitmapTexel(int level) { return std::exp2(0.5 * level); }

bool TileVisibility::maySeeShadowsOf(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& light,
                                     double lowest, double margin) const {
    if (!_options.filter || light.w != 0.0 || !(light.z > 0.0)) return true;
    const double fall = std::max(0.0, high.z - lowest);
    const glm::dvec3 way = -glm::dvec3(light) / light.z * fall; // of the highest, to the lowest ground
    const glm::dvec3 more(margin * glm::length(high - low - way));
    std::array<glm::dvec4, 16> corners;
    const auto from = boxCorners(low - more, high + more, _clipFromTiles),
               to = boxCorners(low - more + way, high + more + way, _clipFromTiles);
    std::copy(to.begin(), to.end(), std::copy(from.begin(), from.end(), corners.begin()));
    return mayBeInView(corners);
}

double TileVisibility::mayBeOff(const TileShadows& tile, double off) const {
    if (!_options.filter) return 0.0;
    const double onSlope = std::sqrt(1.0 + tile.found.steepest * tile.found.steepest); // of a length of 1 in plan
    double least = infinite;
    for (const TileMesh* mesh : {tile.decals.get(), tile.prisms.get()})
        if (const Shown now = shown(*mesh, tile, off); now.bounds)
            least = std::min(least, unseenPixels / (onSlope * now.pixels));
    return least;
}

} // namespace gnomon
