// SPDX-License-Identifier: MIT
#include <metrics/NearestSegment.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <nanoflann.hpp>

namespace gnomon::metrics {
namespace {

/// Half the diagonal of a pixel: how far a segment reaches from its middle.
constexpr double reach = 0.70710678118654757;

/// What nanoflann asks of a set of points: here the segments' middles.
struct Middles {
    const std::vector<Segment>& segments;

    std::size_t kdtree_get_point_count() const { return segments.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        const int a = static_cast<int>(axis);
        return 0.5 * (segments[i].from[a] + segments[i].to[a]);
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// What nanoflann asks of a result: the nearest segment so far, to whose distance `reach` must be added before a middle
/// is too far away to matter.
struct Nearest {
    using DistanceType = double;

    const std::vector<Segment>& segments;
    const glm::dvec2& point;
    double best = std::numeric_limits<double>::infinity();

    std::size_t size() const { return 1; }
    bool full() const { return best < std::numeric_limits<double>::infinity(); }
    double worstDist() const { return (best + reach) * (best + reach); }
    bool addPoint(double, std::size_t i) {
        best = std::min(best, distance(segments[i], point));
        return true;
    }
    void sort() {} // there is one; nanoflann asks since 1.5
};

using Index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Middles>, Middles, 2, std::size_t>;

} // namespace

struct NearestSegment::Tree {
    explicit Tree(const std::vector<Segment>& all) : segments(all), middles{segments}, index(2, middles) {}
    const std::vector<Segment>& segments;
    Middles middles;
    Index index;
};

NearestSegment::NearestSegment(const std::vector<Segment>& segments) : _tree(std::make_unique<Tree>(segments)) {}
NearestSegment::~NearestSegment() = default;

double NearestSegment::distance(const glm::dvec2& point) const {
    Nearest nearest{_tree->segments, point};
    if (!_tree->segments.empty()) _tree->index.findNeighbors(nearest, glm::value_ptr(point), {});
    return nearest.best;
}

} // namespace gnomon::metrics
