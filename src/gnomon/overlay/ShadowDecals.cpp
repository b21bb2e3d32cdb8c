// SPDX-License-Identifier: MIT
#include <gnomon/drape/GridCut.h>
#include <gnomon/ground/GroundIntersection.h>
#include <gnomon/overlay/ShadowDecals.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Of a cell: what floats leave of a place on its edge. A decal that reaches so far over an edge is off by as much height.
constexpr double onEdge = 1e-6;

/// Of numbers that belong to a shape's corners.
struct Range {
    double low = infinite, high = -infinite;
    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double cells() const { return std::floor(high) - std::floor(low) + 1.0; } ///< that it touches.
    bool isIn(double from, double to) const { return from - onEdge <= low && high <= to + onEdge; }
};

/// Corners of a polygon in plan, in the ground's frame.
using Polygon = std::vector<glm::dvec3>;

/// Of a shape's places among the cells.
struct CellBounds {
    Range x, y;
    CellBounds(const HeightField& field, const PackedShadow& shadow, const glm::dvec3& origin) {
        for (std::size_t i = 0; i < shadow.cornerCount; ++i) {
            const glm::dvec3 corner = origin + glm::dvec3(shadow.corners[i]);
            const glm::dvec2 cell = field.cellOf(corner.x, corner.y);
            x.take(cell.x);
            y.take(cell.y);
        }
    }
};

bool isOnOneTriangle(const HeightField& field, const Polygon& polygon, const CellBounds& bounds) {
    const double left = std::floor(bounds.x.low + onEdge), low = std::floor(bounds.y.low + onEdge);
    if (!bounds.x.isIn(left, left + 1.0) || !bounds.y.isIn(low, low + 1.0)) return false;
    if (left < 0.0 || low < 0.0 || left > field.columns() - 2 || low > field.rows() - 2) return false;
    const bool falls = field.cut(int(left), int(low)) == CellCut::falling;
    Range across; // of the diagonal
    for (const glm::dvec3& corner : polygon) {
        const glm::dvec2 in = field.cellOf(corner.x, corner.y) - glm::dvec2(left, low);
        across.take(falls ? in.x + in.y - 1.0 : in.x - in.y);
    }
    return across.isIn(0.0, infinite) || across.isIn(-infinite, 0.0);
}

class Builder {
public:
    /// Memory is used again.
    void begin(const HeightPyramid& ground, const glm::dvec3& origin, ShadowDecals& into) {
        _ground = &ground;
        _origin = origin;
        _into = &into;
    }
    void add(const PackedShadow& shadow, const CellBounds& bounds) {
        shadow.isFan() ? addFan(shadow, bounds) : addDrape(shadow);
    }

private:
    glm::dvec3 inGround(const glm::vec3& corner) const { return _origin + glm::dvec3(corner); }
    void addFan(const PackedShadow& fan, const CellBounds& bounds) {
        _polygon.clear();
        for (std::size_t i = 0; i < fan.cornerCount; ++i) _polygon.push_back(inGround(fan.corners[i]));
        if (isOnOneTriangle(_ground->field(), _polygon, bounds))
            addPolygon();
        else if (isConvex(_polygon.data(), _polygon.size()))
            addCut(_polygon);
        else
            for (std::size_t i = 2; i < _polygon.size(); ++i) addCut(_polygon[0], _polygon[i - 1], _polygon[i]);
    }
    /// The ground that its triangles stand for may be coarser than what is drawn.
    void addDrape(const PackedShadow& drape) {
        const auto at = [&](std::size_t i) { return inGround(drape.corners[drape.indices[i]]); };
        for (std::size_t i = 0; i < drape.indexCount; i += 3) addCut(at(i), at(i + 1), at(i + 2));
    }
    void addCut(const Polygon& convex) {
        const DrapeMesh& mesh = _cutter.cut(_ground->field(), convex);
        const unsigned first = nextVertex();
        for (const glm::dvec3& corner : mesh.corners) _into->vertices.emplace_back(corner - _origin);
        for (const unsigned index : mesh.indices) _into->triangles.push_back(first + index);
    }
    void addCut(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        _triangle = {a, b, c};
        addCut(_triangle);
    }
    void addPolygon() {
        const unsigned first = nextVertex();
        for (const glm::dvec3& corner : _polygon) _into->vertices.emplace_back(corner - _origin);
        for (unsigned i = 2; i < _polygon.size(); ++i)
            _into->triangles.insert(_into->triangles.end(), {first, first + i - 1, first + i});
    }
    unsigned nextVertex() const { return unsigned(_into->vertices.size()); }

    const HeightPyramid* _ground = nullptr;
    glm::dvec3 _origin{0.0};
    ShadowDecals* _into = nullptr;
    Polygon _polygon, _triangle;
    GridCut _cutter;
};

/// Drapes that were asked for stay prisms, which are right whatever the ground is: what decals are measured against.
bool isInPlaceOfFan(TerrainOutcome outcome) {
    return outcome == TerrainOutcome::steep || outcome == TerrainOutcome::rough || outcome == TerrainOutcome::noFan;
}

/// Of what is over few cells and is to be a decal; else nullopt.
std::optional<CellBounds> decalBounds(const HeightPyramid& ground, const PackedShadow& shadow,
                                      const glm::dvec3& origin) {
    constexpr double mostCells = 12.0; // a prism has fewer triangles, and no more to clip
    if (!(shadow.isFan() || isInPlaceOfFan(shadow.outcome)) || shadow.cornerCount < 3) return std::nullopt;
    const CellBounds bounds(ground.field(), shadow, origin);
    return bounds.x.cells() * bounds.y.cells() <= mostCells ? std::optional(bounds) : std::nullopt;
}

} // namespace

bool isDecal(const HeightPyramid& ground, const PackedShadow& shadow, const glm::dvec3& origin) {
    return decalBounds(ground, shadow, origin).has_value();
}

std::optional<HeightPyramid::Cells> decalCells(const HeightPyramid& ground, const PackedShadow& shadow,
                                               const glm::dvec3& origin) {
    const auto bounds = decalBounds(ground, shadow, origin);
    if (!bounds) return std::nullopt;
    return ground.cells({bounds->x.low, bounds->y.low}, {bounds->x.high, bounds->y.high});
}

void shadowDecals(const HeightPyramid& ground, const PackedShadows& shadows, ShadowDecals& into) {
    into.vertices.clear();
    into.triangles.clear();
    thread_local Builder builder;
    builder.begin(ground, shadows.origin, into);
    for (std::size_t i = 0; i < shadows.size(); ++i)
        if (const auto bounds = decalBounds(ground, shadows[i], shadows.origin)) builder.add(shadows[i], *bounds);
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const unsigned corner : into.triangles) {
        low = glm::min(low, into.vertices[corner]);
        high = glm::max(high, into.vertices[corner]);
    }
    into.low = low;
    into.high = high;
}

} // namespace gnomon
