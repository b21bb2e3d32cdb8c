// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/RayBins.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double rounding = 1e-9; // of a picture

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
        Rect rect{glm::dvec2(0.0), glm::dvec2(1.0)};
        if (a.z > 0.0 && b.z > 0.0 && c.z > 0.0)
            rect = {glm::dvec2(glm::min(a, glm::min(b, c))) - rounding,
                    glm::dvec2(glm::max(a, glm::max(b, c))) + rounding};
        if (!(rect.high.x >= 0.0 && rect.high.y >= 0.0 && rect.low.x <= 1.0 && rect.low.y <= 1.0)) continue;
        if (!anyIn(rect)) continue;
        const auto corner = [&](int which) {
            return glm::dvec3(triangles.sceneFromMesh * glm::dvec4(triangles.corners[index[which]], 1.0));
        };
        meet(i, {corner(0), corner(1), corner(2)}, rect, hit);
    }
}

bool RayBins::anyIn(const Rect& rect) const {
    const int left = binOf(rect.low.x), right = binOf(rect.high.x), top = binOf(rect.high.y);
    for (int row = binOf(rect.low.y); row <= top; ++row)
        if (_starts[std::size_t(row * bins + right + 1)] > _starts[std::size_t(row * bins + left)]) return true;
    return false;
}

/// Source: T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997.
void RayBins::meet(std::size_t triangle, const std::array<glm::dvec3, 3>& corners, const Rect& rect,
                   const Hit& hit) const {
    const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0], normal = glm::cross(u, v);
    const int left = binOf(rect.low.x), right = binOf(rect.high.x), top = binOf(rect.high.y);
    for (int row = binOf(rect.low.y); row <= top; ++row) {
        const std::size_t first = _starts[std::size_t(row * bins + left)];
        const std::size_t end = _starts[std::size_t(row * bins + right + 1)];
        for (std::size_t i = first; i < end; ++i) {
            const Ray& ray = _rays[_order[i]];
            if (ray.at.x < rect.low.x || ray.at.x > rect.high.x || ray.at.y < rect.low.y || ray.at.y > rect.high.y)
                continue;
            const double along = -glm::dot(normal, ray.way);
            const glm::dvec3 from = ray.from - corners[0], turned = glm::cross(from, ray.way);
            const double inU = glm::dot(v, turned) / along, inV = -glm::dot(u, turned) / along;
            if (inU >= 0.0 && inV >= 0.0 && inU + inV <= 1.0)
                hit({_order[i], triangle, glm::dot(normal, from) / along, normal});
        }
    }
}

} // namespace gnomon
