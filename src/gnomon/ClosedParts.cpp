// SPDX-License-Identifier: MIT
#include <gnomon/ClosedParts.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>

namespace gnomon {
namespace {

std::vector<unsigned> weld(const glm::vec3* positions, std::size_t count) {
    std::vector<unsigned> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [positions](unsigned a, unsigned b) {
        const glm::vec3 &p = positions[a], &q = positions[b];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
    });
    std::vector<unsigned> welded(count);
    for (std::size_t i = 0; i < count; ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        welded[order[i]] = same ? welded[order[i - 1]] : order[i];
    }
    return welded;
}

/// Disjoint sets of vertices with path halving.
class Sets {
public:
    explicit Sets(std::size_t count) : _parent(count) { std::iota(_parent.begin(), _parent.end(), 0u); }
    unsigned find(unsigned i) {
        while (_parent[i] != i) i = _parent[i] = _parent[_parent[i]];
        return i;
    }
    void join(unsigned a, unsigned b) { _parent[find(a)] = find(b); }

private:
    std::vector<unsigned> _parent;
};

/// An edge without its direction, and +1 or -1 for it; (lower vertex, higher vertex) in one word.
struct Edge {
    std::uint64_t ends;
    int direction;
};

Edge edge(unsigned from, unsigned to) {
    const std::uint64_t low = std::min(from, to), high = std::max(from, to);
    return {low << 32 | high, from < to ? 1 : -1};
}

std::vector<Edge> sortedEdges(const std::vector<unsigned>& corners) {
    std::vector<Edge> edges;
    edges.reserve(corners.size());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        for (std::size_t side = 0; side < 3; ++side) {
            const unsigned from = corners[i + side], to = corners[i + (side + 1) % 3];
            if (from != to) edges.push_back(edge(from, to));
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
    return edges;
}

/// Marks the parts that have an edge passed more often one way than the other.
void markOpen(const std::vector<Edge>& edges, Sets& parts, std::vector<bool>& open) {
    for (std::size_t i = 0; i < edges.size();) {
        int sum = 0;
        const std::uint64_t ends = edges[i].ends;
        for (; i < edges.size() && edges[i].ends == ends; ++i) sum += edges[i].direction;
        if (sum != 0) open[parts.find(static_cast<unsigned>(ends & 0xffffffffu))] = true;
    }
}

} // namespace

ClosedParts closedParts(const glm::vec3* positions, std::size_t vertexCount, const unsigned* indices,
                        std::size_t indexCount) {
    ClosedParts result;
    result.welded = weld(positions, vertexCount);
    std::vector<unsigned> corners(indexCount);
    for (std::size_t i = 0; i < indexCount; ++i) corners[i] = result.welded[indices[i]];
    Sets parts(vertexCount);
    for (std::size_t i = 0; i + 2 < indexCount; i += 3) {
        parts.join(corners[i], corners[i + 1]);
        parts.join(corners[i], corners[i + 2]);
    }
    std::vector<bool> open(vertexCount, false);
    markOpen(sortedEdges(corners), parts, open);
    std::vector<double> volume(vertexCount, 0.0);
    for (std::size_t i = 0; i + 2 < indexCount; i += 3) {
        const unsigned part = parts.find(corners[i]);
        const glm::dvec3 from(positions[part]); // a vertex of the part: small numbers, whatever the part's place
        const auto arm = [&](std::size_t corner) { return glm::dvec3(positions[corners[corner]]) - from; };
        volume[part] += glm::dot(arm(i), glm::cross(arm(i + 1), arm(i + 2)));
    }
    for (std::size_t i = 0; i + 2 < indexCount; i += 3) {
        const unsigned part = parts.find(corners[i]);
        result.part.push_back(part);
        result.closed.push_back(!open[part] && volume[part] > 0.0);
    }
    return result;
}

} // namespace gnomon
