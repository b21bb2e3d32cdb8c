// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>
#include <metrics/Grid.h>

#include <memory>

namespace gnomon::metrics {

/// A straight piece of a line in a picture, at most √2 px long.
struct Segment {
    glm::dvec2 from; ///< Start, px.
    glm::dvec2 to;   ///< End, px.
};

/// Length of a segment, px.
double length(const Segment& segment);
/// Distance from a point to the nearest point of a segment, px.
double distance(const Segment& segment, const glm::dvec2& point);

/// Finds the line where a picture crosses `level`, by marching squares between pixel centres.
///
/// The line is exact for a picture that is linear in x and y. Saddles are cut by the mean of their corners. Pieces
/// without length are left out.
///
/// @param picture  values at pixel centres.
/// @param level    a pixel is below if its value < level.
/// @param within   only squares whose four corners are in this set count.
///
/// Source
/// - W. Lorensen and H. Cline, "Marching Cubes", SIGGRAPH 1987, in two dimensions.
std::vector<Segment> isoLine(const Picture& picture, double level, const Mask& within);

/// Finds the exact distance from a point to the nearest of many short segments.
///
/// Cost
/// - A k-d tree over the segments' midpoints; a search in it for each point.
/// Threads
/// - Any number may ask one object.
class NearestSegment {
public:
    /// Builds the tree.
    /// @param segments  each at most √2 px long, as isoLine() makes them. They must outlive this object.
    explicit NearestSegment(const std::vector<Segment>& segments);
    ~NearestSegment();
    NearestSegment(const NearestSegment&) = delete;
    NearestSegment& operator=(const NearestSegment&) = delete;

    /// Distance from a point to the nearest segment, px. Infinity if there is no segment.
    double distance(const glm::dvec2& point) const;

private:
    struct Tree;
    std::unique_ptr<Tree> _tree;
};

} // namespace gnomon::metrics
