// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/Drape.h>
#include <gnomon/geometry/ConvexHull.h>

namespace gnomon {

/// A convex caster's shadow on the ground as one polygon.
struct HullFan {
    Drape triangles;
    /// How much is wrong, of the area in plan that the caster does not stand on: 0 is right, may be above 1. From places on
    /// the ground inside, one a triangle, that are not in shadow, and from where rays through the middles of the
    /// silhouette's edges meet the ground, beside the straight line between the corners.
    double off = 0.0;
};

/// The corners of the silhouette, each where its ray meets the ground. What is under the ground stands on it instead and
/// needs no ray. A house takes four triangles; of round casters corners are left out down to twelve, for at most 1 % of
/// the area that is seen.
///
/// @param light  homogeneous: w = 0 the way towards a sun, w > 0 a lamp.
/// @return triangles as drape()'s; nullopt if there is no shadow, a ray meets no ground, or the polygon overlaps itself:
///         drape() is right there.
///
/// Cost   a ray a corner above the ground, and one an edge that runs across the light. Many at once: packedShadows().
/// Limits straight from corner to corner; `off` has not seen what is small beside its triangles.
std::optional<HullFan> hullFan(const Ground& ground, const ConvexHull& hull, const glm::dvec4& light);

} // namespace gnomon
