// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>

#include <vector>

namespace gnomon {

/// Corners of the convex hull of points in a plane, counter-clockwise; of points on a line its ends, of fewer than three
/// places those.
/// Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", IPL 9(5), 1979.
std::vector<glm::dvec2> convexHull2D(std::vector<glm::dvec2> points);

/// What an outline covers that is grown by `by` to each side.
std::vector<glm::dvec2> grownOutline(const std::vector<glm::dvec2>& corners, const glm::dvec2& by);

} // namespace gnomon
