// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// The convex hull of points: a solid, or a plate where all points lie in one plane.
struct ConvexHull {
    struct Face {
        std::vector<unsigned> corners; ///< places in `vertices`, counter-clockwise from outside; three at least.
        glm::dvec4 plane{0.0};         ///< outwards, unit normal; faces that lie in one plane have the same one.
    };

    std::vector<glm::dvec3> vertices; ///< corners of the hull, each once.
    std::vector<Face> faces;          ///< of a solid triangles; of a plate its two sides.
};

/// @param points  any unit; those that are not finite are left out.
/// @return nullopt if what is left lies on one line, to within 10⁻¹² of its size (a needle of some 10⁻¹⁰ may be one, too).
///
/// Cost   about n log n.
/// Source: C. B. Barber, D. P. Dobkin and H. Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", ACM TOMS 22(4),
///         1996, by libqhull.
std::optional<ConvexHull> convexHull(const std::vector<glm::dvec3>& points);

} // namespace gnomon
