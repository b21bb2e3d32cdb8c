// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>

#include <glm/vec2.hpp>

#include <optional>

namespace gnomon {

/// Along the axes.
struct GroundBox {
    glm::dvec3 low{0.0}, high{0.0};
};

/// A stretch of a ray, in its lengths; from > to where there is none.
struct RaySpan {
    double from, to;
};

/// Twice the signed area of (0, a, b), counter-clockwise positive.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
/// Twice a triangle's area in plan, counter-clockwise positive.
inline double doubleArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return cross(glm::dvec2(b - a), glm::dvec2(c - a));
}

/// Where a ray is inside a box.
RaySpan spanInside(const GroundBox& box, const glm::dvec3& start, const glm::dvec3& along);

/// Where a ray meets a triangle, from either side, in lengths of the ray; nullopt if it does not. On its edges, too: no
/// ray slips between triangles that share an edge or a corner.
std::optional<double> meet(const GroundTriangle& triangle, const glm::dvec3& start, const glm::dvec3& along);

/// Tangent of a triangle's slope; infinite if it is vertical.
double slopeOf(const GroundTriangle& triangle);

} // namespace gnomon
