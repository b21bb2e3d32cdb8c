// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace gnomon {

/// Matrix that flattens a point onto `plane` along the light's rays.
///
///     M = (P·L) I - L Pᵀ            shadow = M * point
///
/// @param plane  P = (a, b, c, d), a·x + b·y + c·z + d = 0, unit normal towards the lit side.
/// @param light  L = (x, y, z, w), homogeneous, in the plane's frame and unit: w = 0 the way towards a sun, w = 1 a
///               lamp's position, any other w the point (x, y, z) / w. The length of L does not matter.
/// @return       scaled so that P·L, the w of a point on the plane, is that of the light divided by its length.
///               nullopt if the light is on or behind the plane (closer to it than 10⁻⁴ of its length: a sun lower
///               than 0.006°), zero, or anything is not finite: no shadow exists.
///
/// Only points between plane and light cast: clip with planarClipPlanes().
/// Source: J. Blinn, "Me and My (Fake) Shadow", IEEE CG&A 8(1), 1988; the four planar documents (docs/sources.md).
std::optional<glm::dmat4> planarShadowMatrix(const glm::dvec4& plane, const glm::dvec4& light);

/// The half-spaces a caster must be cut to before it is flattened: a point (x, y, z, 1) is kept where both
/// dot products are >= 0.
struct PlanarClipPlanes {
    glm::dvec4 abovePlane; ///< the plane itself: what lies under it would throw an anti-shadow.
    glm::dvec4 belowLight; ///< what is nearer to the plane than the light, by a thousandth; (0, 0, 0, c > 0) for a sun.
};

/// @pre planarShadowMatrix(plane, light) has a value.
PlanarClipPlanes planarClipPlanes(const glm::dvec4& plane, const glm::dvec4& light);

} // namespace gnomon
