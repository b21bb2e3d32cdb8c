// SPDX-License-Identifier: MIT
#include <gnomon/MapTexels.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double flat = 1.0 / 8.0;  // of a box's sides, the shortest to the next
constexpr double mostStretch = 8.0; // light at 7 degrees; edges are blurred by less than that in sight
constexpr double stretchOfBodies = 2.0;
constexpr double enough = 7.0 / 8.0, step = 32.0;
constexpr int fewest = 64;

} // namespace

SeenPixels::SeenPixels(const LightFrame& frame, const glm::dmat4& clipFromScene, double width)
    : _frame(frame),
      _pixel(glm::row(clipFromScene, 3) * (2.0 / (width * glm::length(glm::dvec3(glm::row(clipFromScene, 0)))))) {}

void SeenPixels::addBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox,
                        const std::vector<glm::dvec4>& given) {
    const double larger = stretch(low, high, sceneFromBox);
    const auto sideAt = [&](const glm::dvec4& corner) {
        const double distance = (_frame.lightFromScene * corner).w; // 1 of suns
        return distance > 0.0 ? std::max(glm::dot(_pixel, corner), 0.0) / distance / larger : side;
    };
    const std::vector<glm::dvec4> all = cornersWithin(low, high, sceneFromBox, {});
    if (std::all_of(all.begin(), all.end(), [&](const auto& corner) { return sideAt(corner) >= side; })) return;
    std::vector<glm::dvec4> halfSpaces = given;
    halfSpaces.insert(halfSpaces.end(), _frame.halfSpaces.begin(), _frame.halfSpaces.end());
    for (const glm::dvec4& corner : cornersWithin(low, high, sceneFromBox, std::move(halfSpaces)))
        side = std::min(side, sideAt(corner));
}

double SeenPixels::stretch(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox) const {
    const glm::dmat3 way(sceneFromBox);
    const glm::dvec3 length(glm::length(way[0]) * (high.x - low.x), glm::length(way[1]) * (high.y - low.y),
                            glm::length(way[2]) * (high.z - low.z));
    const int thin = length.x <= length.y && length.x <= length.z ? 0 : length.y <= length.z ? 1 : 2;
    if (length[thin] > flat * std::min(length[(thin + 1) % 3], length[(thin + 2) % 3])) return stretchOfBodies;
    const glm::dvec3 normal = glm::cross(way[(thin + 1) % 3], way[(thin + 2) % 3]);
    const glm::dvec3 light = lightAt(sceneFromBox * glm::dvec4((low + high) / 2.0, 1.0));
    const double across = glm::length(normal) * glm::length(light);
    return across > 0.0 ? across / std::max(std::abs(glm::dot(normal, light)), across / mostStretch) : mostStretch;
}

/// The light's way there.
glm::dvec3 SeenPixels::lightAt(const glm::dvec4& place) const {
    const auto axis = [this](int row) { return glm::dvec3(glm::row(_frame.lightFromScene, row)); };
    const glm::dvec4 at = _frame.lightFromScene * place;
    return _frame.sun ? axis(2) : at.x * axis(0) + at.y * axis(1) + at.w * axis(3);
}

int texelsFor(double wanted, int most, int before) {
    const double least = std::min(enough * wanted, double(most)), tooMany = std::max(2.0 * wanted, double(fewest));
    if (before > 0 && before >= least && before <= std::min(tooMany, double(most))) return before;
    return static_cast<int>(std::min(std::max(std::ceil(wanted / step) * step, double(fewest)), double(most)));
}

} // namespace gnomon
