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

/// The hull, if the piece covers it but for its floor. What is inside of it casts no shadow of its own.
///
/// Of the triangles that lie in faces of the hull, every edge above the floor must have an even number: then each way from the
/// middle of the hull to its sides and roof meets an odd number of them, or each an even one. The tetrahedra from the middle to
/// them must be as large together as the hull is without its floor: then that number is one. Volumes may differ by as
/// much as a layer over the hull holds in which points are taken for one.
std::optional<ConvexHull> asHull(const Piece& given) {
    if (isFlat(given)) return std::nullopt;
    if (given.closed)
        if (auto solid = convexSolid(given.points, given.triangles, given.flatness())) return solid;
    const Piece piece = rounded(given);
    std::optional<ConvexHull> hull = convexHull(piece.points);
    if (!hull) return std::nullopt;
    std::multimap<double, glm::dvec4> planes; // by the z of the normal
    std::vector<glm::dvec4> floor;
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : hull->vertices) middle += corner / double(hull->vertices.size());
    double area = 0.0, missing = 0.0;
    for (const ConvexHull::Face& face : hull->faces) {
        const glm::dvec3 a = hull->vertices[face.corners[0]] - middle, b = hull->vertices[face.corners[1]] - middle,
                         c = hull->vertices[face.corners[2]] - middle;
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
        if (looksDown(glm::dvec3(face.plane)))
            floor.push_back(face.plane);
        else
            missing += glm::dot(a, glm::cross(b, c)) / 6.0;
        planes.emplace(face.plane.z, face.plane);
    }
    const auto isOnFloor = [&](unsigned corner) {
        return std::any_of(floor.begin(), floor.end(), [&](const glm::dvec4& plane) {
            return std::abs(distance(plane, piece.points[corner])) <= piece.flatness();
        });
    };
    std::map<std::pair<unsigned, unsigned>, int> counts;
    for (const Corners& t : piece.triangles) {
        const glm::dvec3 normal = glm::normalize(piece.doubleArea(t));
        const std::array<glm::dvec3, 3> corners{piece.points[t[0]], piece.points[t[1]], piece.points[t[2]]};
        const double height = glm::dot(normal, corners[0] - middle), side = height < 0.0 ? -1.0 : 1.0;
        const auto end = planes.upper_bound(side * normal.z + alikeNormals);
        const bool isOnHull = std::any_of(planes.lower_bound(side * normal.z - alikeNormals), end, [&](const auto& it) {
            return isPlaneOf(it.second, side * normal, corners, piece.flatness());
        });
        if (!isOnHull || std::all_of(t.begin(), t.end(), isOnFloor)) continue;
        missing -= std::abs(height) * glm::length(piece.doubleArea(t)) / 6.0;
        for (std::size_t i = 0; i < 3; ++i) ++counts[std::minmax(t[i], t[(i + 1) % 3])];
    }
    if (!(std::abs(missing) <= piece.flatness() * area)) return std::nullopt;
    const bool isCovered = std::all_of(counts.begin(), counts.end(), [&](const auto& it) {
        return it.second % 2 == 0 || (isOnFloor(it.first.first) && isOnFloor(it.first.second));
    });
    return isCovered ? hull : std::nullopt;
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
