// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon {

/// Makes the plane through three points: P = (a, b, c, d) with a·x + b·y + c·z + d = 0 and (a, b, c) of unit length.
///
/// @param p1,p2,p3  points, any unit. The normal points to the side that sees them counter-clockwise: the lit side.
/// @return          nullopt if a point is not finite, or if the points lie on one line to within the rounding of the
///                  largest coordinate.
///
/// Source
/// - GusOnGames, clf_getPlaneEquation; M. Kilgard, halomagic.c, findPlane.
GNOMON_EXPORT std::optional<glm::dvec4> planeFromPoints(const glm::dvec3& p1, const glm::dvec3& p2,
                                                        const glm::dvec3& p3);

/// Scales a plane to a unit normal.
/// @return nullopt if the normal is zero or a value is not finite.
GNOMON_EXPORT std::optional<glm::dvec4> normalizedPlane(const glm::dvec4& plane);

/// Signed distance of `point` from `plane` (unit normal), in the points' unit. Positive on the lit side.
GNOMON_EXPORT double distance(const glm::dvec4& plane, const glm::dvec3& point);

/// Largest distance between the unit normals of float triangles that count as lying in one plane.
constexpr double alikeNormals = 1e-3;

/// True if a flat face lies in a plane.
/// @param normal    unit normal of the face.
/// @param points    corners of the face.
/// @param flatness  largest distance of a corner from the plane, points' unit.
template <class Points>
bool isPlaneOf(const glm::dvec4& plane, const glm::dvec3& normal, const Points& points, double flatness) {
    return glm::length(glm::dvec3(plane) - normal) <= alikeNormals &&
           std::all_of(points.begin(), points.end(),
                       [&](const glm::dvec3& point) { return std::abs(distance(plane, point)) <= flatness; });
}

/// Transforms a plane to another frame. The lit side stays the lit side, also under a mirror.
///
/// @param targetFromSource  affine transform. Its last row counts as 0 0 0 1.
/// @param plane             plane in the source frame, any length of normal.
/// @return                  plane in the target frame with a unit normal; nullopt if the matrix is singular to within
///                          rounding, or a value is not finite.
GNOMON_EXPORT std::optional<glm::dvec4> transformedPlane(const glm::dmat4& targetFromSource, const glm::dvec4& plane);

} // namespace gnomon
