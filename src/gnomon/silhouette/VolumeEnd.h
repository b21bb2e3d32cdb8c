// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gnomon {

/// Planes at which volumes may end: all that receives is on the side to which each unit normal points, with a margin.
///
/// @param low,high  bounds of all that receives; none if they are not finite.
std::vector<glm::dvec4> endPlanes(const glm::dvec3& low, const glm::dvec3& high);

/// The plane at which the volume of what is within a box is shortest; (0, 0, 0, 0) if it must not end.
/// @param light  w is 0 and the direction has length 1, or w is 1.
glm::dvec4 nearestEnd(const std::vector<glm::dvec4>& planes, const glm::dvec3& low, const glm::dvec3& high,
                      const glm::dvec4& light);

/// How far, in lengths of the way from the light, a place's volume goes to the plane; 0 beyond it. Of (0, 0, 0, 0) -1.
double lengthTo(const glm::dvec4& plane, const glm::dvec3& place, const glm::dvec4& light);

} // namespace gnomon
