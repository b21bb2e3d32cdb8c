// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/silhouette/SilhouetteMesh.h>

namespace gnomon {

/// How often each triangle of a mesh counts in the surface that casts: 1, -1 turned round, or 0. One more at the end is 0.
using FacingWeights = std::vector<std::int8_t>;

/// A closed part casts by the triangles that face the light, and one turned inside out by those that do not. An open part,
/// and a closed one in whose bounds a lamp is, casts by all, each turned to the light: what of it is between the light and a
/// point is then counted once, whatever its winding.
///
/// Each triangle is asked once, in double: its two neighbours at an edge then agree. One that the light grazes, to 1e-5 of a
/// radian, faces it: else the volume's side would lie in it.
///
/// @param light  in the mesh's frame; w is 0 and the direction has length 1, or w is 1.
///
/// Cost  linear in the triangles, in parallel.
void faceLight(const SilhouetteMesh& mesh, const glm::dvec4& light, FacingWeights& weights);

/// Whether the light grazes a triangle of a part, as faceLight() has it; not if it has no plane.
bool grazes(const SilhouetteMesh& mesh, const SilhouetteMesh::Part& part, const glm::dvec4& light,
            std::size_t triangle);

/// From the light to a place, of a lamp with its length; else of length 1.
inline glm::dvec3 awayFrom(const glm::dvec4& light, const glm::dvec3& place) {
    return light.w * place - glm::dvec3(light);
}

} // namespace gnomon
