// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/ConvexSolid.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

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

} // namespace gnomon
