// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/silhouette/LightFacing.h>
#include <gnomon/silhouette/VolumeEnd.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double margin = 1e-3;   // of the receivers' size
constexpr double flattest = 0.02; // sine of the angle between the way of the light and a plane
constexpr double never = std::numeric_limits<double>::infinity();

glm::dvec3 cornerOf(const glm::dvec3& low, const glm::dvec3& high, unsigned i) {
    return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
}

/// The longest way from a corner of a box to a plane; infinite if there is none.
double longestTo(const glm::dvec4& plane, const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& light) {
    double longest = 0.0;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = cornerOf(low, high, i), away = awayFrom(light, corner);
        const double steepness = -glm::dot(glm::dvec3(plane), away), length = glm::length(away);
        if (!(steepness >= flattest * length && length > 0.0)) return never;
        longest = std::max(longest, distance(plane, corner) / steepness * length);
    }
    return longest;
}

} // namespace

std::vector<glm::dvec4> endPlanes(const glm::dvec3& low, const glm::dvec3& high) {
    const double away = margin * glm::distance(low, high);
    std::vector<glm::dvec4> planes;
    if (!std::isfinite(away)) return planes;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec4 plane(0.0);
        plane[axis] = 1.0;
        plane.w = away - low[axis];
        planes.push_back(plane);
        plane[axis] = -1.0;
        plane.w = away + high[axis];
        planes.push_back(plane);
    }
    return planes;
}

glm::dvec4 nearestEnd(const std::vector<glm::dvec4>& planes, const glm::dvec3& low, const glm::dvec3& high,
                      const glm::dvec4& light) {
    glm::dvec4 nearest(0.0);
    double least = never;
    for (const glm::dvec4& plane : planes) {
        const double longest = longestTo(plane, low, high, light);
        if (longest < least) least = longest, nearest = plane;
    }
    return nearest;
}

double lengthTo(const glm::dvec4& plane, const glm::dvec3& place, const glm::dvec4& light) {
    const double steepness = -glm::dot(glm::dvec3(plane), awayFrom(light, place));
    if (!(steepness > 0.0)) return -1.0;
    return std::max(0.0, distance(plane, place) / steepness);
}

} // namespace gnomon
