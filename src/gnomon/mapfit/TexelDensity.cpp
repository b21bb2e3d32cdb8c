// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/TexelDensity.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double mostStretch = 8.0; // light at 7 degrees; edges are blurred by less than that in sight
constexpr double stretchOfBodies = 2.0;
constexpr double enough = 7.0 / 8.0, step = 32.0;
constexpr int fewest = 64;

/// Of a box that is flat, of any length; 0 of others.
glm::dvec3 flatNormal(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox) {
    const auto thin = flatAxis(low, high, sceneFromBox);
    const glm::dmat3 way(sceneFromBox);
    return thin ? glm::cross(way[(*thin + 1) % 3], way[(*thin + 2) % 3]) : glm::dvec3(0.0);
}

} // namespace

std::optional<int> flatAxis(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox) {
    constexpr double flat = 1.0 / 8.0;
    glm::dvec3 length;
    for (int axis = 0; axis < 3; ++axis)
        length[axis] = glm::length(glm::dvec3(sceneFromBox[axis])) * (high[axis] - low[axis]);
    const int thin = length.x <= length.y && length.x <= length.z ? 0 : length.y <= length.z ? 1 : 2;
    if (length[thin] > flat * std::min(length[(thin + 1) % 3], length[(thin + 2) % 3])) return std::nullopt;
    return thin;
}

TexelDensity::TexelDensity(const LightFrame& frame, const glm::dmat4& clipFromScene, const glm::dvec2& pixels)
    : _frame(frame), _pixel(glm::row(clipFromScene, 3)) {
    const auto pixel = [&](int axis) {
        return 2.0 / (pixels[axis] * glm::length(glm::dvec3(glm::row(clipFromScene, axis))));
    };
    _pixel *= std::min(pixel(0), pixel(1));
}

void TexelDensity::addBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox,
                          const std::vector<glm::dvec4>& given) {
    const std::vector<glm::dvec4> all = cornersWithin(low, high, sceneFromBox, {});
    const glm::dvec3 normal = flatNormal(low, high, sceneFromBox);
    const double least = side * (normal == glm::dvec3(0.0) ? stretchOfBodies : mostStretch);
    if (std::all_of(all.begin(), all.end(), [&](const auto& corner) { return unstretched(corner) >= least; })) return;
    std::vector<glm::dvec4> halfSpaces = given;
    halfSpaces.insert(halfSpaces.end(), _frame.halfSpaces.begin(), _frame.halfSpaces.end());
    for (const glm::dvec4& corner : cornersWithin(low, high, sceneFromBox, halfSpaces))
        if (inLight(corner).w > 0.0) side = std::min(side, unstretched(corner) / stretch(normal, corner));
}

glm::dvec4 TexelDensity::inLight(const glm::dvec4& place) const { return _frame.lightFromScene * place; }

/// Side of a pixel on what faces the light there; 0 behind a lamp.
double TexelDensity::unstretched(const glm::dvec4& place) const {
    const double distance = inLight(place).w; // 1 of suns
    return distance > 0.0 ? std::max(glm::dot(_pixel, place), 0.0) / distance : 0.0;
}

/// @param normal  see flatNormal().
double TexelDensity::stretch(const glm::dvec3& normal, const glm::dvec4& place) const {
    if (normal == glm::dvec3(0.0)) return stretchOfBodies;
    const auto axis = [this](int row) { return glm::dvec3(glm::row(_frame.lightFromScene, row)); };
    const glm::dvec4 at = inLight(place);
    const glm::dvec3 light = _frame.sun ? axis(2) : at.x * axis(0) + at.y * axis(1) + at.w * axis(3);
    const double across = glm::length(normal) * glm::length(light);
    return across > 0.0 ? across / std::max(std::abs(glm::dot(normal, light)), across / mostStretch) : mostStretch;
}

int texelsFor(double wanted, int most, int before) {
    const double least = std::min(enough * wanted, double(most)), tooMany = std::max(2.0 * wanted, double(fewest));
    if (before > 0 && before >= least && before <= std::min(tooMany, double(most))) return before;
    return static_cast<int>(std::min(std::max(std::ceil(wanted / step) * step, double(fewest)), double(most)));
}

} // namespace gnomon
