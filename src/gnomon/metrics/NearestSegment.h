// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/IsoLine.h>
#include <memory>

namespace gnomon::metrics {

/// Distance to the nearest of many short segments. Exact; about a microsecond a question, by a k-d tree of middles.
class NearestSegment {
public:
    /// @param segments  each at most √2 px long, as isoLine() makes them. Must outlive this.
    explicit NearestSegment(const std::vector<Segment>& segments);
    ~NearestSegment();
    NearestSegment(const NearestSegment&) = delete;
    NearestSegment& operator=(const NearestSegment&) = delete;

    /// px; infinity if there is no segment.
    double distance(const glm::dvec2& point) const;

private:
    struct Tree;
    std::unique_ptr<Tree> _tree;
};

} // namespace gnomon::metrics
