// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/IsoLine.h>
#include <memory>

namespace gnomon::metrics {

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
