// SPDX-License-Identifier: MIT
#pragma once
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon {

/// How far each vertex of a mesh moves on, away from the light, before it casts: so that a round body of few facets has no
/// teeth along its terminator.
///
/// Smooth shading lights a facet a little beyond where its plane turns away from the light. There it lies behind its
/// neighbours, whose shadow has the facets' outline. So vertices near the terminator cast from farther on, by the length of
/// a facet along the way on which its normals turn. To move along the light's rays changes no outline of a shadow. It takes
/// the shadow away from what is nearer than that behind the rim of the body.
///
/// Only facets whose normals are within 25 degrees of their planes count: flat walls, and houses with averaged normals,
/// cast from where they are. Vertices at one place have one offset, so that what is closed stays closed.
///
/// The xyz of an offset are the vertex's normal, divided by the turn of the normals along a facet's side; w is the longest way,
/// 0 for what casts from where it is. See terminatorOffset(), and mark.vert, which has twice that.
///
/// @param normals  as many as positions, of any length; 0 where there is none.
/// @param corners  three a triangle.
/// @return as many as positions; none if all would be 0.
///
/// Cost    20 ns a triangle without smooth facets; with them 100 ns a vertex more.
/// Source  J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, ch. 4, moves the start of rays to the
///         surface that the normals describe. Maps and volumes have no rays to move, so here the casters move.
std::vector<glm::vec4> terminatorOffsets(const std::vector<glm::dvec3>& positions,
                                         const std::vector<glm::vec3>& normals, const std::vector<unsigned>& corners);

/// How far a vertex moves, in the mesh's unit: all the way where the light grazes it to a
/// whole turn, not at all beyond one and a half.
/// @param towards  unit vector to the light.
inline double terminatorOffset(const glm::vec4& offset, const glm::dvec3& towards) {
    return double(offset.w) * glm::clamp(3.0 - 2.0 * std::abs(glm::dot(glm::dvec3(offset), towards)), 0.0, 1.0);
}

} // namespace gnomon
