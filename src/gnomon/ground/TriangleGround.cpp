// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/MeshEdges.h>
#include <gnomon/ground/GroundSearch.h>
#include <gnomon/ground/TriangleGround.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Height of a triangle's plane over a place inside of it or on its edge.
std::optional<double> heightOver(const GroundTriangle& t, const glm::dvec2& place) {
    const glm::dvec2 a = glm::dvec2(t[0]) - place, b = glm::dvec2(t[1]) - place, c = glm::dvec2(t[2]) - place;
    const double ofA = cross(b, c), ofB = cross(c, a), ofC = cross(a, b), all = ofA + ofB + ofC;
    if (!(ofA >= 0.0 && ofB >= 0.0 && ofC >= 0.0 && all > 0.0)) return std::nullopt;
    return t[0].z + (ofB * (t[1].z - t[0].z) + ofC * (t[2].z - t[0].z)) / all;
}

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

const GroundBox nowhere{glm::dvec3(infinite), glm::dvec3(-infinite)};

void take(const glm::dvec3& point, GroundBox& box) { box = {glm::min(box.low, point), glm::max(box.high, point)}; }

/// Both on one of its four in plan.
bool isOnSide(const GroundBox& box, const glm::dvec3& a, const glm::dvec3& b) {
    const auto are = [&](int axis, double place) { return a[axis] == place && b[axis] == place; };
    return are(0, box.low.x) || are(0, box.high.x) || are(1, box.low.y) || are(1, box.high.y);
}

int longestAxis(const glm::dvec3& size) {
    const int inPlan = size.x >= size.y ? 0 : 1;
    return size[inPlan] >= size.z ? inPlan : 2;
}

} // namespace

bool TriangleGround::Part::isLeaf() const { return count <= leafSize; }

TriangleGround::Part TriangleGround::Part::left() const {
    const std::size_t leaves = (count + leafSize - 1) / leafSize;
    return {node + 1, first, leaves / 2 * leafSize};
}

/// A tree of n leaves has 2 n - 1 nodes.
TriangleGround::Part TriangleGround::Part::right() const {
    const std::size_t before = left().count;
    return {node + 2 * (before / leafSize), first + before, count - before};
}

TriangleGround::TriangleGround(std::vector<glm::dvec3> vertices, const std::vector<unsigned>& indices)
    : _vertices(std::move(vertices)) {
    _triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        if (const auto corners = upward(&indices[i])) _triangles.push_back(*corners);
    if (_triangles.empty()) return;
    findHoles();
    _nodes.resize(2 * ((_triangles.size() + leafSize - 1) / leafSize) - 1);
    build(all());
}

GroundTriangle TriangleGround::triangle(const Corners& corners) const {
    return {_vertices[corners[0]], _vertices[corners[1]], _vertices[corners[2]]};
}

/// Counter-clockwise from above; a vertical one as it is.
std::optional<TriangleGround::Corners> TriangleGround::upward(const unsigned* corners) const {
    if (std::any_of(corners, corners + 3, [this](unsigned i) { return i >= _vertices.size(); })) return std::nullopt;
    const GroundTriangle t = triangle({corners[0], corners[1], corners[2]});
    if (!planeFromPoints(t[0], t[1], t[2])) return std::nullopt;
    const bool turned = doubleArea(t[0], t[1], t[2]) < 0.0;
    return Corners{corners[0], corners[turned ? 2 : 1], corners[turned ? 1 : 2]};
}

/// Marks the ends of edges that only one triangle has: a ray that goes down beyond one may meet what lies behind it. Where it
/// passes a side of the bounding rectangle it does not come back.
void TriangleGround::findHoles() {
    std::replace_if(
        _vertices.begin(), _vertices.end(), [](const glm::dvec3& v) { return !isFinite(v); },
        glm::dvec3(0.0)); // no triangle has them
    const std::vector<unsigned> welded = weld(_vertices.data(), _vertices.size());
    std::vector<unsigned> corners;
    GroundBox box = nowhere;
    corners.reserve(3 * _triangles.size());
    for (const Corners& triangle : _triangles)
        for (const unsigned corner : triangle) {
            corners.push_back(welded[corner]);
            take(_vertices[corner], box);
        }
    std::vector<bool> first(_vertices.size(), false); // of those at the same place
    for (const OpenEdge& edge : openEdges(corners))
        if (!isOnSide(box, _vertices[edge.low], _vertices[edge.high])) first[edge.low] = first[edge.high] = true;
    _atHole.resize(_vertices.size());
    for (std::size_t i = 0; i < _vertices.size(); ++i) _atHole[i] = first[welded[i]];
}

/// Or one of the triangles beside it is.
bool TriangleGround::isAtHole(const Corners& corners) const {
    return std::count_if(corners.begin(), corners.end(), [this](unsigned i) { return _atHole[i]; }) > 1;
}

TriangleGround::Node TriangleGround::leafNode(const Part& part) const {
    Node node{nowhere};
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
        const GroundTriangle t = triangle(_triangles[i]);
        for (const glm::dvec3& corner : t) take(corner, node.box);
        node.slope = std::max(node.slope, slopeOf(t));
        node.holes = node.holes || isAtHole(_triangles[i]);
    }
    return node;
}

void TriangleGround::split(const Part& part) {
    const GroundBox box = leafNode(part).box;
    const int axis = longestAxis(box.high - box.low);
    const auto place = [&](const Corners& c) {
        return _vertices[c[0]][axis] + _vertices[c[1]][axis] + _vertices[c[2]][axis];
    };
    const auto first = _triangles.begin() + static_cast<std::ptrdiff_t>(part.first);
    std::nth_element(first, first + static_cast<std::ptrdiff_t>(part.left().count),
                     first + static_cast<std::ptrdiff_t>(part.count),
                     [&](const Corners& a, const Corners& b) { return place(a) < place(b); });
}

void TriangleGround::build(const Part& part) {
    if (part.isLeaf()) {
        _nodes[part.node] = leafNode(part);
        return;
    }
    split(part);
    constexpr std::size_t worthATask = 4096;
    if (part.count > worthATask)
        tbb::parallel_invoke([&] { build(part.left()); }, [&] { build(part.right()); });
    else
        build(part.left()), build(part.right());
    const Node &a = _nodes[part.left().node], &b = _nodes[part.right().node];
    _nodes[part.node] = {{glm::min(a.box.low, b.box.low), glm::max(a.box.high, b.box.high)},
                         std::max(a.slope, b.slope),
                         a.holes || b.holes};
}

template <class Enter, class Take>
void TriangleGround::descend(const Part& part, const Enter& enter, const Take& take) const {
    if (part.count == 0 || !enter(_nodes[part.node])) return;
    if (!part.isLeaf()) {
        descend(part.left(), enter, take);
        descend(part.right(), enter, take);
        return;
    }
    for (std::size_t i = part.first; i < part.first + part.count; ++i) take(_triangles[i]);
}

std::optional<double> TriangleGround::height(double x, double y) const {
    std::optional<double> highest;
    const auto over = [&](const Node& node) {
        const GroundBox& box = node.box;
        return x >= box.low.x && x <= box.high.x && y >= box.low.y && y <= box.high.y && !(highest >= box.high.z);
    };
    descend(all(), over, [&](const Corners& c) { highest = std::max(highest, heightOver(triangle(c), {x, y})); });
    return highest;
}

std::optional<glm::dvec3> TriangleGround::hit(const glm::dvec3& start, const glm::dvec3& along) const {
    double nearest = infinite;
    const auto before = [&](const Node& node) {
        const RaySpan span = spanInside(node.box, start, along);
        return span.from <= span.to && span.from < nearest;
    };
    descend(all(), before,
            [&](const Corners& c) { nearest = std::min(nearest, meet(triangle(c), start, along).value_or(nearest)); });
    if (!std::isfinite(nearest)) return std::nullopt;
    return start + nearest * along;
}

/// Goes down to triangles at the rectangle's border alone: a node inside of it counts as a whole, and one that would add
/// nothing is left out.
std::optional<GroundRange> TriangleGround::range(const glm::dvec2& low, const glm::dvec2& high) const {
    GroundRange range{infinite, -infinite, 0.0};
    const auto touches = [&](const GroundBox& box) {
        return box.high.x >= low.x && box.low.x <= high.x && box.high.y >= low.y && box.low.y <= high.y;
    };
    const auto holds = [&](const GroundBox& box) {
        return box.low.x >= low.x && box.high.x <= high.x && box.low.y >= low.y && box.high.y <= high.y;
    };
    const auto take = [&](const Node& node) {
        range = {std::min(range.low, node.box.low.z), std::max(range.high, node.box.high.z),
                 std::max(range.steepest, node.slope), range.holes || node.holes};
    };
    const auto enter = [&](const Node& node) {
        const bool adds = node.box.low.z < range.low || node.box.high.z > range.high || node.slope > range.steepest ||
                          (node.holes && !range.holes);
        if (!adds || !touches(node.box)) return false;
        if (!holds(node.box)) return true;
        take(node);
        return false;
    };
    descend(all(), enter, [&](const Corners& c) {
        const GroundTriangle t = triangle(c);
        const GroundBox box{glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))};
        if (touches(box)) take({box, slopeOf(t), isAtHole(c)});
    });
    if (range.low > range.high) return std::nullopt;
    return range;
}

} // namespace gnomon
