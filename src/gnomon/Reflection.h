// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

/// Matrix that takes a point to its mirror image: x - 2 (n·x + d) n. It is its own inverse and turns round the sense in
/// which a triangle's corners follow each other.
///
/// @param plane  (a, b, c, d), a·x + b·y + c·z + d = 0, unit normal; either side. Not finite: nor is the matrix.
/// Source: M. Kilgard, halomagic.c, whose glScalef(1, -1, 1) is that of y = 0.
glm::dmat4 reflectionMatrix(const glm::dvec4& plane);

} // namespace gnomon
