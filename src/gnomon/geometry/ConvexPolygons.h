// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gnomon {

using Corners = std::array<unsigned, 3>; ///< of a triangle: places among points.

/// A convex polygon of a mesh that lies in one plane.
struct ConvexPolygon {
    std::vector<unsigned> corners; ///< in the triangles' sense, none on the line between its neighbours.
    glm::dvec4 plane{0.0};         ///< unit normal, to the side from which the corners are counter-clockwise.
};

/// Triangles joined where they share an edge, lie in one plane and what they make is convex.
///
/// @param points     finite, those at one place welded: an edge is shared where its two corners are.
/// @param triangles  of some area; those that pass a shared edge in the same direction are not joined.
/// @param flatness   how far off a plane its points may be, points' unit.
/// @return           polygons that cover what the triangles cover, each place as often. At most four times as many as the
///                   fewest there could be where the edges are shared.
///
/// Cost   about linear: of triangles, n log n for their edges.
/// Source: S. Hertel and K. Mehlhorn, "Fast Triangulation of Simple Polygons", FCT 1983; here several edges on one line
///         between two polygons go together.
std::vector<ConvexPolygon> convexPolygons(const std::vector<glm::dvec3>& points, const std::vector<Corners>& triangles,
                                          double flatness);

} // namespace gnomon
