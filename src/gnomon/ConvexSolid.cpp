// SPDX-License-Identifier: MIT
#include <gnomon/ConvexSolid.h>
#include <gnomon/Plane.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double alike = 1e-3;          // between unit normals of triangles in one plane
constexpr std::size_t mostAsked = 1000; // points of planes

using Points = std::vector<glm::dvec3>;
using Triangle = std::array<unsigned, 3>;

glm::dvec4 planeOf(const Points& points, const Triangle& t) {
    const glm::dvec3 normal = glm::normalize(glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
    return {normal, -glm::dot(normal, points[t[0]])};
}

} // namespace

std::optional<ConvexHull> convexSolid(const Points& points, const std::vector<Triangle>& triangles, double flatness) {
    // Euler's formula: else something is covered twice, or there are points elsewhere.
    if (triangles.size() + 4 != 2 * points.size()) return std::nullopt;
    ConvexHull hull{points, {}};
    std::vector<glm::dvec4> planes;
    std::vector<int> planesAt(points.size());
    for (const Triangle& t : triangles) {
        const glm::dvec4 own = planeOf(points, t);
        const auto holds = [&](const glm::dvec4& plane) {
            return glm::length(glm::dvec3(plane - own)) <= alike &&
                   std::all_of(t.begin(), t.end(),
                               [&](unsigned corner) { return std::abs(distance(plane, points[corner])) <= flatness; });
        };
        const auto known = std::find_if(planes.begin(), planes.end(), holds);
        hull.faces.push_back({{t.begin(), t.end()}, known != planes.end() ? *known : own});
        if (known != planes.end()) continue;
        planes.push_back(own);
        if (planes.size() * points.size() > mostAsked) return std::nullopt;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double outside = distance(own, points[i]);
            if (!(outside <= flatness)) return std::nullopt;
            planesAt[i] += outside >= -flatness ? 1 : 0;
        }
    }
    const bool areCorners = std::all_of(planesAt.begin(), planesAt.end(), [](int count) { return count >= 3; });
    return areCorners ? std::optional(std::move(hull)) : std::nullopt;
}

} // namespace gnomon
