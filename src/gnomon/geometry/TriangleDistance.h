// SPDX-License-Identifier: MIT
#pragma once
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {

/// From the origin to the segment between two points.
inline double segmentDistance(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a;
    const double square = glm::dot(way, way);
    const double at = square > 0.0 ? glm::clamp(-glm::dot(a, way) / square, 0.0, 1.0) : 0.0;
    return glm::length(a + at * way);
}

/// From the origin to a triangle.
inline double triangleDistance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const auto within = [&normal](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, -from), normal) >= 0.0;
    };
    const double area = glm::length(normal);
    if (area > 0.0 && within(a, b) && within(b, c) && within(c, a)) return std::abs(glm::dot(a, normal)) / area;
    return std::min({segmentDistance(a, b), segmentDistance(b, c), segmentDistance(c, a)});
}

} // namespace gnomon
