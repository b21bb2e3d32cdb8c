// SPDX-License-Identifier: MIT
#include <gnomon/geometry/MeshEdges.h>

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>

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

} // namespace gnomon
