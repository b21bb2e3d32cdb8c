// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// Three corners a triangle, counter-clockwise from above.
using BoxTriangles = std::vector<glm::dvec3>;

/// What the bounding-box method knows of a caster, the same in every light.
struct BoxCaster {
    glm::dvec3 low{0.0}, high{0.0}; ///< its bounding box, along the axes of the world.
    /// The caster's own vertices nearest in plan to the corners of the box, counter-clockwise from the lowest one.
    std::array<glm::dvec2, 4> vertices{};
    std::array<double, 4> feet{}; ///< how far down the caster goes there.
    bool isBlock = false;         ///< all of it is between upright walls along these vertices, and its roof is flat.
};

/// @param points  the caster's, at least one.
BoxCaster boxCaster(const std::vector<glm::dvec3>& points);
/// @param low,high  a box in place of the points' own.
BoxCaster boxCaster(const std::vector<glm::dvec3>& points, const glm::dvec3& low, const glm::dvec3& high);

/// How far the published method lifts its mesh, scene's unit. Kept, so that what it errs by can be seen.
struct BoxLifts {
    double projected = 0.05; ///< points that rays meet.
    double between = 0.1;    ///< midpoints and interior points.
};

/// Quadrant, 1 to 4, of the light's azimuth as seen from a caster; north, where two meet, is 1.
/// @param away  in plan, from the light to the caster, any length.
int boxQuadrant(const glm::dvec2& away);

/// The bounding-box method as published: five vertices of the box by quadrant, moved to the caster's nearest own vertices,
/// three rays, a pentagon of twelve triangles that lie on the ground at eleven points. Its printed mistakes are not
/// repeated; what the method itself cannot do is kept: always a box, a flat roof, twelve triangles.
///
/// @param light  homogeneous: w = 0 the way towards a sun, w > 0 a lamp.
/// @return 12 triangles, three corners each; nullopt if a ray or a corner meets no ground, as published.
///
/// Source: ARL-TN-156, "Real-Time Shadows for Terrain Objects by the Bounding-Box Method".
std::optional<BoxTriangles> boxShadow(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light,
                                      const BoxLifts& lifts = {});

/// The pentagon that those triangles fill in plan.
std::array<glm::dvec2, 5> boxPentagon(const BoxTriangles& shadow);

/// Whether the method's outline is the caster's own: a block that stands in the ground, with those two sides turned away
/// from the light that the method takes for it, and shadows of the roof's edges that the ground does not bend. Walls that
/// are missing between the caster's vertices are not found.
bool isBoxOutline(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light);

} // namespace gnomon
