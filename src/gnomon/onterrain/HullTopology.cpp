// SPDX-License-Identifier: MIT
#include <gnomon/onterrain/HullTopology.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>

namespace gnomon {
namespace {

using Loop = std::vector<unsigned>;

/// A hull's flat faces as loops of corners, counter-clockwise from outside, and their planes.
struct Faces {
    std::vector<Loop> loops;
    std::vector<glm::dvec4> planes;
};

/// Flat faces whose edges are walked along; corners where the hull's are.
class Walk {
public:
    explicit Walk(const ConvexHull& hull) {
        for (const ConvexHull::Face& face : hull.faces) {
            const auto [known, isNew] =
                _numbers.try_emplace({face.plane.x, face.plane.y, face.plane.z}, _planes.size());
            if (isNew) _planes.push_back(face.plane);
            for (std::size_t i = 0; i < face.corners.size(); ++i)
                add(face.corners[i], face.corners[(i + 1) % face.corners.size()], known->second);
        }
    }
    /// From an edge of the largest face on, in an order that hulls alike share; empty if the edges are no surface's.
    Faces faces() const {
        Faces result;
        if (_planes.size() < 2 || !arrange(result)) return {};
        return result;
    }

private:
    struct Entry {
        std::size_t face;
        unsigned from;
    };

    /// An edge within a flat face has it on both sides: it is none.
    void add(unsigned from, unsigned to, std::size_t face) {
        const auto back = _edges.find({to, from});
        if (back != _edges.end() && back->second == face)
            _edges.erase(back);
        else
            _edges[{from, to}] = face;
    }
    bool arrange(Faces& result) const {
        std::map<std::pair<std::size_t, unsigned>, unsigned> next;
        std::vector<std::size_t> sizes(_planes.size());
        for (const auto& [edge, face] : _edges) next[{face, edge.first}] = edge.second, ++sizes[face];
        const auto largest = std::size_t(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
        const auto start = next.lower_bound({largest, 0u});
        std::vector<bool> seen(_planes.size());
        std::deque<Entry> queue{{largest, start->first.second}};
        seen[largest] = true;
        while (!queue.empty()) {
            const Entry entry = queue.front();
            queue.pop_front();
            Loop loop;
            for (unsigned at = entry.from; loop.empty() || at != entry.from;) {
                const auto found = next.find({entry.face, at});
                if (found == next.end() || loop.size() > sizes[entry.face]) return false;
                const auto twin = _edges.find({found->second, at});
                if (twin == _edges.end()) return false;
                if (!seen[twin->second]) queue.push_back({twin->second, found->second});
                seen[twin->second] = true;
                loop.push_back(at);
                at = found->second;
            }
            if (loop.size() != sizes[entry.face]) return false;
            result.loops.push_back(std::move(loop));
            result.planes.push_back(_planes[entry.face]);
        }
        return result.loops.size() == _planes.size();
    }

    std::map<std::array<double, 3>, std::size_t> _numbers;
    std::vector<glm::dvec4> _planes;
    std::map<std::pair<unsigned, unsigned>, std::size_t> _edges;
};

Faces asGiven(const ConvexHull& hull) {
    Faces result;
    for (const ConvexHull::Face& face : hull.faces) {
        result.loops.push_back(face.corners);
        result.planes.push_back(face.plane);
    }
    return result;
}

/// KeyNumbers corners anew, in the order in which the loops come to them. @return their places.
std::vector<glm::dvec3> renumber(Faces& faces, const std::vector<glm::dvec3>& vertices) {
    std::vector<glm::dvec3> corners;
    std::map<unsigned, unsigned> numbers;
    for (Loop& loop : faces.loops)
        for (unsigned& corner : loop) {
            const auto [known, isNew] = numbers.try_emplace(corner, unsigned(corners.size()));
            if (isNew) corners.push_back(vertices[corner]);
            corner = known->second;
        }
    return corners;
}

using Triple = std::array<unsigned, 3>;

double areaOf(const Triple& t, const std::vector<glm::dvec3>& corners) {
    return glm::length(glm::cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]));
}

/// Evenly round the loop, unless that is a sliver.
Triple tripleOf(const Loop& loop, const std::vector<glm::dvec3>& corners) {
    const std::size_t n = loop.size();
    const auto at = [&](std::size_t i) { return loop[i % n]; };
    Triple best{at(0), at(n / 3), at(2 * n / 3)};
    double most = 4.0 * areaOf(best, corners); // corners alike in all boxes are worth some area
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const Triple other{at(0), at(i), at(i + (n - i) / 2)}, next{at(i - 1), at(i), at(i + 1)};
        for (const Triple& t : {other, next}) {
            const double area = areaOf(t, corners);
            if (area > most) most = area, best = t;
        }
    }
    return best;
}

int faceOf(const std::vector<glm::dvec4>& planes, const glm::dvec4* front) {
    if (!front) return -1;
    const auto alike = [&](const auto& a, const auto& b) {
        return glm::dot(glm::dvec3(a), glm::dvec3(*front)) < glm::dot(glm::dvec3(b), glm::dvec3(*front));
    };
    return int(std::max_element(planes.begin(), planes.end(), alike) - planes.begin());
}

std::vector<HullTopology::Edge> edgesOf(const std::vector<Loop>& loops) {
    std::map<std::pair<unsigned, unsigned>, unsigned> faces;
    for (unsigned f = 0; f < loops.size(); ++f)
        for (std::size_t i = 0; i < loops[f].size(); ++i) faces[{loops[f][i], loops[f][(i + 1) % loops[f].size()]}] = f;
    std::vector<HullTopology::Edge> edges;
    for (const auto& [edge, face] : faces) {
        const auto twin = faces.find({edge.second, edge.first});
        if (twin == faces.end())
            edges.push_back({edge.first, edge.second, face, unsigned(loops.size())});
        else if (face < twin->second)
            edges.push_back({edge.first, edge.second, face, twin->second});
    }
    return edges;
}

/// All that a topology is made from.
using Key = std::vector<unsigned>;

Key keyOf(const std::vector<Loop>& loops, const std::vector<Triple>& triples, int front) {
    Key key{unsigned(front + 1)};
    for (std::size_t f = 0; f < loops.size(); ++f) {
        key.push_back(unsigned(loops[f].size()));
        key.insert(key.end(), loops[f].begin(), loops[f].end());
        key.insert(key.end(), triples[f].begin(), triples[f].end());
    }
    return key;
}

/// Those in use.
class Shared {
public:
    template <class Make>
    std::shared_ptr<const HullTopology> get(const Key& key, const Make& make) {
        const std::lock_guard<std::mutex> lock(_mutex);
        std::weak_ptr<const HullTopology>& known = _known[key];
        auto topology = known.lock();
        if (!topology) known = topology = make();
        if (_known.size() > _clean) forget();
        return topology;
    }

private:
    void forget() {
        for (auto it = _known.begin(); it != _known.end();)
            it = it->second.expired() ? _known.erase(it) : std::next(it);
        _clean = 2 * _known.size() + 64;
    }
    std::mutex _mutex;
    std::map<Key, std::weak_ptr<const HullTopology>> _known;
    std::size_t _clean = 64;
};

Shared& shared() {
    static Shared all;
    return all;
}

} // namespace

void HullTopology::silhouette(const char* lit, std::vector<unsigned>& found) const {
    thread_local std::vector<unsigned> next;
    next.assign(corners, corners);
    unsigned start = corners;
    for (const Edge& edge : edges) {
        if (lit[edge.left] == lit[edge.right]) continue;
        const unsigned from = lit[edge.left] ? edge.from : edge.to;
        next[from] = lit[edge.left] ? edge.to : edge.from;
        start = std::min(start, from);
    }
    found.clear();
    for (unsigned at = start; at != corners && found.size() < corners; at = next[at]) {
        found.push_back(at);
        if (next[at] == start) break;
    }
    if (found.size() < 3) found.clear();
}

void HullTopology::tabulate() {
    if (faces.size() > mostTabled || corners > 255) return;
    std::vector<unsigned> loop;
    for (unsigned bits = 0; bits < 1u << faces.size(); ++bits) {
        char lit[mostTabled + 1] = {};
        for (std::size_t f = 0; f < faces.size(); ++f) lit[f] = char(bits >> f & 1u);
        silhouette(lit, loop);
        for (const unsigned corner : loop) _loops.push_back(std::uint8_t(corner));
        _ends.push_back(std::uint16_t(_loops.size()));
    }
}

ArrangedHull::ArrangedHull(const ConvexHull& hull, const glm::dvec4* front) {
    Faces faces = Walk(hull).faces();
    if (faces.loops.empty()) faces = asGiven(hull);
    corners = renumber(faces, hull.vertices);
    if (corners.empty()) corners.emplace_back(0.0); // no hull
    std::vector<Triple> triples;
    for (const Loop& loop : faces.loops) triples.push_back(tripleOf(loop, corners));
    if (triples.size() == 2) triples[1] = {triples[0][0], triples[0][2], triples[0][1]}; // a plate's sides: one plane
    const int at = faceOf(faces.planes, front);
    topology = shared().get(keyOf(faces.loops, triples, at), [&] {
        auto made = std::make_shared<HullTopology>();
        made->corners = unsigned(corners.size());
        made->faces = triples;
        made->edges = edgesOf(faces.loops);
        made->front = at;
        made->tabulate();
        return made;
    });
}

} // namespace gnomon
