// SPDX-License-Identifier: MIT
#include <gnomon/geometry/MeshEdges.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace gnomon {
namespace {

template <class Position>
std::vector<unsigned> welded(const Position* positions, std::size_t count) {
    std::vector<unsigned> order(count);
    std::iota(order.begin(), order.end(), 0u);
    tbb::parallel_sort(order.begin(), order.end(), [positions](unsigned a, unsigned b) {
        const Position &p = positions[a], &q = positions[b];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
    });
    std::vector<unsigned> first(count);
    for (std::size_t i = 0; i < count; ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

std::vector<Edge> sortedEdges(const std::vector<unsigned>& corners) {
    std::vector<Edge> edges;
    edges.reserve(corners.size());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        for (std::size_t side = 0; side < 3; ++side) {
            const unsigned from = corners[i + side], to = corners[i + (side + 1) % 3];
            if (from != to) edges.push_back(edge(from, to));
        }
    tbb::parallel_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
    return edges;
}

/// Cells of a grid by what they hold; a cell is several times as wide as what counts as one place.
class Cells {
public:
    Cells(const std::vector<glm::dvec3>& points, double reach) : _points(points), _reach(reach) {}

    /// The first of those asked for that is about a point; itself if there is none.
    unsigned placeOf(unsigned i) {
        const glm::dvec3 &p = _points[i], first = cell(p - _reach), last = cell(p + _reach);
        for (double x = first.x; x <= last.x; ++x)
            for (double y = first.y; y <= last.y; ++y)
                for (double z = first.z; z <= last.z; ++z)
                    if (const auto found = findIn({x, y, z}, p)) return *found;
        _places.emplace(keyOf(cell(p)), i);
        return i;
    }

private:
    glm::dvec3 cell(const glm::dvec3& place) const { return glm::floor(place / (16.0 * _reach)); }
    std::optional<unsigned> findIn(const glm::dvec3& cell, const glm::dvec3& place) const {
        const auto [begin, end] = _places.equal_range(keyOf(cell));
        for (auto at = begin; at != end; ++at)
            if (glm::distance(_points[at->second], place) <= _reach) return at->second;
        return std::nullopt;
    }
    static std::uint64_t keyOf(const glm::dvec3& cell) {
        const auto whole = [](double number) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(number)); };
        return (whole(cell.x) * 73856093u) ^ (whole(cell.y) * 19349663u) ^ (whole(cell.z) * 83492791u);
    }

    const std::vector<glm::dvec3>& _points;
    const double _reach;
    std::unordered_multimap<std::uint64_t, unsigned> _places;
};

/// What float can tell apart, some steps of it, where most of these are.
double roundingOf(const std::vector<glm::dvec3>& places) {
    std::vector<double> reaches;
    for (const glm::dvec3& place : places)
        reaches.push_back(std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}));
    const auto middle = reaches.begin() + static_cast<std::ptrdiff_t>(reaches.size() / 2);
    std::nth_element(reaches.begin(), middle, reaches.end());
    return 4.0 * std::numeric_limits<float>::epsilon() * *middle;
}

} // namespace

std::vector<unsigned> weld(const glm::vec3* positions, std::size_t count) { return welded(positions, count); }
std::vector<unsigned> weld(const glm::dvec3* positions, std::size_t count) { return welded(positions, count); }

Edge edge(unsigned from, unsigned to) {
    const std::uint64_t low = std::min(from, to), high = std::max(from, to);
    return {low << 32 | high, from < to ? 1 : -1};
}

std::vector<OpenEdge> openEdges(const std::vector<unsigned>& corners) {
    const std::vector<Edge> edges = sortedEdges(corners);
    std::vector<OpenEdge> open;
    for (std::size_t i = 0; i < edges.size();) {
        int sum = 0;
        const std::uint64_t ends = edges[i].ends;
        for (; i < edges.size() && edges[i].ends == ends; ++i) sum += edges[i].direction;
        if (sum != 0)
            open.push_back({static_cast<unsigned>(ends >> 32), static_cast<unsigned>(ends & 0xffffffffu), sum});
    }
    return open;
}

std::vector<unsigned> nearlyTheSame(const std::vector<glm::dvec3>& points, double reach) {
    std::vector<unsigned> result;
    if (!(reach > 0.0)) {
        result.resize(points.size());
        std::iota(result.begin(), result.end(), 0u);
        return result;
    }
    Cells cells(points, reach);
    for (unsigned i = 0; i < points.size(); ++i) result.push_back(cells.placeOf(i));
    return result;
}

std::vector<unsigned> withoutSeams(const std::vector<unsigned>& ends, const glm::vec3* positions,
                                   std::size_t vertexCount) {
    if (ends.empty()) return {};
    std::vector<glm::dvec3> points;
    for (const unsigned end : ends) points.emplace_back(positions[end]);
    const std::vector<unsigned> same = nearlyTheSame(points, roundingOf(points));
    std::vector<unsigned> first(vertexCount);
    std::iota(first.begin(), first.end(), 0u);
    bool any = false;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        first[ends[i]] = ends[same[i]];
        any = any || same[i] != i;
    }
    return any ? first : std::vector<unsigned>();
}

} // namespace gnomon
