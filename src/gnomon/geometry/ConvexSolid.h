// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ConvexHull.h>

#include <array>

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

/// Whether a mesh is convex about each of its edges, to within `flatness`, as balls and cones are, whose faces are many and lie
/// nearly in one plane. It may have no floor, which is level. Where areOnHull() holds, too, it is its own hull.
///
/// @param triangles  as above, or with one rim.
///
/// Cost  sorts the edges.
bool bendsOutwards(const std::vector<glm::dvec3>& points, const std::vector<std::array<unsigned, 3>>& triangles,
                   double flatness);

/// Whether none of the points, which the hull is of, is further inside than `flatness`.
///
/// Cost  for each point that is no corner of the hull, as many steps as that has faces.
bool areOnHull(const std::vector<glm::dvec3>& points, const ConvexHull& hull, double flatness);

} // namespace gnomon
