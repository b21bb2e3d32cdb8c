// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>
#include <gnomon/geometry/ConvexShadow.h>

namespace gnomon {

/// A convex caster's shadow laid on the ground: triangles, three corners each, counter-clockwise from above, in the ground's
/// own planes or those that stand for it.
using Drape = std::vector<glm::dvec3>;

/// How far off the height of the ground may be so that no edge of a shadow is off by more than `error` in plan.
///
/// A height that is off by h moves an edge by h / (tan e - g) along the light's azimuth and by nothing across it, where e is
/// the light's elevation and g the tangent of the ground's slope.
/// @param error  in plan, scene's unit.
/// @param tangent  of the light's elevation; of a lamp the least over the ground.
/// @param slope    steepest of the ground where the shadow may fall.
/// @return 0, which is exact, where the ground may be as steep as the light.
double heightError(double error, double tangent, double slope);

/// @param shadow  of one convex caster.
/// @param error   of the ground's height, see heightError(); 0 is exact.
///
/// Cost  linear in the triangles that the shadow touches, times its planes. Follows slopes, cliffs, holes and borders.
Drape drape(const Ground& ground, const ConvexShadow& shadow, double error);

} // namespace gnomon
