// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Drape.h>

namespace gnomon {

/// A convex caster's shadow on the ground as one polygon: the corners of its silhouette, each where its ray meets the
/// ground. What is under the ground stands on it instead and needs no ray. A house takes four triangles.
///
/// @param light  homogeneous: w = 0 the way towards a sun, w > 0 a lamp; the one of `shadow`.
/// @return triangles as drape()'s; nullopt if a ray meets no ground, or the polygon overlaps itself: drape() is right there.
///
/// Cost   a ray a corner above the ground.
/// Limits straight from corner to corner: off where the ground is rough in between.
std::optional<Drape> hullFan(const Ground& ground, const ConvexShadow& shadow, const glm::dvec4& light);

} // namespace gnomon
