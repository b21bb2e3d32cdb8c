// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>
#include <gnomon/metrics/Grid.h>

namespace gnomon::metrics {

/// A straight piece of a line in a picture, in px; at most √2 long.
struct Segment {
    glm::dvec2 from, to;
};

double length(const Segment& segment);                            ///< px
double distance(const Segment& segment, const glm::dvec2& point); ///< px, of the nearest point of the segment

/// Where a picture passes `level`, by marching squares between pixel centres: linear along the four sides of each
/// square, straight within. Exact for a picture that is linear in x and y. Saddles are cut by the mean of their corners.
/// Only squares whose four corners are in `within`; a pixel is below if its value < level. Pieces of no length are left
/// out. Source: W. Lorensen and H. Cline, "Marching Cubes", SIGGRAPH 1987, in two dimensions.
std::vector<Segment> isoLine(const Picture& picture, double level, const Mask& within);

} // namespace gnomon::metrics
