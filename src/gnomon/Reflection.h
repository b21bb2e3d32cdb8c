// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

/// Makes the matrix that mirrors a point x in a plane: x - 2 (n·x + d) n. PlanarReflectionNode draws with it.
///
/// The matrix is its own inverse. It reverses the winding of triangles.
///
/// @param plane  (a, b, c, d), a·x + b·y + c·z + d = 0, unit normal to either side. A non-finite plane gives a
///               non-finite matrix.
///
/// Source
/// - M. Kilgard, halomagic.c: its glScalef(1, -1, 1) mirrors in y = 0.
GNOMON_EXPORT glm::dmat4 reflectionMatrix(const glm::dvec4& plane);

} // namespace gnomon
