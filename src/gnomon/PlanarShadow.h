// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace gnomon {

/// Makes the matrix that flattens a point onto `plane` along the light's rays. PlanarShadowNode draws with it.
///
///     M = (P·L) I - L Pᵀ            shadow = M * point
///
/// Only points between plane and light cast. Clip the casters with planarClipPlanes() first.
///
/// @param plane  P = (a, b, c, d), a·x + b·y + c·z + d = 0, unit normal towards the lit side.
/// @param light  L = (x, y, z, w), homogeneous, in the plane's frame and unit. w = 0 is the direction towards a sun,
///               w = 1 a lamp's position, any other w the point (x, y, z) / w. The length of L does not matter.
/// @return       M for L of length 1 and w >= 0; nullopt if no shadow exists. M * v = (P·L) v for a point v of the
///               plane. Every point between plane and light has w > 0.
///
/// No shadow exists if the light is on or behind the plane, is zero, or is not finite.
/// A sun is on the plane if it is lower than 0.006° (sine 10⁻⁴). Its shadows would be too long for single precision.
/// A lamp is on the plane if its height is within the rounding of P·L. Only that rule holds in every unit and about
/// every origin. A lamp that recedes (w → 0) therefore has a shadow if its sun is above 0°. M then tends to the sun's
/// matrix.
///
/// Source
/// - J. Blinn, "Me and My (Fake) Shadow", IEEE CG&A 8(1), 1988.
/// - The four planar documents, see docs/evidence/sources.md.
GNOMON_EXPORT std::optional<glm::dmat4> planarShadowMatrix(const glm::dvec4& plane, const glm::dvec4& light);

/// The half-spaces that a caster is clipped to before it is flattened.
///
/// A point (x, y, z, 1) is kept if both dot products are >= 0. Other points would cast anti-shadows.
struct PlanarClipPlanes {
    glm::dvec4 abovePlane; ///< The plane itself: keeps points above it.
    glm::dvec4 belowLight; ///< Keeps points below 0.999 of a lamp's height. (0, 0, 0, c > 0) for a sun: keeps all.
};

/// Makes the clip planes for one plane and light.
/// @pre planarShadowMatrix(plane, light) has a value.
GNOMON_EXPORT PlanarClipPlanes planarClipPlanes(const glm::dvec4& plane, const glm::dvec4& light);

} // namespace gnomon
