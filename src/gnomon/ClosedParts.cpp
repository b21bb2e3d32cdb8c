// SPDX-License-Identifier: MIT
#include <gnomon/ClosedParts.h>

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

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

/// An edge that is passed more often from its lower vertex to its higher one than back, by `times`; below 0 less often.
struct OpenEdge {
    unsigned low, high;
    int times;
};

std::vector<OpenEdge> openEdges(const std::vector<Edge>& edges) {
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

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high = -low;

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    double length() const { return glm::distance(low, high); }
};

/// Where open edges connect its rim. It is filled by triangles from one vertex of the rim to each of these edges.
struct Hole {
    unsigned part;
    std::vector<OpenEdge> edges;

    /// Three vertices each; one where the rim is passed `times` in the other direction.
    std::vector<unsigned> filling() const {
        std::vector<unsigned> corners;
        for (const OpenEdge& edge : edges) {
            const bool rises = edge.times > 0;
            corners.insert(corners.end(),
                           {edges.front().low, rises ? edge.high : edge.low, rises ? edge.low : edge.high});
        }
        return corners;
    }
};

std::vector<Hole> holesOf(const std::vector<OpenEdge>& open, Sets& parts, std::size_t vertexCount) {
    std::vector<Hole> holes;
    if (open.empty()) return holes;
    Sets rims(vertexCount);
    for (const OpenEdge& edge : open) rims.join(edge.low, edge.high);
    std::unordered_map<unsigned, std::size_t> holeOf;
    for (const OpenEdge& edge : open) {
        const auto [found, isNew] = holeOf.emplace(rims.find(edge.low), holes.size());
        if (isNew) holes.push_back({parts.find(edge.low), {}});
        holes[found->second].edges.push_back(edge);
    }
    return holes;
}

constexpr double widest = 0.5; // a hole, of its part: about a wider one are most of the faces

/// The triangles of all parts, over welded vertices.
class Parts {
public:
    Parts(const glm::vec3* positions, std::size_t vertexCount, std::vector<unsigned> corners)
        : _positions(positions), _corners(std::move(corners)), _sets(vertexCount), _volume(vertexCount, 0.0) {
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) {
            _sets.join(_corners[i], _corners[i + 1]);
            _sets.join(_corners[i], _corners[i + 2]);
        }
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) add(_corners[i], _corners[i + 1], _corners[i + 2], 1);
        _holes = holesOf(openEdges(sortedEdges(_corners)), _sets, vertexCount);
        for (const Hole& hole : _holes) {
            for (const OpenEdge& edge : hole.edges) add(hole.edges.front().low, edge.high, edge.low, edge.times);
            _open.emplace(hole.part, Box());
        }
        measureOpen();
    }

    void describe(ClosedParts& result) {
        for (const Hole& hole : _holes)
            if (isWide(hole)) _wide.insert(hole.part);
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) {
            const unsigned part = _sets.find(_corners[i]);
            const bool isOpen = _open.count(part) > 0, isOutward = _volume[part] > 0.0;
            result.part.push_back(part);
            result.closed.push_back(isOutward && !isOpen);
            result.holed.push_back(isOutward && isOpen && _wide.count(part) == 0);
        }
        for (const Hole& hole : _holes)
            if (_volume[hole.part] > 0.0 && _wide.count(hole.part) == 0) result.holes.push_back(hole.filling());
    }

private:
    glm::dvec3 at(unsigned vertex) const { return glm::dvec3(_positions[vertex]); }

    /// Six times the volume between the triangle and a vertex of the part: small numbers, whatever the part's place.
    void add(unsigned a, unsigned b, unsigned c, int times) {
        const unsigned part = _sets.find(a);
        const glm::dvec3 from = at(part);
        _volume[part] += times * glm::dot(at(a) - from, glm::cross(at(b) - from, at(c) - from));
    }

    void measureOpen() {
        if (_open.empty()) return;
        for (const unsigned corner : _corners) {
            const auto found = _open.find(_sets.find(corner));
            if (found != _open.end()) found->second.add(at(corner));
        }
    }

    bool isWide(const Hole& hole) const {
        Box box;
        for (const unsigned vertex : hole.filling()) box.add(at(vertex));
        return box.length() > widest * _open.at(hole.part).length();
    }

    const glm::vec3* _positions;
    const std::vector<unsigned> _corners;
    Sets _sets;
    std::vector<double> _volume; ///< of each part, six times that.
    std::vector<Hole> _holes;
    std::unordered_map<unsigned, Box> _open;
    std::unordered_set<unsigned> _wide;
};

} // namespace

ClosedParts closedParts(const glm::vec3* positions, std::size_t vertexCount, const unsigned* indices,
                        std::size_t indexCount) {
    ClosedParts result;
    result.welded = weld(positions, vertexCount);
    std::vector<unsigned> corners(indexCount);
    for (std::size_t i = 0; i < indexCount; ++i) corners[i] = result.welded[indices[i]];
    Parts(positions, vertexCount, std::move(corners)).describe(result);
    return result;
}

} // namespace gnomon
