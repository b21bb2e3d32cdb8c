// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/ConvexShadow.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon {
namespace {

/// From each vertex of the silhouette to the next one.
using Rim = std::map<unsigned, unsigned>;

double facing(const glm::dvec4& plane, const glm::dvec4& light) { return glm::dot(plane, light); }

/// Edges of lit faces whose other side is no lit face.
Rim rimOf(const ConvexHull& hull, const std::vector<bool>& lit) {
    std::map<std::pair<unsigned, unsigned>, bool> edges;
    for (std::size_t f = 0; f < hull.faces.size(); ++f) {
        const std::vector<unsigned>& corners = hull.faces[f].corners;
        for (std::size_t i = 0; i < corners.size() && lit[f]; ++i)
            edges[{corners[i], corners[(i + 1) % corners.size()]}] = true;
    }
    Rim rim;
    for (const auto& [edge, there] : edges)
        if (!edges.count({edge.second, edge.first})) rim[edge.first] = edge.second;
    return rim;
}

std::vector<unsigned> loopOf(const Rim& rim) {
    std::vector<unsigned> loop;
    for (unsigned at = rim.begin()->first; loop.size() < rim.size();) {
        loop.push_back(at);
        const auto next = rim.find(at);
        if (next == rim.end()) break;
        at = next->second;
        if (at == loop.front()) break;
    }
    return loop;
}

/// Through an edge and the light, the hull on its inner side; nullopt for an edge that points at the light.
std::optional<glm::dvec4> sidePlane(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec4& light) {
    const glm::dvec3 towards = glm::dvec3(light) - light.w * from;
    const glm::dvec3 normal = glm::cross(towards, to - from);
    const double length = glm::length(normal);
    if (!(length > 1e-14 * glm::length(towards) * glm::length(to - from))) return std::nullopt;
    return glm::dvec4(normal / length, -glm::dot(normal / length, from));
}

/// Each once: qhull cuts a flat face into triangles of one plane.
void addFaces(ConvexShadow& shadow, const ConvexHull& hull, const std::vector<bool>& lit) {
    for (std::size_t f = 0; f < hull.faces.size(); ++f) {
        const glm::dvec4 inwards = -hull.faces[f].plane;
        const auto same = [&](const glm::dvec4& plane) { return glm::dvec3(plane) == glm::dvec3(inwards); };
        if (lit[f] && std::none_of(shadow.planes.begin(), shadow.planes.end(), same)) shadow.planes.push_back(inwards);
    }
}

/// Between two points on either side of a plane; the same whichever comes first.
glm::dvec3 crossing(const glm::dvec3& a, double from, const glm::dvec3& b, double to) {
    const bool inOrder = a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    return inOrder ? a + (from / (from - to)) * (b - a) : b + (to / (to - from)) * (a - b);
}

} // namespace

bool ConvexShadow::holds(const glm::dvec3& point) const {
    return std::all_of(planes.begin(), planes.end(), [&](const auto& plane) { return distance(plane, point) >= 0.0; });
}

std::optional<ConvexShadow> convexShadow(const ConvexHull& hull, const glm::dvec4& light) {
    const double size = glm::length(glm::dvec3(light));
    if (!std::isfinite(size) || !(light.w >= 0.0) || !(size + light.w > 0.0)) return std::nullopt;
    std::vector<bool> lit;
    for (const ConvexHull::Face& face : hull.faces) lit.push_back(facing(face.plane, light) > 0.0);
    if (std::none_of(lit.begin(), lit.end(), [](bool is) { return is; })) return std::nullopt;
    const Rim rim = rimOf(hull, lit);
    if (rim.size() < 3) return std::nullopt;
    ConvexShadow shadow;
    for (const unsigned vertex : loopOf(rim)) shadow.silhouette.push_back(hull.vertices[vertex]);
    addFaces(shadow, hull, lit);
    for (const auto& [from, to] : rim)
        if (const auto plane = sidePlane(hull.vertices[from], hull.vertices[to], light))
            shadow.planes.push_back(*plane);
    return shadow;
}

Clipper::Polygon Clipper::clip(const std::array<glm::dvec3, 3>& triangle, const std::vector<glm::dvec4>& planes,
                               std::uint64_t inside) {
    const std::size_t most = 3 + planes.size(); // a plane adds one corner
    if (_next.size() < most) _polygon.resize(most), _next.resize(most), _distances.resize(most);
    _count = 3;
    for (int i = 0; i < 3; ++i) _polygon[std::size_t(i)] = {triangle[std::size_t(i)], i, -1, i};
    bool isSome = true;
    std::uint64_t asked = planes.size() < 64 ? ~inside & ((std::uint64_t(1) << planes.size()) - 1) : ~inside;
    for (std::size_t i = 0; asked != 0 && isSome; ++i, asked >>= 1)
        if (asked & 1u) isSome = clipBy(planes[i], int(i));
    for (std::size_t i = 64; i < planes.size() && isSome; ++i) isSome = clipBy(planes[i], int(i));
    return {_polygon.data(), _count};
}

/// @return whether something is left.
bool Clipper::clipBy(const glm::dvec4& plane, int number) {
    std::size_t outside = 0;
    for (std::size_t i = 0; i < _count; ++i) {
        const glm::dvec3& p = _polygon[i].place;
        _distances[i] = plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w;
        outside += !(_distances[i] >= 0.0);
    }
    if (outside == 0) return true;
    Corner* left = _next.data();
    for (std::size_t i = 0; i < _count && outside < _count; ++i) {
        const std::size_t j = i + 1 < _count ? i + 1 : 0;
        const double from = _distances[i], to = _distances[j];
        const Corner& corner = _polygon[i];
        if (from >= 0.0) *left++ = corner;
        if ((from >= 0.0) == (to >= 0.0)) continue;
        const int edge = from >= 0.0 ? none : corner.edge;
        *left++ = {crossing(corner.place, from, _polygon[j].place, to), corner.edge, number, edge};
    }
    _count = std::size_t(left - _next.data());
    _polygon.swap(_next);
    return _count > 0;
}

} // namespace gnomon
