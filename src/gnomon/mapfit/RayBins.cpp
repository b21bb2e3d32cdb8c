// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/RayBins.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon {
namespace {

constexpr double rounding = 1e-9; // of a picture
constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

RayBins::RayBins(const glm::dmat4& pictureFromScene, std::vector<Ray> rays)
    : _pictureFromScene(pictureFromScene), _rays(std::move(rays)), _starts(bins * bins + 1, 0) {
    std::vector<std::size_t> in(_rays.size(), bins * bins);
    for (std::size_t i = 0; i < _rays.size(); ++i) {
        const glm::dvec2& at = _rays[i].at;
        if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < 1.0 && at.y < 1.0)) continue;
        in[i] = std::size_t(binOf(at.y)) * bins + std::size_t(binOf(at.x));
        ++_starts[in[i] + 1];
    }
    for (std::size_t bin = 0; bin < bins * bins; ++bin) _starts[bin + 1] += _starts[bin];
    _order.resize(_starts.back());
    std::vector<std::size_t> next(_starts.begin(), _starts.end() - 1);
    for (std::size_t i = 0; i < _rays.size(); ++i)
        if (in[i] < bins * bins) _order[next[in[i]]++] = i;
}

int RayBins::binOf(double at) { return int(std::clamp(at * bins, 0.0, bins - 1.0)); }

bool RayBins::anyIn(const ScreenRect& rect) const {
    if (!(rect.high.x >= 0.0 && rect.high.y >= 0.0 && rect.low.x <= 1.0 && rect.low.y <= 1.0)) return false;
    const int left = binOf(rect.low.x), right = binOf(rect.high.x), top = binOf(rect.high.y);
    for (int row = binOf(rect.low.y); row <= top; ++row)
        if (_starts[std::size_t(row * bins + right + 1)] > _starts[std::size_t(row * bins + left)]) return true;
    return false;
}

template <class Visit>
void RayBins::eachIn(const ScreenRect& rect, const Visit& visit) const {
    const int left = binOf(rect.low.x), right = binOf(rect.high.x), top = binOf(rect.high.y);
    for (int row = binOf(rect.low.y); row <= top; ++row) {
        const std::size_t end = _starts[std::size_t(row * bins + right + 1)];
        for (std::size_t i = _starts[std::size_t(row * bins + left)]; i < end; ++i) {
            const Ray& ray = _rays[_order[i]];
            if (ray.at.x >= rect.low.x && ray.at.x <= rect.high.x && ray.at.y >= rect.low.y && ray.at.y <= rect.high.y)
                visit(_order[i], ray);
        }
    }
}

/// A triangle that reaches behind the eye may be anywhere in the picture.
void RayBins::meet(const PlacedTriangles& triangles, const Hit& hit) const {
    if (_order.empty()) return;
    const glm::dmat4 pictureFromMesh = _pictureFromScene * triangles.sceneFromMesh;
    std::vector<glm::dvec3> seen(triangles.cornerCount); // x/w, y/w, w
    for (std::size_t i = 0; i < triangles.cornerCount; ++i) {
        const glm::dvec4 corner = pictureFromMesh * glm::dvec4(triangles.corners[i], 1.0);
        seen[i] = {corner.x / corner.w, corner.y / corner.w, corner.w};
    }
    for (std::size_t i = 0; i < triangles.count; ++i) {
        const unsigned* index = triangles.indices + 3 * i;
        const glm::dvec3 &a = seen[index[0]], &b = seen[index[1]], &c = seen[index[2]];
        if (!(a.z > 0.0 || b.z > 0.0 || c.z > 0.0)) continue;
        ScreenRect rect{glm::dvec2(0.0), glm::dvec2(1.0)};
        if (a.z > 0.0 && b.z > 0.0 && c.z > 0.0)
            rect = {glm::dvec2(glm::min(a, glm::min(b, c))) - rounding,
                    glm::dvec2(glm::max(a, glm::max(b, c))) + rounding};
        if (!anyIn(rect)) continue;
        const auto corner = [&](int which) {
            return glm::dvec3(triangles.sceneFromMesh * glm::dvec4(triangles.corners[index[which]], 1.0));
        };
        meet(i, {corner(0), corner(1), corner(2)}, rect, hit);
    }
}

/// Source: T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997.
void RayBins::meet(std::size_t triangle, const std::array<glm::dvec3, 3>& corners, const ScreenRect& rect,
                   const Hit& hit) const {
    const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0], normal = glm::cross(u, v);
    eachIn(rect, [&](std::size_t number, const Ray& ray) {
        const double along = -glm::dot(normal, ray.way);
        const glm::dvec3 from = ray.from - corners[0], turned = glm::cross(from, ray.way);
        const double inU = glm::dot(v, turned) / along, inV = -glm::dot(u, turned) / along;
        if (inU >= 0.0 && inV >= 0.0 && inU + inV <= 1.0)
            hit({number, triangle, glm::dot(normal, from) / along, normal});
    });
}

void RayBins::meet(const PlacedBox& box, const Hit& hit) const {
    if (_order.empty()) return;
    const glm::dmat4 clipFromPicture = glm::scale(glm::translate(glm::dmat4(1.0), {-1.0, -1.0, 0.0}), {2.0, 2.0, 1.0});
    const auto corners = boxCorners(box.low, box.high, clipFromPicture * _pictureFromScene * box.sceneFromBox);
    const auto bounds = screenBounds({corners.begin(), corners.end()});
    if (!bounds) return;
    const ScreenRect rect{(bounds->low + 1.0) / 2.0 - rounding, (bounds->high + 1.0) / 2.0 + rounding};
    if (!anyIn(rect)) return;
    const glm::dmat4 boxFromScene = glm::inverse(box.sceneFromBox);
    const glm::dmat3 turn(boxFromScene), back = glm::transpose(turn);
    eachIn(rect, [&](std::size_t number, const Ray& ray) {
        const glm::dvec3 from(boxFromScene * glm::dvec4(ray.from, 1.0)), way = turn * ray.way;
        double in = -infinity, out = infinity;
        int inAxis = 0, outAxis = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (way[axis] == 0.0) {
                if (from[axis] < box.low[axis] || from[axis] > box.high[axis]) in = infinity;
                continue;
            }
            double near = (box.low[axis] - from[axis]) / way[axis], far = (box.high[axis] - from[axis]) / way[axis];
            if (near > far) std::swap(near, far);
            if (near > in) in = near, inAxis = axis;
            if (far < out) out = far, outAxis = axis;
        }
        if (!(in <= out && out > 0.0 && std::isfinite(out))) return;
        const bool outside = in > 0.0;
        const int axis = outside ? inAxis : outAxis;
        const bool upwards = way[axis] < 0.0;
        glm::dvec3 normal(0.0);
        normal[axis] = upwards ? 1.0 : -1.0;
        hit({number, std::size_t(2 * axis + (upwards ? 1 : 0)), outside ? in : out, back * normal, !outside});
    });
}

} // namespace gnomon
