// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ScreenArea.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon {
namespace {

constexpr std::size_t most = 8; // each of four cuts adds one corner

/// The four sides of the screen: a point is kept where the product is not below 0.
const std::array<glm::dvec4, 4> sides{
    {{1.0, 0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0, 1.0}, {0.0, 1.0, 0.0, 1.0}, {0.0, -1.0, 0.0, 1.0}}};

struct Polygon {
    std::array<glm::dvec4, most> corners;
    std::size_t count = 0;

    void add(const glm::dvec4& corner) { corners[count++] = corner; }
};

Polygon cut(const Polygon& polygon, const glm::dvec4& half) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec4 &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.count];
        const double fromA = glm::dot(half, a), fromB = glm::dot(half, b);
        if (fromA >= 0.0) result.add(a);
        if ((fromA < 0.0) != (fromB < 0.0)) result.add(a + (b - a) * (fromA / (fromA - fromB)));
    }
    return result;
}

} // namespace

ScreenArea screenArea(const std::array<glm::dvec4, 4>& quad, const glm::dvec2& pixels) {
    Polygon polygon;
    for (const glm::dvec4& corner : quad) polygon.add(corner);
    for (const glm::dvec4& half : sides) polygon = cut(polygon, half);
    std::array<glm::dvec2, most> places;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec4& corner = polygon.corners[i];
        if (!(corner.w > 0.0)) return {}; // all of it is in the eye
        places[i] = glm::dvec2(corner) / corner.w * pixels / 2.0;
    }
    ScreenArea result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec2 &a = places[i], &b = places[(i + 1) % polygon.count];
        result.area += (a.x * b.y - a.y * b.x) / 2.0;
        result.around += glm::distance(a, b);
    }
    result.area = std::abs(result.area);
    return result;
}

} // namespace gnomon
