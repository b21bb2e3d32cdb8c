// SPDX-License-Identifier: MIT
#include <gnomon/ground/GroundSearch.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {

RaySpan spanInside(const GroundBox& box, const glm::dvec3& start, const glm::dvec3& along) {
    RaySpan span{0.0, std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0) {
            if (start[axis] < box.low[axis] || start[axis] > box.high[axis]) return {1.0, 0.0};
            continue;
        }
        const double a = (box.low[axis] - start[axis]) / along[axis], b = (box.high[axis] - start[axis]) / along[axis];
        span.from = std::max(span.from, std::min(a, b));
        span.to = std::min(span.to, std::max(a, b));
    }
    span.to *= 1.0 + 4.0 * std::numeric_limits<double>::epsilon(); // rounding must not lose a box that is only grazed
    return span;
}

namespace {

/// The view along a ray: its start is the origin, its longest axis the depth, the others sheared so that it is a point.
class AlongRay {
public:
    AlongRay(const glm::dvec3& start, const glm::dvec3& along) : _start(start) {
        const glm::dvec3 size = glm::abs(along);
        _depth = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        _shear = {along[right()] / along[_depth], along[up()] / along[_depth]};
    }
    glm::dvec2 operator()(const glm::dvec3& point) const {
        const glm::dvec3 way = point - _start;
        return {way[right()] - _shear.x * way[_depth], way[up()] - _shear.y * way[_depth]};
    }

private:
    int right() const { return (_depth + 1) % 3; }
    int up() const { return (_depth + 2) % 3; }

    glm::dvec3 _start;
    int _depth;
    glm::dvec2 _shear;
};

} // namespace

/// The products are rounded before they are subtracted, so that a sign is right or 0: no ray slips through an edge or a
/// corner that triangles share.
/// Source: S. Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
std::optional<double> meet(const GroundTriangle& t, const glm::dvec3& start, const glm::dvec3& along) {
    const AlongRay seen(start, along);
    const glm::dvec2 a = seen(t[0]), b = seen(t[1]), c = seen(t[2]);
    const double sides[] = {cross(a, b), cross(b, c), cross(c, a)};
    const auto [least, most] = std::minmax({sides[0], sides[1], sides[2]});
    if (!(least >= 0.0 || most <= 0.0)) return std::nullopt;
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double at = glm::dot(normal, t[0] - start) / glm::dot(normal, along);
    if (!(at >= 0.0) || std::isinf(at)) return std::nullopt; // NaN too: the ray lies in the plane
    return at;
}

double slopeOf(const GroundTriangle& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    return std::hypot(normal.x, normal.y) / std::abs(normal.z);
}

} // namespace gnomon
