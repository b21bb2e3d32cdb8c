// SPDX-License-Identifier: MIT
#include <gnomon/geometry/Across.h>
#include <gnomon/mapfit/EdgeWidths.h>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr int directions = 6; // of edges, over half a turn
constexpr double halfTurn = 3.14159265358979323846;

/// Change of x/w and y/w along two ways on a surface.
glm::dmat2 slopeOf(const glm::dmat4& matrix, const glm::dvec4& at, const glm::dvec3& u, const glm::dvec3& v) {
    const auto along = [&](const glm::dvec3& way) {
        const glm::dvec4 change = matrix * glm::dvec4(way, 0.0);
        return (glm::dvec2(change) - glm::dvec2(at) / at.w * change.w) / at.w;
    };
    return {along(u), along(v)};
}

} // namespace

EdgeWidths::EdgeWidths(const glm::dmat4& clipFromScene, const glm::dvec2& pixels)
    : _clipFromScene(clipFromScene), _pixels(pixels) {}

/// An edge along a way in the map is moved across it. In the picture the area between its two places is the determinant times
/// as large, and it is that area divided by its length there that it moves.
void EdgeWidths::add(const SeenPlace& place, const glm::dmat4& mapFromScene) {
    const glm::dvec4 here(place.place, 1.0), clip = _clipFromScene * here, map = mapFromScene * here;
    if (!(clip.w > 0.0) || !(map.w > 0.0)) return;
    const auto [u, v] = across(glm::normalize(place.normal));
    const glm::dmat2 inMap = slopeOf(mapFromScene, map, u, v);
    glm::dmat2 inPicture = slopeOf(_clipFromScene, clip, u, v);
    for (int column = 0; column < 2; ++column) inPicture[column] *= _pixels / 2.0;
    const glm::dmat2 pictureFromMap = inPicture * glm::inverse(inMap);
    const glm::dmat2 mapFromPicture = glm::inverse(pictureFromMap);
    const double area = std::abs(glm::determinant(pictureFromMap));
    const auto add = [&](const glm::dvec2& way, double length) {
        const double width = area * glm::length(mapFromPicture * way) / glm::length(way);
        if (length > 0.0 && std::isfinite(width)) _edges.push_back({width, length});
    };
    if (place.edge != glm::dvec2(0.0)) return add(place.edge * _pixels, 1.0);
    for (int i = 0; i < directions; ++i) {
        const double angle = halfTurn * i / directions;
        const glm::dvec2 way = inPicture * glm::dvec2(std::cos(angle), std::sin(angle));
        add(way, glm::length(way) / directions);
    }
}

/// The share of all edges that is off by no more than x grows with x by pieces: those that are narrower count whole.
double EdgeWidths::usual(double share) const {
    std::vector<Edge> edges = _edges;
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.width < b.width; });
    double all = 0.0, slope = 0.0, whole = 0.0;
    for (const Edge& edge : edges) {
        all += edge.length;
        slope += edge.width > 0.0 ? edge.length / edge.width : 0.0;
    }
    for (const Edge& edge : edges) {
        const double reached = (share * all - whole) / slope; // if it lies before this edge's width
        if (reached <= edge.width) return reached / share;
        whole += edge.length;
        slope -= edge.width > 0.0 ? edge.length / edge.width : 0.0;
    }
    return edges.empty() ? 0.0 : edges.back().width;
}

} // namespace gnomon
