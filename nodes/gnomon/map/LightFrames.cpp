// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/LightFrames.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {

std::vector<LightFrame> framesOf(const glm::dvec4& light, const std::optional<SpotCone>& cone,
                                 const CasterLayers& casters, int texels) {
    const glm::dvec3 at(light);
    if (light.w == 0.0 || glm::length(at) > 8.0 * texels * glm::length(casters.reach))
        return {sunFrame(glm::normalize(at))};
    constexpr double onEdges = 1.05, flat = 4.0;
    if (cone && std::tan(cone->cutoff) < flat) return {lampFrame(at, cone->axis, onEdges * std::tan(cone->cutoff))};
    std::vector<LightFrame> frames;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 way(0.0);
            way[axis] = sign;
            frames.push_back(lampFrame(at, way, onEdges));
        }
    constexpr double wide = 2.0;
    const LightFrame ahead = lampFrame(at, glm::normalize(-at), wide);
    const auto corners = boxCorners(casters.low, casters.high, glm::dmat4(1.0));
    const bool holdsAll = std::all_of(ahead.halfSpaces.begin(), ahead.halfSpaces.end(), [&](const glm::dvec4& half) {
        return std::all_of(corners.begin(), corners.end(), [&](const auto& p) { return glm::dot(half, p) > 0.0; });
    });
    return holdsAll ? std::vector{ahead} : frames;
}

bool areSame(const std::vector<LightFrame>& a, const std::vector<LightFrame>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LightFrame& one, const LightFrame& other) {
        return one.sun == other.sun && one.lightFromScene == other.lightFromScene && one.halfSpaces == other.halfSpaces;
    });
}

} // namespace gnomon
