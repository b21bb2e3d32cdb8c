// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/HeightField.h>

namespace gnomon {

/// The height field that triangles are, where they are one: a regular grid along x and y whose cells are two triangles each,
/// cut along either diagonal, or a hole. Their order and winding do not matter. Vertical triangles that hang from its posts,
/// the skirts of terrain tiles, are left out.
///
/// @param vertices,indices  as TriangleGround's.
/// @param tolerance  how far off its place a corner may be along each axis, scene's unit; never more than 1/1000 of a step.
/// @return nullopt for all else. Heights are floats about the middle of their range.
///
/// Cost  one pass over the triangles.
std::optional<HeightField> gridOf(const std::vector<glm::dvec3>& vertices, const std::vector<unsigned>& indices,
                                  double tolerance);

} // namespace gnomon
