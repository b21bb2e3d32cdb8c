// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/ClosedParts.h>
#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/geometry/ConvexPolygons.h>
#include <gnomon/geometry/MeshEdges.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace gnomon {
namespace {

constexpr std::size_t mostAsked = 1000; // points of planes

using Points = std::vector<glm::dvec3>;
using Triangle = std::array<unsigned, 3>;

glm::dvec4 planeOf(const Points& points, const Triangle& t) {
    const glm::dvec3 normal = glm::normalize(glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
    return {normal, -glm::dot(normal, points[t[0]])};
}

/// The planes of the faces so far, and how many of them each point is in.
class FacePlanes {
public:
    FacePlanes(const Points& points, double flatness)
        : _points(points), _flatness(flatness), _planesAt(points.size()) {}

    /// The plane of a triangle; nullopt if a point is outside, or there are too many.
    std::optional<glm::dvec4> of(const Triangle& t) {
        const glm::dvec4 own = planeOf(_points, t);
        const std::array<glm::dvec3, 3> corners = {_points[t[0]], _points[t[1]], _points[t[2]]};
        const auto known = std::find_if(_planes.begin(), _planes.end(), [&](const glm::dvec4& plane) {
            return isPlaneOf(plane, glm::dvec3(own), corners, _flatness);
        });
        if (known != _planes.end()) return *known;
        _planes.push_back(own);
        if (_planes.size() * _points.size() > mostAsked) return std::nullopt;
        for (std::size_t i = 0; i < _points.size(); ++i) {
            const double outside = distance(own, _points[i]);
            if (!(outside <= _flatness)) return std::nullopt;
            _planesAt[i] += outside >= -_flatness ? 1 : 0;
        }
        return own;
    }
    bool areAllCorners() const {
        return std::all_of(_planesAt.begin(), _planesAt.end(), [](int count) { return count >= 3; });
    }

private:
    const Points& _points;
    const double _flatness;
    std::vector<glm::dvec4> _planes;
    std::vector<int> _planesAt;
};

double lowest(const Points& points) {
    const auto isLower = [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; };
    return std::min_element(points.begin(), points.end(), isLower)->z;
}

constexpr double tolerance = 1e-6; // of a part's size: what single precision leaves of a plane, and some more

/// To within 10⁻⁵ radians: no light from above meets such a face from outside.
bool looksDown(const glm::dvec3& normal) { return normal.z < -1.0 + 0.5e-10; }

using Triangles = std::vector<Corners>;

/// A connected part, its points welded and numbered anew.
struct Piece {
    Points points;
    Triangles triangles;
    bool closed = false;
    glm::dvec3 low{0.0}, high{0.0};

    double flatness() const { return tolerance * glm::length(high - low); }
    glm::dvec3 doubleArea(const Corners& t) const {
        return glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    }
};

bool isFinite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Indices of the triangles that have an area.
std::vector<unsigned> sound(const glm::vec3* positions, std::size_t vertexCount, const unsigned* indices,
                            std::size_t indexCount) {
    std::vector<unsigned> result;
    for (std::size_t i = 0; i + 2 < indexCount; i += 3) {
        const auto bad = [&](unsigned index) { return index >= vertexCount || !isFinite(positions[index]); };
        if (std::any_of(indices + i, indices + i + 3, bad)) continue;
        const glm::dvec3 a(positions[indices[i]]), b(positions[indices[i + 1]]), c(positions[indices[i + 2]]);
        if (glm::length(glm::cross(b - a, c - a)) > 0.0) result.insert(result.end(), indices + i, indices + i + 3);
    }
    return result;
}

/// The same triangle again, in the same sense or, of an open part, in either.
Corners sameAs(Corners t, bool closed) {
    if (!closed) std::sort(t.begin(), t.end());
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

class PieceBuilder {
public:
    explicit PieceBuilder(bool closed) { _piece.closed = closed; }
    template <class Point>
    void add(const Point* positions, const Corners& welded) {
        Corners t;
        for (std::size_t i = 0; i < 3; ++i) t[i] = place(positions, welded[i]);
        if (_seen.insert(sameAs(t, _piece.closed)).second) _piece.triangles.push_back(t);
    }
    Piece take() { return std::move(_piece); }

private:
    template <class Point>
    unsigned place(const Point* positions, unsigned vertex) {
        const auto [at, isNew] = _places.emplace(vertex, static_cast<unsigned>(_piece.points.size()));
        if (!isNew) return at->second;
        const glm::dvec3 point(positions[vertex]);
        _piece.low = _piece.points.empty() ? point : glm::min(_piece.low, point);
        _piece.high = _piece.points.empty() ? point : glm::max(_piece.high, point);
        _piece.points.push_back(point);
        return at->second;
    }

    Piece _piece;
    std::map<unsigned, unsigned> _places;
    std::set<Corners> _seen;
};

std::vector<Piece> piecesOf(const glm::vec3* positions, std::size_t vertexCount, const std::vector<unsigned>& indices) {
    std::vector<glm::vec3> finite(positions, positions + vertexCount);
    for (glm::vec3& p : finite)
        if (!isFinite(p)) p = glm::vec3(0.0f); // no triangle that is left has it
    const ClosedParts parts = closedParts(finite.data(), vertexCount, indices.data(), indices.size());
    std::vector<PieceBuilder> builders;
    std::map<unsigned, std::size_t> builderOf;
    for (std::size_t t = 0; t < parts.part.size(); ++t) {
        const auto [at, isNew] = builderOf.emplace(parts.part[t], builders.size());
        if (isNew) builders.emplace_back(parts.closed[t]);
        builders[at->second].add(finite.data(), {parts.welded[indices[3 * t]], parts.welded[indices[3 * t + 1]],
                                                 parts.welded[indices[3 * t + 2]]});
    }
    std::vector<Piece> pieces;
    for (PieceBuilder& builder : builders) pieces.push_back(builder.take());
    return pieces;
}

/// How often each edge, from its lower to its higher corner, is passed more one way than the other.
std::map<std::pair<unsigned, unsigned>, int> edgeSums(const Triangles& triangles) {
    std::map<std::pair<unsigned, unsigned>, int> sums;
    for (const Corners& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const unsigned from = t[i], to = t[(i + 1) % 3];
            sums[std::minmax(from, to)] += from < to ? 1 : -1;
        }
    return sums;
}

/// The piece with points that rounding alone keeps apart as one, as at the poles of a ball.
Piece rounded(const Piece& piece) {
    const std::vector<unsigned> first = nearlyTheSame(piece.points, 4.0 * piece.flatness());
    PieceBuilder builder(true); // of a ball no triangle is there twice
    for (const Corners& t : piece.triangles) {
        const Corners to{first[t[0]], first[t[1]], first[t[2]]};
        if (to[0] != to[1] && to[1] != to[2] && to[2] != to[0]) builder.add(piece.points.data(), to);
    }
    return builder.take();
}

/// The planes of a hull, those that differ by rounding alone as one, found by the height of their normals.
class HullPlanes {
public:
    HullPlanes(const ConvexHull& hull, double flatness);
    /// Which side of the plane of a face a triangle shows outside: 1 its front, -1 its back, 0 it is in no face.
    int cover(const Piece& piece, const Corners& triangle);
    bool allCovered() const;
    bool isOnFloor(const glm::dvec3& point) const {
        return std::any_of(_floor.begin(), _floor.end(),
                           [&](const auto& plane) { return std::abs(distance(plane, point)) <= _flatness; });
    }

private:
    struct Known {
        glm::dvec4 plane;
        bool covered = false;
    };
    /// The plane of this normal that all points are in, or null.
    Known* find(const glm::dvec3& normal, const Points& points);

    const double _flatness;
    std::multimap<double, Known> _planes; ///< by the z of the normal.
    std::vector<glm::dvec4> _floor;       ///< those that look straight down.
};

HullPlanes::HullPlanes(const ConvexHull& hull, double flatness) : _flatness(flatness) {
    for (const ConvexHull::Face& face : hull.faces) {
        Points corners;
        for (const unsigned corner : face.corners) corners.push_back(hull.vertices[corner]);
        const glm::dvec3 normal(face.plane);
        if (looksDown(normal)) _floor.push_back(face.plane);
        if (!find(normal, corners)) _planes.emplace(normal.z, Known{face.plane});
    }
}

HullPlanes::Known* HullPlanes::find(const glm::dvec3& normal, const Points& points) {
    const auto end = _planes.upper_bound(normal.z + alikeNormals);
    for (auto at = _planes.lower_bound(normal.z - alikeNormals); at != end; ++at)
        if (isPlaneOf(at->second.plane, normal, points, _flatness)) return &at->second;
    return nullptr;
}

int HullPlanes::cover(const Piece& piece, const Corners& triangle) {
    const glm::dvec3 normal = glm::normalize(piece.doubleArea(triangle));
    const Points corners{piece.points[triangle[0]], piece.points[triangle[1]], piece.points[triangle[2]]};
    for (const int side : {1, -1})
        if (Known* known = find(double(side) * normal, corners)) {
            known->covered = true;
            return side;
        }
    return 0;
}

bool HullPlanes::allCovered() const {
    const auto done = [](const auto& it) { return it.second.covered || looksDown(glm::dvec3(it.second.plane)); };
    return std::all_of(_planes.begin(), _planes.end(), done);
}

/// Whether all of it lies in the plane of its largest triangle.
bool isFlat(const Piece& piece) {
    glm::dvec3 most(0.0);
    for (const Corners& t : piece.triangles)
        if (glm::length(piece.doubleArea(t)) > glm::length(most)) most = piece.doubleArea(t);
    const glm::dvec3 normal = glm::normalize(most);
    return std::all_of(piece.points.begin(), piece.points.end(), [&](const glm::dvec3& p) {
        return std::abs(glm::dot(normal, p - piece.points.front())) <= piece.flatness();
    });
}

/// The hull, if the piece is a ball, a cone, a capsule and so on, with or without a level floor.
std::optional<ConvexHull> asRound(const Piece& given) {
    const Piece piece = given.closed ? given : rounded(given);
    if (!bendsOutwards(piece.points, piece.triangles, piece.flatness())) return std::nullopt;
    std::optional<ConvexHull> hull = convexHull(piece.points);
    return hull && areOnHull(piece.points, *hull, piece.flatness()) ? hull : std::nullopt;
}

/// The hull, if the piece covers it but for its floor.
///
/// The triangles in the hull's faces, turned outwards, cover a face the same number of times all over if no edge inside
/// it is open. An edge that is open in two faces is where they meet; so none may be open in all but on the floor.
std::optional<ConvexHull> asHull(const Piece& piece) {
    if (isFlat(piece)) return std::nullopt;
    if (piece.closed)
        if (auto solid = convexSolid(piece.points, piece.triangles, piece.flatness())) return solid;
    std::optional<ConvexHull> hull = convexHull(piece.points);
    if (!hull) return std::nullopt;
    if (auto round = asRound(piece)) return round;
    HullPlanes planes(*hull, piece.flatness());
    Triangles outside;
    for (Corners t : piece.triangles) {
        const int side = planes.cover(piece, t);
        if (side < 0) std::swap(t[1], t[2]);
        if (side != 0) outside.push_back(t);
    }
    if (!planes.allCovered()) return std::nullopt;
    for (const auto& [edge, sum] : edgeSums(outside))
        if (sum != 0 && !(planes.isOnFloor(piece.points[edge.first]) && planes.isOnFloor(piece.points[edge.second])))
            return std::nullopt;
    return hull;
}

/// The faces of an upright prism.
struct Prism {
    Triangles roof, walls;
};

std::optional<Prism> prismOf(const Piece& piece) {
    Prism prism;
    const double flat = piece.flatness();
    for (Corners t : piece.triangles) {
        const glm::dvec3 normal = piece.doubleArea(t);
        const auto at = [&](double height) {
            return std::all_of(t.begin(), t.end(),
                               [&](unsigned c) { return std::abs(piece.points[c].z - height) <= flat; });
        };
        if (normal.z < 0.0) std::swap(t[1], t[2]);
        if (at(piece.high.z))
            prism.roof.push_back(t);
        else if (std::abs(normal.z) <= tolerance * glm::length(normal))
            prism.walls.push_back(t);
        else if (!at(piece.low.z))
            return std::nullopt;
    }
    return prism;
}

/// Whether the walls stand under the rim of the roof, all of it, down to the floor, and nowhere else.
///
/// Every edge above the floor has an even number of faces, and the roof lies nowhere twice: so each upright line down
/// from the rim meets walls all the way. Their area leaves none to stand anywhere else.
bool areWallsUnderRim(const Piece& piece, const Prism& prism) {
    double area = 0.0;
    for (const Corners& t : prism.walls) area += 0.5 * glm::length(piece.doubleArea(t));
    std::set<std::pair<unsigned, unsigned>> passed;
    for (const Corners& t : prism.roof)
        for (std::size_t i = 0; i < 3; ++i)
            if (!passed.emplace(t[i], t[(i + 1) % 3]).second) return false;
    const double height = piece.high.z - piece.low.z;
    for (const auto& [from, to] : passed)
        if (!passed.count({to, from})) area -= height * glm::length(piece.points[to] - piece.points[from]);
    Triangles above = prism.roof;
    above.insert(above.end(), prism.walls.begin(), prism.walls.end());
    const auto isLow = [&](unsigned corner) { return piece.points[corner].z <= piece.low.z + piece.flatness(); };
    for (const auto& [edge, sum] : edgeSums(above))
        if (sum % 2 != 0 && !(isLow(edge.first) && isLow(edge.second))) return false;
    return std::abs(area) <= piece.flatness() * glm::length(piece.high - piece.low);
}

/// Empty if the piece is no upright prism.
std::vector<ConvexPart> asPrism(const Piece& piece) {
    const auto prism = prismOf(piece);
    if (!prism || prism->roof.empty() || prism->walls.empty() || !areWallsUnderRim(piece, *prism)) return {};
    std::vector<ConvexPart> parts;
    for (const ConvexPolygon& polygon : convexPolygons(piece.points, prism->roof, piece.flatness())) {
        Points corners;
        for (const unsigned corner : polygon.corners)
            for (const double height : {piece.low.z, piece.high.z})
                corners.emplace_back(glm::dvec2(piece.points[corner]), height);
        if (auto hull = convexHull(corners)) parts.push_back({std::move(*hull), std::nullopt});
    }
    return parts;
}

ConvexHull plateOf(const Piece& piece, const ConvexPolygon& polygon) {
    ConvexHull hull;
    std::vector<unsigned> order;
    for (const unsigned corner : polygon.corners) {
        const glm::dvec3& point = piece.points[corner];
        order.push_back(static_cast<unsigned>(order.size()));
        hull.vertices.push_back(point - distance(polygon.plane, point) * glm::dvec3(polygon.plane));
    }
    hull.faces.push_back({order, polygon.plane});
    hull.faces.push_back({{order.rbegin(), order.rend()}, -polygon.plane});
    return hull;
}

void addPlates(const Piece& piece, std::vector<ConvexPart>& parts) {
    for (const ConvexPolygon& polygon : convexPolygons(piece.points, piece.triangles, piece.flatness())) {
        if (piece.closed && looksDown(glm::dvec3(polygon.plane))) continue;
        parts.push_back({plateOf(piece, polygon), piece.closed ? std::optional(polygon.plane) : std::nullopt});
    }
}

} // namespace

std::optional<ConvexHull> convexSolid(const Points& points, const std::vector<Triangle>& triangles, double flatness) {
    // Euler's formula: else something is covered twice, or there are points elsewhere.
    if (triangles.size() + 4 != 2 * points.size()) return std::nullopt;
    ConvexHull hull{points, {}};
    FacePlanes planes(points, flatness);
    for (const Triangle& t : triangles) {
        const auto plane = planes.of(t);
        if (!plane) return std::nullopt;
        hull.faces.push_back({{t.begin(), t.end()}, *plane});
    }
    return planes.areAllCorners() ? std::optional(std::move(hull)) : std::nullopt;
}

bool bendsOutwards(const Points& points, const std::vector<Triangle>& triangles, double flatness) {
    std::map<std::pair<unsigned, unsigned>, const Triangle*> leftOf; // of an edge one way
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            if (!leftOf.emplace(std::pair(t[i], t[(i + 1) % 3]), &t).second) return false;
    const double floor = lowest(points) + flatness;
    std::size_t rim = 0;
    for (const auto& [edge, triangle] : leftOf) {
        const auto other = leftOf.find({edge.second, edge.first});
        if (other == leftOf.end()) {
            if (std::max(points[edge.first].z, points[edge.second].z) > floor) return false;
            ++rim;
            continue;
        }
        const glm::dvec4 plane = planeOf(points, *triangle);
        for (const unsigned corner : *other->second)
            if (!(distance(plane, points[corner]) <= flatness)) return false;
    }
    // Euler's formula, as above; without a floor the surface has one rim.
    return triangles.size() + rim + (rim ? 2 : 4) == 2 * points.size();
}

bool areOnHull(const Points& points, const ConvexHull& hull, double flatness) {
    const auto lessAt = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    const std::set<glm::dvec3, decltype(lessAt)> corners(hull.vertices.begin(), hull.vertices.end(), lessAt);
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
        const auto isIn = [&](const auto& face) { return distance(face.plane, point) >= -flatness; };
        return corners.count(point) > 0 || std::any_of(hull.faces.begin(), hull.faces.end(), isIn);
    });
}

std::vector<ConvexPart> convexParts(const glm::vec3* positions, std::size_t vertexCount, const unsigned* indices,
                                    std::size_t indexCount) {
    std::vector<ConvexPart> parts;
    for (const Piece& piece : piecesOf(positions, vertexCount, sound(positions, vertexCount, indices, indexCount))) {
        if (auto hull = asHull(piece)) {
            parts.push_back({std::move(*hull), std::nullopt});
            continue;
        }
        std::vector<ConvexPart> prism = asPrism(piece);
        if (prism.empty()) addPlates(piece, parts);
        std::move(prism.begin(), prism.end(), std::back_inserter(parts));
    }
    return parts;
}

std::vector<std::vector<glm::dvec3>> connectedPoints(const glm::vec3* positions, std::size_t vertexCount,
                                                     const unsigned* indices, std::size_t indexCount) {
    std::vector<std::vector<glm::dvec3>> objects;
    for (Piece& piece : piecesOf(positions, vertexCount, sound(positions, vertexCount, indices, indexCount)))
        objects.push_back(std::move(piece.points));
    return objects;
}

} // namespace gnomon
