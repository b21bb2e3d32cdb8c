// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/ConvexPolygons.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gnomon {
namespace {

constexpr unsigned none = ~0u;
constexpr double straight = 1e-12; // radians: double precision's rounding
constexpr double bent = 4e-6; // radians, all turns the wrong way of a polygon together: single precision's rounding

/// Half-edges of the triangles, 3 t + i from corner i of triangle t to the next, linked to rings that are merged.
class Rings {
public:
    Rings(const std::vector<glm::dvec3>& points, const std::vector<Corners>& triangles, double flatness);
    void merge();
    std::vector<ConvexPolygon> polygons() const;

private:
    unsigned origin(unsigned h) const { return _triangles[h / 3][h % 3]; }
    unsigned end(unsigned h) const { return origin(_next[h]); }
    const glm::dvec3& normalOf(unsigned triangle) const { return _normals[triangle]; }
    std::uint64_t key(unsigned from, unsigned to) const { return std::uint64_t(from) << 32 | to; }

    void sortEdges();
    /// Calls take(half-edge) for those that pass an edge the other way than h.
    template <class Take>
    void opposite(unsigned h, const Take& take) const;
    bool inPlane(unsigned triangle, const glm::dvec4& plane) const;
    void growFace(unsigned seed, unsigned face);
    void pairEdges();
    double turn(unsigned a, unsigned b, unsigned c, const glm::dvec3& normal) const;
    double turnAt(unsigned h) const {
        return turn(origin(_previous[h]), origin(h), end(h), glm::dvec3(_planes[_face[h / 3]]));
    }
    double bends(unsigned h) const;
    void straighten(ConvexPolygon& polygon) const;
    bool mergeAt(unsigned h);
    void drop(unsigned first, unsigned last);

    const std::vector<glm::dvec3>& _points;
    const std::vector<Corners>& _triangles;
    const double _flatness;
    std::vector<glm::dvec3> _normals;
    std::vector<std::pair<std::uint64_t, unsigned>> _edges; ///< (from, to) and its half-edge, sorted.
    std::vector<unsigned> _face;                            ///< of each triangle, place in _planes.
    std::vector<glm::dvec4> _planes;
    std::vector<unsigned> _twin, _next, _previous; ///< of each half-edge.
    std::vector<bool> _dropped;
};

Rings::Rings(const std::vector<glm::dvec3>& points, const std::vector<Corners>& triangles, double flatness)
    : _points(points),
      _triangles(triangles),
      _flatness(flatness),
      _face(triangles.size(), none),
      _twin(3 * triangles.size(), none),
      _dropped(3 * triangles.size(), false) {
    for (const Corners& t : triangles)
        _normals.push_back(glm::normalize(glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])));
    for (unsigned h = 0; h < _twin.size(); ++h) {
        _next.push_back(h % 3 == 2 ? h - 2 : h + 1);
        _previous.push_back(h % 3 == 0 ? h + 2 : h - 1);
    }
    sortEdges();
    for (unsigned t = 0; t < triangles.size(); ++t)
        if (_face[t] == none) growFace(t, static_cast<unsigned>(_planes.size()));
    pairEdges();
}

void Rings::sortEdges() {
    for (unsigned h = 0; h < _twin.size(); ++h) _edges.emplace_back(key(origin(h), end(h)), h);
    std::sort(_edges.begin(), _edges.end());
}

template <class Take>
void Rings::opposite(unsigned h, const Take& take) const {
    const std::uint64_t wanted = key(end(h), origin(h));
    auto at = std::lower_bound(_edges.begin(), _edges.end(), std::make_pair(wanted, 0u));
    for (; at != _edges.end() && at->first == wanted; ++at) take(at->second);
}

bool Rings::inPlane(unsigned triangle, const glm::dvec4& plane) const {
    const auto near = [&](unsigned corner) { return std::abs(distance(plane, _points[corner])) <= _flatness; };
    const Corners& t = _triangles[triangle];
    return glm::dot(_normals[triangle], glm::dvec3(plane)) > 0.5 && std::all_of(t.begin(), t.end(), near);
}

/// All triangles of the seed's plane, not of their neighbours': on a curved surface those would lead away from it.
void Rings::growFace(unsigned seed, unsigned face) {
    const glm::dvec3& normal = normalOf(seed);
    const glm::dvec4 plane(normal, -glm::dot(normal, _points[_triangles[seed][0]]));
    _planes.push_back(plane);
    std::vector<unsigned> open{seed};
    _face[seed] = face;
    while (!open.empty()) {
        const unsigned t = open.back();
        open.pop_back();
        for (unsigned h = 3 * t; h < 3 * t + 3; ++h)
            opposite(h, [&](unsigned other) {
                if (_face[other / 3] != none || !inPlane(other / 3, plane)) return;
                _face[other / 3] = face;
                open.push_back(other / 3);
            });
    }
}

void Rings::pairEdges() {
    for (unsigned h = 0; h < _twin.size(); ++h)
        opposite(h, [&](unsigned other) {
            if (_twin[h] != none || _twin[other] != none || _face[h / 3] != _face[other / 3]) return;
            _twin[h] = other;
            _twin[other] = h;
        });
}

/// Sine of the turn to the left at b; below 0 to the right.
double Rings::turn(unsigned a, unsigned b, unsigned c, const glm::dvec3& normal) const {
    const glm::dvec3 in = _points[b] - _points[a], out = _points[c] - _points[b];
    return glm::dot(glm::cross(in, out), normal) / (glm::length(in) * glm::length(out));
}

/// All that a ring turns to the right. A fine hollow curve, each turn of which is next to none, has much.
double Rings::bends(unsigned h) const {
    double sum = 0.0;
    unsigned at = h;
    do sum += std::max(0.0, -turnAt(at));
    while ((at = _next[at]) != h);
    return sum;
}

/// Takes away the edges that the two rings at h share there, if what they make is convex at both ends.
bool Rings::mergeAt(unsigned h) {
    unsigned first = h, last = h;
    while (_twin[_previous[first]] == _next[_twin[first]] && _previous[first] != h) first = _previous[first];
    while (_twin[_next[last]] == _previous[_twin[last]] && _next[last] != h) last = _next[last];
    const glm::dvec3 normal(_planes[_face[h / 3]]);
    const double at = turn(origin(_previous[first]), origin(first), end(_next[_twin[first]]), normal);
    const double to = turn(origin(_previous[_twin[last]]), end(last), end(_next[last]), normal);
    if (!(at >= -bent) || !(to >= -bent)) return false;
    const double wrong = std::max(0.0, -at) + std::max(0.0, -to);
    if (wrong > straight && bends(first) + bends(_twin[first]) + wrong > bent) return false;
    drop(first, last);
    return true;
}

void Rings::drop(unsigned first, unsigned last) {
    const unsigned before = _previous[first], after = _next[last];
    const unsigned otherBefore = _previous[_twin[last]], otherAfter = _next[_twin[first]];
    for (unsigned h = first;; h = _next[h]) {
        _dropped[h] = _dropped[_twin[h]] = true;
        if (h == last) break;
    }
    _next[before] = otherAfter;
    _previous[otherAfter] = before;
    _next[otherBefore] = after;
    _previous[after] = otherBefore;
}

/// Until nothing changes: rows of a grid can only be joined once they are rows.
void Rings::merge() {
    for (bool changed = true; changed;) {
        changed = false;
        for (unsigned h = 0; h < _twin.size(); ++h)
            if (!_dropped[h] && _twin[h] != none && h < _twin[h]) changed = mergeAt(h) || changed;
    }
}

/// Leaves corners out at which the outline does not turn to the left.
void Rings::straighten(ConvexPolygon& polygon) const {
    std::vector<unsigned>& c = polygon.corners;
    for (std::size_t kept = 0, i = 0; kept < c.size() && c.size() >= 3;) {
        const std::size_t n = c.size();
        if (turn(c[(i + n - 1) % n], c[i], c[(i + 1) % n], glm::dvec3(polygon.plane)) > straight) {
            i = (i + 1) % n;
            ++kept;
        } else {
            c.erase(c.begin() + static_cast<std::ptrdiff_t>(i));
            i = (i + n - 2) % (n - 1); // the one before has another neighbour now
            kept = 0;
        }
    }
}

std::vector<ConvexPolygon> Rings::polygons() const {
    std::vector<ConvexPolygon> result;
    std::vector<bool> seen = _dropped;
    for (unsigned start = 0; start < _twin.size(); ++start) {
        if (seen[start]) continue;
        ConvexPolygon polygon{{}, _planes[_face[start / 3]]};
        for (unsigned h = start; !seen[h]; h = _next[h]) {
            seen[h] = true;
            polygon.corners.push_back(origin(h));
        }
        straighten(polygon);
        if (polygon.corners.size() >= 3) result.push_back(std::move(polygon));
    }
    return result;
}

} // namespace

std::vector<ConvexPolygon> convexPolygons(const std::vector<glm::dvec3>& points, const std::vector<Corners>& triangles,
                                          double flatness) {
    Rings rings(points, triangles, flatness);
    rings.merge();
    return rings.polygons();
}

} // namespace gnomon
