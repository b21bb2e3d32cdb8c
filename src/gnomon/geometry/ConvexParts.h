// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ConvexHull.h>

#include <array>
#include <cstddef>

namespace gnomon {

/// A mesh that is its own convex hull, as most houses are.
///
/// @param points     each a corner of some triangle.
/// @param triangles  of a connected surface, counter-clockwise from outside, on which each edge is passed as often one way as
///                   the other; none twice.
/// @param flatness   how far a point may be from a plane that it lies in: triangles within it lie in one, as floats leave
///                   the two of a turned wall.
/// @return its faces are the triangles, those in one plane with the same one; nullopt if it is not convex, has a point that
///         is no corner of the hull, or so many that convexHull() is quicker.
///
/// Cost  planes times points.
std::optional<ConvexHull> convexSolid(const std::vector<glm::dvec3>& points,
                                      const std::vector<std::array<unsigned, 3>>& triangles, double flatness);

/// A convex piece of casters: a solid, or a plate.
struct ConvexPart {
    ConvexHull hull;
    /// Outwards, of a plate that bounds a solid: where the light is not on its outer side, the plates that are turned to
    /// the light cast all of the shadow without this one.
    std::optional<glm::dvec4> front;
};

/// Casters cut into convex pieces whose shadows together are the casters' shadow, wherever the light is above what it
/// falls on. Independent of the light: once a revision of the casters.
///
/// Of each part that is connected over vertices at one place:
/// - its hull, if it covers that once, but for what looks straight down (a box with or without floor, a gabled house, a tank, a
///   ball, a cone), points that rounding alone keeps apart taken as one;
/// - pieces of its footprint, as high as it is, if it is an upright prism with or without floor (an L, a courtyard);
/// - else each of its flat faces as convex plates. Those of a closed part have a front, those that look down are left out.
///
/// @param positions  z up, any unit, about a local origin; triangles with a corner that is not finite are left out.
/// @param indices    three a triangle; triangles with one that is not below `vertexCount` are left out.
/// @return           in the order of the parts' first triangles. Exact to within 10⁻⁶ of a part's size.
///
/// Limits Solids cast from inside, too: a lamp inside of one has no shadow from it. A prism whose walls and roof do not
///        share their corners is taken as plates.
/// Cost   sorts vertices and edges once.
std::vector<ConvexPart> convexParts(const glm::vec3* positions, std::size_t vertexCount, const unsigned* indices,
                                    std::size_t indexCount);

/// The points of each part of casters that is connected over vertices at one place: what is taken for an object. Order and
/// parameters as convexParts().
std::vector<std::vector<glm::dvec3>> connectedPoints(const glm::vec3* positions, std::size_t vertexCount,
                                                     const unsigned* indices, std::size_t indexCount);

} // namespace gnomon
