// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ClosedParts.h>
#include <gnomon/geometry/MeshEdges.h>

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <unordered_map>
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

constexpr double widest = 0.5;                 // a hole, of its part: about a wider one are most of the faces
constexpr std::size_t mostOpenEdges = 1 << 14; // of more, as leaves have, no holes and seams are closed

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
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) add(_corners[i], _corners[i + 1], _corners[i + 2], 1);
        for (const OpenEdge& edge : edges) _open[_sets.find(edge.low)] = true;
        if (!edges.empty() && edges.size() <= mostOpenEdges) findHoled(holesOf(edges, _sets, vertexCount));
    }

    void describe(ClosedParts& result) {
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) {
            const unsigned part = _sets.find(_corners[i]);
            result.part.push_back(part);
            result.closed.push_back(!_open[part] && _volume[part] > 0.0);
            result.holed.push_back(_holed.count(part) > 0);
        }
        result.holes = std::move(_fillings);
    }

private:
    glm::dvec3 at(unsigned vertex) const { return glm::dvec3(_positions[vertex]); }

    /// Six times the volume between the triangle and a vertex of the part: small numbers, whatever the part's place.
    void add(unsigned a, unsigned b, unsigned c, int times) {
        const unsigned part = _sets.find(a);
        const glm::dvec3 from = at(part);
        _volume[part] += times * glm::dot(at(a) - from, glm::cross(at(b) - from, at(c) - from));
    }

    void findHoled(const std::vector<Hole>& holes) {
        for (const Hole& hole : holes) {
            for (const OpenEdge& edge : hole.edges) add(hole.edges.front().low, edge.high, edge.low, edge.times);
            _holed.emplace(hole.part, Box());
        }
        for (const unsigned corner : _corners) {
            const auto found = _holed.find(_sets.find(corner));
            if (found != _holed.end()) found->second.add(at(corner));
        }
        for (const Hole& hole : holes)
            if (!(_volume[hole.part] > 0.0) || isWide(hole)) _holed.erase(hole.part);
        leaveOutWhatIsNoSheet();
        for (const Hole& hole : holes)
            if (_holed.count(hole.part) > 0) _fillings.push_back(hole.filling());
    }

    static bool isLine(const unsigned* corners) {
        return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    }

    bool isWide(const Hole& hole) const {
        const auto part = _holed.find(hole.part);
        Box box;
        for (const unsigned vertex : hole.filling()) box.add(at(vertex));
        return part == _holed.end() || box.length() > widest * part->second.length();
    }

    /// In a sheet each triangle is joined to all others over edges that two have: what is joined otherwise, a bowl to a post,
    /// may be one body inside out and another that is not.
    void leaveOutWhatIsNoSheet() {
        struct Side {
            std::uint64_t ends;
            unsigned triangle;
        };
        std::vector<Side> sides;
        for (std::size_t i = 0; i + 2 < _corners.size(); i += 3) {
            if (_holed.count(_sets.find(_corners[i])) == 0 || isLine(&_corners[i])) continue;
            for (std::size_t side = 0; side < 3; ++side)
                sides.push_back({edge(_corners[i + side], _corners[i + (side + 1) % 3]).ends, unsigned(i / 3)});
        }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
        Sets sheets(_corners.size() / 3);
        const auto partOf = [this](unsigned triangle) { return _sets.find(_corners[3 * std::size_t(triangle)]); };
        for (std::size_t i = 0, end; i < sides.size(); i = end) {
            for (end = i + 1; end < sides.size() && sides[end].ends == sides[i].ends;) ++end;
            if (end - i == 2) sheets.join(sides[i].triangle, sides[i + 1].triangle);
            if (end - i > 2) _holed.erase(partOf(sides[i].triangle));
        }
        std::unordered_map<unsigned, unsigned> sheetOf;
        for (const Side& side : sides) {
            const unsigned part = partOf(side.triangle), sheet = sheets.find(side.triangle);
            if (sheetOf.emplace(part, sheet).first->second != sheet) _holed.erase(part);
        }
    }

    const glm::vec3* _positions;
    const std::vector<unsigned> _corners;
    Sets _sets;
    std::vector<double> _volume; ///< of each part, six times that, with its holes filled.
    std::vector<bool> _open;
    std::unordered_map<unsigned, Box> _holed; ///< bounds of those parts that have holes.
    std::vector<std::vector<unsigned>> _fillings;
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
