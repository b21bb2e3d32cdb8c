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
///               lamp's position, any other w the point (x, y, z) / w; with w < 0, too. The length of L does not
///               matter: 10⁻¹⁵⁰ and 10¹⁵⁰ give the matrix of 1.
/// @return       M for L of length 1 and w >= 0, so that M * v = (P·L) v for a point v of the plane, and every point
///               between plane and light has w > 0. nullopt if no shadow exists: the light is on or behind the plane,
///               zero, or anything is not finite.
///
/// A sun is on the plane when lower than 0.006° (sine 10⁻⁴): its shadows would be more than 10⁴ times as long as the
/// casters are high, and coarser by as much in single precision. A lamp is on it when no higher than the rounding of
/// P·L, be it a millimetre up and a kilometre away: only the sign of a lamp's height is the same in every unit and
/// about every origin. Hence a lamp that recedes (w → 0) has a shadow wherever its sun is above 0°; M tends to the
/// sun's.
///
/// Only points between plane and light cast: clip with planarClipPlanes().
/// Source: J. Blinn, "Me and My (Fake) Shadow", IEEE CG&A 8(1), 1988; the four planar documents (docs/sources.md).
std::optional<glm::dmat4> planarShadowMatrix(const glm::dvec4& plane, const glm::dvec4& light);

/// The half-spaces a caster must be cut to before it is flattened: a point (x, y, z, 1) is kept where both
/// dot products are >= 0.
struct PlanarClipPlanes {
    glm::dvec4 abovePlane; ///< the plane itself: what lies under it would throw an anti-shadow.
    glm::dvec4 belowLight; ///< what is lower than 0.999 of a lamp's height; (0, 0, 0, c > 0), that is all, for a sun.
};

/// @pre planarShadowMatrix(plane, light) has a value.
PlanarClipPlanes planarClipPlanes(const glm::dvec4& plane, const glm::dvec4& light);

} // namespace gnomon
