// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/ConvexSolid.h>

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

} // namespace gnomon
