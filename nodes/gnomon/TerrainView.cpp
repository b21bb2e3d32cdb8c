// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ShadowBin.h>
#include <gnomon/TerrainTiles.h>
#include <gnomon/TerrainView.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Below it a shadow holds the middle of one pixel at most and of most of them none: what is left of it is noise.
constexpr double leastPixels = 1.0;
constexpr double unseenPixels = 0.25; // half of what the edges of a picture are off by themselves

using Corners = std::array<glm::dvec4, 8>;

/// Of a mesh's bounds, in clip space.
Corners cornersOf(const TerrainMesh& mesh, const glm::dvec3& margin, const glm::dmat4& clipFromTiles) {
    const glm::dvec3 low = mesh.low - margin, high = mesh.high + margin;
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        corners[i] = clipFromTiles * glm::dvec4(corner, 1.0);
    }
    return corners;
}

/// How many pixels long what has a length of 1 at the nearest of the corners can be, wherever it is on the screen.
double pixelsAt(const Corners& corners, const glm::dmat4& clipFromTiles, const osg::Vec2d& pixels) {
    const auto lengthOf = [&](int row) { return glm::length(glm::dvec3(glm::row(clipFromTiles, row))); };
    double nearest = infinite, most = 0.0;
    for (const glm::dvec4& corner : corners) nearest = std::min(nearest, corner.w);
    for (int i = 0; i < 2; ++i) most = std::max(most, 0.5 * pixels[i] * (lengthOf(i) + lengthOf(3)));
    return nearest > 0.0 ? most / nearest : infinite;
}

/// False if all points are beyond one side of the view, or behind the eye: quick, for it is asked of all that is not seen.
bool mayBeInView(const std::vector<glm::dvec4>& clipPoints) {
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

TerrainView::TerrainView(const ViewFrame& view, const glm::dvec3& origin)
    : _pixels(view.pixels), _clipFromTiles(glm::translate(toGlm(view.eyeFromGroup * view.projection), origin)) {}

std::optional<ScreenRect> TerrainView::seen(const TerrainMesh& mesh, const TileShadows& tile, double moved) const {
    if (mesh.layers() == 0) return std::nullopt;
    const Corners corners = cornersOf(mesh, marginOf(tile, moved), _clipFromTiles);
    const auto bounds = screenBounds({corners.begin(), corners.end()});
    if (!ShadowBin::getFilter()) return bounds.value_or(ScreenRect{{1.0, 1.0}, {-1.0, -1.0}});
    const double widest = (tile.widest + 2.0 * moved) * pixelsAt(corners, _clipFromTiles, _pixels);
    return widest < leastPixels ? std::nullopt : bounds;
}

bool TerrainView::maySeeShadowsOf(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& light, double lowest,
                                  double margin) const {
    if (!ShadowBin::getFilter() || light.w != 0.0 || !(light.z > 0.0)) return true;
    const double fall = std::max(0.0, high.z - lowest);
    const glm::dvec3 way = -glm::dvec3(light) / light.z * fall; // of the highest, to the lowest ground
    const glm::dvec3 more(margin * glm::length(high - low - way));
    std::vector<glm::dvec4> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? high.x + more.x : low.x - more.x, i & 2 ? high.y + more.y : low.y - more.y,
                                i & 4 ? high.z + more.z : low.z - more.z);
        for (const glm::dvec3& at : {corner, corner + way}) corners.push_back(_clipFromTiles * glm::dvec4(at, 1.0));
    }
    return mayBeInView(corners);
}

double TerrainView::mayBeOff(const TileShadows& tile, double off) const {
    if (!ShadowBin::getFilter()) return 0.0;
    const double onSlope = std::sqrt(1.0 + tile.found.steepest * tile.found.steepest); // of a length of 1 in plan
    double least = infinite;
    for (const TerrainMesh* mesh : {tile.decals.get(), tile.prisms.get()}) {
        if (!seen(*mesh, tile, off)) continue;
        const Corners corners = cornersOf(*mesh, marginOf(tile, off), _clipFromTiles);
        least = std::min(least, unseenPixels / (onSlope * pixelsAt(corners, _clipFromTiles, _pixels)));
    }
    return least;
}

} // namespace gnomon
