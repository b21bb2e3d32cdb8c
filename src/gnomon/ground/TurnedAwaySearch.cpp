// SPDX-License-Identifier: MIT
#include <gnomon/ground/TurnedAwaySearch.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double grazing = 1e-12; // of a sine: more than products of doubles leave of one
constexpr double enough = 0.05;   // of the light's distance: what a sun takes twelve minutes for

glm::dvec4 normalized(const glm::dvec4& light) { return light.w == 0.0 ? light / glm::length(light) : light / light.w; }

/// How far a light has moved, as TurnedAway has it.
double wayBetween(const glm::dvec4& a, const glm::dvec4& b) {
    if ((a.w == 0.0) != (b.w == 0.0)) return std::numeric_limits<double>::infinity();
    return glm::length(normalized(a) - normalized(b));
}

} // namespace

TurnedAwaySearch::TurnedAwaySearch(const glm::dvec4& light) : _light(normalized(light)) {
    _result.until = std::numeric_limits<double>::infinity();
}

/// The light is least above the plane of a triangle that is as steep as can be and rises away from it.
bool TurnedAwaySearch::enter(const GroundBox& box, double slope) {
    if (_result.is) return false;
    const glm::dvec2 from = glm::abs(glm::dvec2(towards(box.low))), to = glm::abs(glm::dvec2(towards(box.high)));
    const double beside = glm::length(glm::max(from, to)), over = towards(box.high).z;
    const double least = (over - slope * beside) / std::sqrt(1.0 + slope * slope);
    if (!(least > 0.0 && least >= std::min(_result.until, enough * std::hypot(beside, over)))) return true;
    _result.until = std::min(_result.until, least);
    return false;
}

void TurnedAwaySearch::take(const GroundTriangle& t) {
    if (_result.is) return;
    const glm::dvec3 up = glm::cross(t[1] - t[0], t[2] - t[0]), way = towards(t[0]);
    const double length = glm::length(up), above = glm::dot(up, way) / length;
    const double off = grazing * glm::length(way);
    const bool isVertical = !(up.z > grazing * length);
    _result.is = above < -off || (isVertical && above > off);
    const double until = _result.is ? std::abs(above) - off : isVertical ? 0.0 : std::max(above, 0.0);
    _result.until = _result.is ? until : std::min(_result.until, until);
}

bool FollowedTurn::isTurnedAway(const Ground& ground, const glm::dvec4& light) {
    if (!_last || !(wayBetween(_light, light) < _last->until)) {
        _last = ground.turnedAway(light);
        _light = light;
        ++_searches;
    }
    return _last->is;
}

} // namespace gnomon
