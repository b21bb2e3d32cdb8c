// SPDX-License-Identifier: MIT
#include <gnomon/geometry/MeshEdges.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

namespace gnomon {
namespace {

using Edge = SilhouetteMesh::Edge;
using Part = SilhouetteMesh::Part;

/// Of a place without -0.
std::size_t hashOf(const glm::vec3& place) {
    std::uint32_t bits[3];
    std::memcpy(bits, &place, sizeof bits);
    const std::uint64_t key = bits[0] + 0x10001u * std::uint64_t(bits[1]) + 0x100000007u * std::uint64_t(bits[2]);
    return std::size_t((key ^ key >> 29) * 0x9E3779B97F4A7C15u >> 20);
}

/// Numbers of the vertices' places, in the order in which they come; -0 is 0. A table without memory of its own for each.
std::vector<unsigned> weldInto(std::vector<glm::vec3>& places, const glm::vec3* positions, std::size_t count) {
    constexpr unsigned none = ~0u;
    std::size_t size = 16;
    while (size < 2 * count) size *= 2;
    std::vector<unsigned> slots(size, none), result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 place = positions[i] + 0.0f;
        std::size_t at = hashOf(place) & (size - 1);
        while (slots[at] != none && places[slots[at]] != place) at = (at + 1) & (size - 1);
        if (slots[at] == none) {
            slots[at] = unsigned(places.size());
            places.push_back(place);
        }
        result[i] = slots[at];
    }
    return result;
}

/// At each place one for all: several drawables, or the two sides of a seam, may meet there.
std::vector<glm::vec4> largestAt(const std::vector<unsigned>& places, const glm::vec4* offsets, std::size_t count) {
    std::vector<glm::vec4> result(count, glm::vec4(0.0f));
    for (std::size_t i = 0; i < places.size(); ++i)
        if (offsets[i].w > result[places[i]].w) result[places[i]] = offsets[i];
    return result;
}

/// Three places in `vertices` a triangle, but for triangles with two corners in one. @param sources  gets their numbers.
std::vector<unsigned> triangleCorners(const std::vector<unsigned>& places, const unsigned* corners, std::size_t count,
                                      std::vector<std::size_t>& sources) {
    std::vector<unsigned> found;
    found.reserve(count);
    sources.clear();
    for (std::size_t i = 0; i + 2 < count; i += 3) {
        const unsigned a = places[corners[i]], b = places[corners[i + 1]], c = places[corners[i + 2]];
        if (a == b || b == c || c == a) continue;
        found.insert(found.end(), {a, b, c});
        sources.push_back(i / 3);
    }
    return found;
}

/// A side of a triangle, below its lower vertex.
struct Side {
    unsigned high;
    unsigned triangle;
    bool up; ///< from the lower vertex to the higher one.
};

/// The sides of all triangles by their lower vertex, those of one edge one after the other.
class Sides {
public:
    Sides(const std::vector<unsigned>& corners, std::size_t vertices) : _first(vertices + 1, 0) {
        forEach(corners, [this](unsigned low, const Side&) { ++_first[low + 1]; });
        std::partial_sum(_first.begin(), _first.end(), _first.begin());
        _all.resize(_first.back());
        std::vector<unsigned> next(_first.begin(), _first.end() - 1);
        forEach(corners, [&](unsigned low, const Side& side) { _all[next[low]++] = side; });
        for (std::size_t i = 0; i < vertices; ++i)
            std::sort(_all.begin() + _first[i], _all.begin() + _first[i + 1], [](const Side& a, const Side& b) {
                return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
            });
    }

    /// @param take  of the lower vertex, and the first and the end of the sides of one edge.
    template <class Take>
    void forEachEdge(Take take) const {
        for (std::size_t low = 0; low + 1 < _first.size(); ++low)
            for (unsigned i = _first[low], end = i; i < _first[low + 1]; i = end) {
                while (end < _first[low + 1] && _all[end].high == _all[i].high) ++end;
                take(static_cast<unsigned>(low), _all.data() + i, _all.data() + end);
            }
    }

private:
    template <class Take>
    static void forEach(const std::vector<unsigned>& corners, Take take) {
        for (std::size_t i = 0; i < corners.size(); i += 3)
            for (std::size_t side = 0; side < 3; ++side) {
                const unsigned from = corners[i + side], to = corners[i + (side + 1) % 3];
                take(std::min(from, to), Side{std::max(from, to), static_cast<unsigned>(i / 3), from < to});
            }
    }

    std::vector<unsigned> _first;
    std::vector<Side> _all;
};

/// Ends of edges that are passed more often one way than the other; each once.
std::vector<unsigned> openEnds(const Sides& sides, std::size_t vertices) {
    std::vector<bool> open(vertices);
    sides.forEachEdge([&](unsigned low, const Side* first, const Side* end) {
        const auto ups = std::count_if(first, end, [](const Side& side) { return side.up; });
        if (2 * ups != end - first) open[low] = open[first->high] = true;
    });
    std::vector<unsigned> found;
    for (unsigned i = 0; i < vertices; ++i)
        if (open[i]) found.push_back(i);
    return found;
}

/// @return true if there are any seams.
bool closeSeams(const Sides& sides, const std::vector<glm::vec3>& vertices, std::vector<unsigned>& places) {
    const std::vector<unsigned> first =
        withoutSeams(openEnds(sides, vertices.size()), vertices.data(), vertices.size());
    if (first.empty()) return false;
    for (unsigned& place : places) place = first[place];
    return true;
}

/// Sets of triangles, of which two can be joined.
class Sets {
public:
    explicit Sets(std::size_t count) : _parents(count) { std::iota(_parents.begin(), _parents.end(), 0u); }
    unsigned of(unsigned i) {
        while (_parents[i] != i) i = _parents[i] = _parents[_parents[i]];
        return i;
    }
    void join(unsigned a, unsigned b) { _parents[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

private:
    std::vector<unsigned> _parents;
};

/// Pairs each side with one of the other direction, as far as there are any.
std::vector<Edge> pairSides(const Sides& sides, std::size_t triangles, Sets& connected) {
    std::vector<Edge> edges;
    edges.reserve(triangles * 3 / 2);
    const auto none = static_cast<unsigned>(triangles);
    std::vector<unsigned> ups, downs;
    sides.forEachEdge([&](unsigned low, const Side* first, const Side* end) {
        ups.clear();
        downs.clear();
        for (const Side* side = first; side != end; ++side) {
            (side->up ? ups : downs).push_back(side->triangle);
            connected.join(first->triangle, side->triangle);
        }
        for (std::size_t i = 0; i < std::max(ups.size(), downs.size()); ++i) {
            const unsigned left = i < ups.size() ? ups[i] : none, right = i < downs.size() ? downs[i] : none;
            if (left == none)
                edges.push_back({first->high, low, right, none});
            else
                edges.push_back({low, first->high, left, right});
        }
    });
    return edges;
}

/// Bits of a number with two zeros between each.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x1f00000000ffffu;
    x = (x | x << 16) & 0x1f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
}

/// Along a curve on which neighbours in space are mostly near (G. Morton, 1966).
std::vector<unsigned> alongCurve(const std::vector<Part>& parts) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const Part& part : parts) low = glm::min(low, part.low), high = glm::max(high, part.high);
    const glm::dvec3 size = glm::max(glm::dvec3(high) - glm::dvec3(low), glm::dvec3(1e-300));
    std::vector<std::uint64_t> keys;
    for (const Part& part : parts) {
        const glm::dvec3 at = ((glm::dvec3(part.low) + glm::dvec3(part.high)) / 2.0 - glm::dvec3(low)) / size;
        const auto key = [](double share) { return spread(static_cast<std::uint64_t>(share * 0xfffff)); };
        keys.push_back(key(at.x) | key(at.y) << 1 | key(at.z) << 2);
    }
    std::vector<unsigned> order(parts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&keys](unsigned a, unsigned b) { return keys[a] < keys[b]; });
    return order;
}

/// Numbers from 0 on of the connected sets.
std::vector<unsigned> numberParts(Sets& connected, std::size_t triangles, std::size_t& count) {
    std::vector<unsigned> numbers(triangles);
    count = 0;
    for (unsigned i = 0; i < triangles; ++i) {
        const unsigned first = connected.of(i);
        numbers[i] = first == i ? static_cast<unsigned>(count++) : numbers[first];
    }
    return numbers;
}

/// Where each goes so that those of lower keys come first.
template <class KeyOf>
std::vector<unsigned> placesBy(std::size_t count, std::size_t keys, KeyOf keyOf) {
    std::vector<unsigned> next(keys + 1, 0), places(count);
    for (std::size_t i = 0; i < count; ++i) ++next[keyOf(i) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (std::size_t i = 0; i < count; ++i) places[i] = next[keyOf(i)]++;
    return places;
}

struct Corners {
    glm::dvec3 a, b, c;
};

Corners cornersOf(const SilhouetteMesh& mesh, std::size_t triangle) {
    const unsigned* corners = mesh.corners.data() + 3 * triangle;
    return {glm::dvec3(mesh.vertices[corners[0]]), glm::dvec3(mesh.vertices[corners[1]]),
            glm::dvec3(mesh.vertices[corners[2]])};
}

/// Height over the longest side, as a share of the rounding of its corners.
constexpr double thinnest = 4.0 * std::numeric_limits<float>::epsilon();

void addPlane(SilhouetteMesh& mesh, std::size_t triangle) {
    const auto [a, b, c] = cornersOf(mesh, triangle);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    const glm::dvec3 unit = length > 0.0 ? normal / length : glm::dvec3(0.0);
    mesh.planeX.push_back(unit.x);
    mesh.planeY.push_back(unit.y);
    mesh.planeZ.push_back(unit.z);
    mesh.planeD.push_back(-glm::dot(unit, (a + b + c) / 3.0));
}

bool isThin(const SilhouetteMesh& mesh, std::size_t triangle) {
    const auto [a, b, c] = cornersOf(mesh, triangle);
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    const double reach = std::max({glm::length(a), glm::length(b), glm::length(c)});
    return glm::length(glm::cross(b - a, c - a)) <= thinnest * longest * reach;
}

/// Turned outward, its volume is positive.
double volumeOf(const SilhouetteMesh& mesh, const Part& part) {
    const glm::dvec3 about(part.low);
    double volume = 0.0;
    for (unsigned i = 0; i < part.triangles; ++i) {
        const auto [a, b, c] = cornersOf(mesh, part.firstTriangle + i);
        volume += glm::dot(a - about, glm::cross(b - about, c - about));
    }
    return volume;
}

/// Beyond the longest edge of a thin triangle is one that is less thin, or none.
void findThin(SilhouetteMesh& mesh) {
    std::vector<bool> thin(mesh.triangles());
    for (std::size_t i = 0; i < mesh.triangles(); ++i) thin[i] = isThin(mesh, i);
    std::vector<double> lengths(mesh.triangles(), -1.0);
    std::vector<unsigned> beyond(mesh.triangles(), SilhouetteMesh::noTriangle);
    for (const Edge& edge : mesh.edges) {
        if (edge.left == mesh.triangles() || edge.right == mesh.triangles()) continue;
        const double length = glm::distance(mesh.vertices[edge.from], mesh.vertices[edge.to]);
        for (const auto& [one, other] : {std::pair(edge.left, edge.right), std::pair(edge.right, edge.left)})
            if (thin[one] && length > lengths[one]) lengths[one] = length, beyond[one] = other;
    }
    for (unsigned i = 0; i < mesh.triangles(); ++i) {
        unsigned like = i;
        for (int steps = 0; steps < 16 && like != SilhouetteMesh::noTriangle && thin[like]; ++steps)
            like = beyond[like];
        if (like != i && like != SilhouetteMesh::noTriangle && !thin[like]) mesh.thin.push_back({i, like});
    }
}

void expand(Part& part, const glm::vec3& place) {
    part.low = glm::min(part.low, place);
    part.high = glm::max(part.high, place);
}

/// Numbers of parts along the curve, in place of the first ones.
std::vector<Part> putInOrder(std::vector<Part> parts, std::vector<unsigned>& partOf) {
    const std::vector<unsigned> order = alongCurve(parts);
    std::vector<unsigned> numbers(parts.size());
    std::vector<Part> result;
    for (const unsigned i : order) {
        numbers[i] = static_cast<unsigned>(result.size());
        result.push_back(parts[i]);
    }
    for (unsigned& part : partOf) part = numbers[part];
    return result;
}

} // namespace

bool SilhouetteMesh::Part::boundsHold(const glm::dvec3& place) const {
    return glm::all(glm::lessThanEqual(glm::dvec3(low), place)) &&
           glm::all(glm::lessThanEqual(place, glm::dvec3(high)));
}

SilhouetteMesh::SilhouetteMesh(const Source& source) {
    std::vector<unsigned> places = weldInto(vertices, source.positions, source.count);
    std::vector<std::size_t> sources;
    std::vector<unsigned> found = triangleCorners(places, source.corners, source.cornerCount, sources);
    Sides sides(found, vertices.size());
    if (closeSeams(sides, vertices, places)) {
        found = triangleCorners(places, source.corners, source.cornerCount, sources);
        sides = Sides(found, vertices.size());
    }
    if (source.offsets) offsets = largestAt(places, source.offsets, vertices.size());
    const std::size_t total = found.size() / 3;
    Sets connected(total);
    std::vector<Edge> pairs = pairSides(sides, total, connected);
    std::size_t partCount = 0;
    std::vector<unsigned> partOf = numberParts(connected, total, partCount);

    constexpr float most = std::numeric_limits<float>::max();
    parts.assign(partCount, {0, 0, 0, 0, true, false, glm::vec3(most), glm::vec3(-most), 0, false});
    for (std::size_t i = 0; i < found.size(); ++i) {
        Part& part = parts[partOf[i / 3]];
        expand(part, vertices[found[i]]);
        part.smooth = part.smooth || (!offsets.empty() && offsets[found[i]].w > 0.0f);
    }
    for (std::size_t i = 0; source.kinds && i < total; ++i) parts[partOf[i]].kinds |= source.kinds[sources[i]];
    parts = putInOrder(std::move(parts), partOf);

    const std::vector<unsigned> triangleAt = placesBy(total, partCount, [&](std::size_t i) { return partOf[i]; });
    corners.resize(found.size());
    for (std::size_t i = 0; i < total; ++i) {
        ++parts[partOf[i]].triangles;
        std::copy_n(found.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                    corners.begin() + 3 * std::ptrdiff_t(triangleAt[i]));
    }
    const auto partOfEdge = [&](std::size_t i) { return partOf[pairs[i].left]; };
    const std::vector<unsigned> edgeAt = placesBy(pairs.size(), partCount, partOfEdge);
    edges.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Edge& edge = pairs[i];
        Part& part = parts[partOfEdge(i)];
        const bool open = edge.right == total;
        ++part.edges;
        part.closed = part.closed && !open;
        edges[edgeAt[i]] = {edge.from, edge.to, triangleAt[edge.left], open ? edge.right : triangleAt[edge.right]};
    }
    for (std::size_t i = 1; i < partCount; ++i) {
        parts[i].firstTriangle = parts[i - 1].firstTriangle + parts[i - 1].triangles;
        parts[i].firstEdge = parts[i - 1].firstEdge + parts[i - 1].edges;
    }
    for (std::size_t i = 0; i < total; ++i) addPlane(*this, i);
    for (const Part& part : parts) {
        low = &part == &parts.front() ? part.low : glm::min(low, part.low);
        high = &part == &parts.front() ? part.high : glm::max(high, part.high);
    }
    for (Part& part : parts) part.inward = part.closed && volumeOf(*this, part) < 0.0;
    findThin(*this);
}

} // namespace gnomon
