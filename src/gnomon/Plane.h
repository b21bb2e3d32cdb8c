// SPDX-License-Identifier: MIT
#pragma once
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon {

/// Plane through three points, P = (a, b, c, d) with a·x + b·y + c·z + d = 0 and (a, b, c) of unit length.
///
/// @param p1,p2,p3  points, any unit; counter-clockwise as seen from the side the normal points to (the lit side).
/// @return          nullopt if the points lie on one line (to within an ulp of the largest coordinate) or are not
/// finite. Source: GusOnGames, clf_getPlaneEquation; M. Kilgard, halomagic.c, findPlane.
std::optional<glm::dvec4> planeFromPoints(const glm::dvec3& p1, const glm::dvec3& p2, const glm::dvec3& p3);

/// The same plane with a unit normal. nullopt if the normal is zero or anything is not finite.
std::optional<glm::dvec4> normalizedPlane(const glm::dvec4& plane);

/// Signed distance of `point` from `plane` (unit normal), in the points' unit: positive on the lit side.
double distance(const glm::dvec4& plane, const glm::dvec3& point);

/// Between unit normals of triangles that lie in one plane to within what floats leave.
constexpr double alikeNormals = 1e-3;

/// Whether a plane is that of a flat face. @param normal  the face's own, unit. @param points  its corners.
/// @param flatness  how far they may be off it.
template <class Points>
bool isPlaneOf(const glm::dvec4& plane, const glm::dvec3& normal, const Points& points, double flatness) {
    return glm::length(glm::dvec3(plane) - normal) <= alikeNormals &&
           std::all_of(points.begin(), points.end(),
                       [&](const glm::dvec3& point) { return std::abs(distance(plane, point)) <= flatness; });
}

/// The plane seen from another frame: `plane` is given in the source frame of `targetFromSource`, an affine matrix
/// (its last row is taken to be 0 0 0 1). The lit side stays the lit side, also under a mirror.
/// The result has a unit normal; nullopt if the matrix is singular, to within rounding, or anything is not finite.
std::optional<glm::dvec4> transformedPlane(const glm::dmat4& targetFromSource, const glm::dvec4& plane);

} // namespace gnomon
