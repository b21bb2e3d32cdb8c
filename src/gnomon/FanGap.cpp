// SPDX-License-Identifier: MIT
#include <gnomon/FanGap.h>
#include <gnomon/GroundQuery.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {

void FanGap::begin(const HeightField& field, const std::vector<glm::dvec3>& fan) {
    _field = &field;
    _fan = fan;
    _below = _above = 0.0;
    _triangles.clear();
    for (std::size_t i = 2; i < fan.size(); ++i) {
        const glm::dvec3 a = fan[i - 1] - fan[0], b = fan[i] - fan[0];
        const double area = cross(glm::dvec2(a), glm::dvec2(b));
        const glm::dvec2 slope = glm::dvec2(b.y * a.z - a.y * b.z, a.x * b.z - b.x * a.z) / area;
        if (area > 0.0) _triangles.push_back({glm::dvec2(b), slope});
    }
}

bool FanGap::isKnown() const {
    return _fan.size() > 2 && cross(glm::dvec2(_fan[1] - _fan[0]), glm::dvec2(_fan.back() - _fan[0])) > 0.0;
}

/// Of the first triangle whose last edge is to the left.
double FanGap::heightAt(const glm::dvec3& place) const {
    const glm::dvec2 at(place - _fan[0]);
    const auto isIn = [&](const Triangle& triangle) { return cross(triangle.second, at) <= 0.0; };
    const auto triangle = std::find_if(_triangles.begin(), _triangles.end(), isIn);
    if (_triangles.empty()) return place.z;
    return _fan[0].z + glm::dot((triangle == _triangles.end() ? triangle - 1 : triangle)->slope, at);
}

void FanGap::takeInnerEdges() {
    const glm::dvec2 start = _field->cellOf(_fan[0].x, _fan[0].y);
    for (std::size_t i = 2; i + 1 < _fan.size(); ++i) {
        const glm::dvec3 to = _fan[i] - _fan[0];
        const glm::dvec2 step = glm::dvec2(to) / _field->step();
        takeCrossings(to, start.x, step.x);
        takeCrossings(to, start.y, step.y);
        takeCrossings(to, start.x + start.y, step.x + step.y); // diagonals, whichever way cells are cut
        takeCrossings(to, start.x - start.y, step.x - step.y);
    }
}

/// Where what is `from` at the first corner and changes by `step` is a whole number.
void FanGap::takeCrossings(const glm::dvec3& to, double from, double step) {
    const double last = std::max(from, from + step);
    for (double line = std::ceil(std::min(from, from + step)); line <= last && step != 0.0; ++line) {
        const glm::dvec3 at = _fan[0] + (line - from) / step * to;
        if (const auto height = _field->height(at.x, at.y)) take(at.z - *height);
    }
}

void FanGap::take(double over) {
    _below = std::max(_below, -over);
    _above = std::max(_above, over);
}

} // namespace gnomon
