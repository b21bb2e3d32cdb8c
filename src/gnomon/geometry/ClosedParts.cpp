// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ClosedParts.h>
#include <gnomon/geometry/MeshEdges.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace gnomon {
namespace {

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

constexpr std::size_t mostOpenEdges = 1 << 14; // of more, as leaves have, no seams are closed

/// The triangles of all parts, over welded vertices.
class Parts {
public:
    Parts(const glm::vec3* positions, std::size_t vertexCount, std::vector<unsigned> corners,
          const std::vector<OpenEdge>& edges)
        : _positions(positions),
          _corners(std::move(corners)),
          _sets(vertexCount),
          _volume(vertexCount, 0.0),
          _open(vertexCount, false) {
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) {
            _sets.join(_corners[i], _corners[i + 1]);
            _sets.join(_corners[i], _corners[i + 2]);
        }
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) add(_corners[i], _corners[i + 1], _corners[i + 2]);
        for (const OpenEdge& edge : edges) _open[_sets.find(edge.low)] = true;
    }

    void describe(ClosedParts& result) {
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) {
            const unsigned part = _sets.find(_corners[i]);
            result.part.push_back(part);
            result.closed.push_back(!_open[part] && _volume[part] > 0.0);
        }
    }

private:
    glm::dvec3 at(unsigned vertex) const { return glm::dvec3(_positions[vertex]); }

    /// Six times the volume between the triangle and a vertex of the part: small numbers, whatever the part's place.
    void add(unsigned a, unsigned b, unsigned c) {
        const unsigned part = _sets.find(a);
        const glm::dvec3 from = at(part);
        _volume[part] += glm::dot(at(a) - from, glm::cross(at(b) - from, at(c) - from));
    }

    const glm::vec3* _positions;
    const std::vector<unsigned> _corners;
    Sets _sets;
    std::vector<double> _volume; ///< of each part, six times that.
    std::vector<bool> _open;
};

/// Each once.
std::vector<unsigned> endsOf(const std::vector<OpenEdge>& edges) {
    std::vector<unsigned> ends;
    for (const OpenEdge& edge : edges) ends.insert(ends.end(), {edge.low, edge.high});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

} // namespace

ClosedParts closedParts(const glm::vec3* positions, std::size_t vertexCount, const unsigned* indices,
                        std::size_t indexCount, bool overSeams) {
    ClosedParts result;
    result.welded = weld(positions, vertexCount);
    std::vector<unsigned> corners(indexCount);
    for (std::size_t i = 0; i < indexCount; ++i) corners[i] = result.welded[indices[i]];
    std::vector<OpenEdge> open = openEdges(corners);
    const std::vector<unsigned> first = overSeams && open.size() <= mostOpenEdges
                                            ? withoutSeams(endsOf(open), positions, vertexCount)
                                            : std::vector<unsigned>();
    if (!first.empty()) {
        for (unsigned& corner : corners) corner = first[corner];
        open = openEdges(corners);
    }
    Parts(positions, vertexCount, std::move(corners), open).describe(result);
    return result;
}

} // namespace gnomon
