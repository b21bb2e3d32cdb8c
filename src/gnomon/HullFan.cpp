// SPDX-License-Identifier: MIT
#include <gnomon/GroundQuery.h>
#include <gnomon/HullFan.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr std::size_t wantedTriangles = 12; // as many as the bounding-box method's
constexpr double mostLost = 0.01;           // of what is seen, for fewer triangles

/// Where a point's shadow falls; the ground over it, if it is not above the ground.
std::optional<glm::dvec3> shadowOf(const glm::dvec3& point, const Ground& ground, const glm::dvec4& light) {
    const auto height = ground.height(point.x, point.y);
    if (height && point.z <= *height) return glm::dvec3(point.x, point.y, *height);
    return ground.hit(point, light.w * point - glm::dvec3(light));
}

/// From the corner that sees all others; empty if none does.
Drape fanOf(const Drape& rim) {
    for (std::size_t start = 0; start < rim.size(); ++start) {
        Drape fan;
        double least = 0.0;
        for (std::size_t i = 1; i + 1 < rim.size(); ++i) {
            const glm::dvec3 &a = rim[start], &b = rim[(start + i) % rim.size()],
                             &c = rim[(start + i + 1) % rim.size()];
            const double area = doubleArea(a, b, c);
            least = std::min(least, area);
            if (area > 0.0) fan.insert(fan.end(), {a, b, c});
        }
        if (least == 0.0) return fan;
    }
    return {};
}

/// Whether an edge's shadow is straight in plan whatever the ground: its plane through the light stands upright.
bool isAlong(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec4& light) {
    const glm::dvec3 normal = glm::cross(glm::dvec3(light) - light.w * a, b - a);
    return !(std::abs(normal.z) > 1e-9 * glm::length(normal));
}

/// Between the chord from a to b and the parabola through a place on the ground, twice the area in plan.
double doubleLens(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& place) {
    return 4.0 / 3.0 * std::abs(doubleArea(a, b, place));
}

/// Twice the area in plan that the rim is off; infinite where a ray through the middle of an edge meets no ground.
double doubleOff(const Ground& ground, const ConvexShadow& shadow, const glm::dvec4& light, const Drape& rim) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const std::size_t next = (i + 1) % rim.size();
        const glm::dvec3 &a = shadow.silhouette[i], &b = shadow.silhouette[next];
        if (isAlong(a, b, light)) continue;
        const auto place = shadowOf(0.5 * (a + b), ground, light);
        if (!place) return std::numeric_limits<double>::infinity();
        sum += doubleLens(rim[i], rim[next], *place);
    }
    return sum;
}

/// Leaves out the corners that matter least while there are more triangles than wanted. @param most  twice the area in plan
/// that may be lost or won by it. @return what is.
double simplify(Drape& rim, double most) {
    double sum = 0.0;
    while (rim.size() > wantedTriangles + 2) {
        const auto at = [&](std::size_t i) { return rim[i % rim.size()]; };
        std::size_t least = 0;
        double area = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const double one = std::abs(doubleArea(at(i + rim.size() - 1), at(i), at(i + 1)));
            if (one < area) area = one, least = i;
        }
        if (!(sum + area <= most)) break;
        sum += area;
        rim.erase(rim.begin() + static_cast<std::ptrdiff_t>(least));
    }
    return sum;
}

double doublePolygon(const std::vector<glm::dvec3>& rim) {
    double sum = 0.0;
    for (std::size_t i = 2; i < rim.size(); ++i) sum += doubleArea(rim[0], rim[i - 1], rim[i]);
    return sum;
}

/// Twice the area in plan that holds no shadow, by a place on the ground in each third of a triangle.
double doubleLit(const Ground& ground, const ConvexShadow& shadow, const Drape& fan) {
    double sum = 0.0;
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const std::size_t first = i - i % 3;
        const glm::dvec3 middle = (fan[first] + fan[first + 1] + fan[first + 2]) / 3.0;
        const glm::dvec3 place = 0.5 * (middle + fan[i]);
        const auto height = ground.height(place.x, place.y);
        if (!height || !shadow.holds({place.x, place.y, *height}))
            sum += doubleArea(fan[first], fan[first + 1], fan[first + 2]) / 3.0;
    }
    return sum;
}

} // namespace

std::optional<HullFan> hullFan(const Ground& ground, const ConvexShadow& shadow, const glm::dvec4& light) {
    Drape rim;
    for (const glm::dvec3& corner : shadow.silhouette) {
        const auto place = shadowOf(corner, ground, light);
        if (!place) return std::nullopt;
        rim.push_back(*place);
    }
    const double seen = std::max(0.0, doublePolygon(rim) - std::abs(doublePolygon(shadow.silhouette)));
    double wrong = doubleOff(ground, shadow, light, rim);
    wrong += simplify(rim, mostLost * seen);
    HullFan fan{fanOf(rim)};
    if (fan.triangles.empty()) return std::nullopt;
    wrong += doubleLit(ground, shadow, fan.triangles);
    fan.off = wrong > 0.0 ? wrong / seen : 0.0;
    return fan;
}

} // namespace gnomon
