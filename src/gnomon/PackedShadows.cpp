// SPDX-License-Identifier: MIT
#include <gnomon/PackedShadows.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of triangles that share their first corner.
Drape outlineOf(const Drape& fan) {
    Drape outline{fan[0], fan[1], fan[2]};
    for (std::size_t i = 3; i + 2 < fan.size(); i += 3) {
        if (fan[i + 1] != outline.back()) outline.push_back(fan[i + 1]);
        outline.push_back(fan[i + 2]);
    }
    return outline;
}

void add(PackedShadows& found, const TerrainShadow& shadow) {
    const bool isFan = shadow.outcome == TerrainOutcome::fan;
    const Drape corners = isFan ? outlineOf(shadow.triangles) : shadow.triangles;
    for (std::size_t i = 0; i < corners.size() && !isFan; ++i) found.indices.push_back(unsigned(i));
    for (const glm::dvec3& corner : corners) found.corners.emplace_back(corner - found.origin);
    found.cornerEnds.push_back(unsigned(found.corners.size()));
    found.indexEnds.push_back(unsigned(found.indices.size()));
    found.outcomes.push_back(shadow.outcome);
}

double heightOver(const ConvexHull& hull, const Drape& shadow) {
    double top = -infinite, bottom = infinite;
    for (const glm::dvec3& vertex : hull.vertices) top = std::max(top, vertex.z);
    for (const glm::dvec3& corner : shadow) bottom = std::min(bottom, corner.z);
    return top - bottom;
}

/// The light's way in plan a unit of height.
glm::dvec2 shiftOf(const glm::dvec4& sun) { return glm::dvec2(sun) / sun.z; }

/// Of the ground where the shadows are, and `margin` around them.
double steepestAbout(const Ground& ground, const PackedShadows& shadows, double margin) {
    glm::dvec3 low(infinite), high(-infinite);
    for (const glm::vec3& corner : shadows.corners)
        low = glm::min(low, glm::dvec3(corner)), high = glm::max(high, glm::dvec3(corner));
    low += shadows.origin - margin;
    high += shadows.origin + margin;
    return ground.steepest(
        {{1.0, 0.0, 0.0, -low.x}, {-1.0, 0.0, 0.0, high.x}, {0.0, 1.0, 0.0, -low.y}, {0.0, -1.0, 0.0, high.y}});
}

} // namespace

PackedShadow PackedShadows::operator[](std::size_t part) const {
    const unsigned corner = part > 0 ? cornerEnds[part - 1] : 0u, index = part > 0 ? indexEnds[part - 1] : 0u;
    return {corners.data() + corner, cornerEnds[part] - corner, indices.data() + index, indexEnds[part] - index,
            outcomes[part]};
}

Drape PackedShadows::triangles(std::size_t part) const {
    const PackedShadow shadow = (*this)[part];
    const auto at = [&](std::size_t corner) { return origin + glm::dvec3(shadow.corners[corner]); };
    Drape result;
    for (std::size_t i = 0; i < shadow.indexCount; ++i) result.push_back(at(shadow.indices[i]));
    for (std::size_t i = 2; i < shadow.cornerCount && shadow.isFan(); ++i)
        result.insert(result.end(), {at(0), at(i - 1), at(i)});
    return result;
}

std::size_t PackedShadows::bytes() const {
    return corners.size() * sizeof(glm::vec3) +
           (indices.size() + cornerEnds.size() + indexEnds.size()) * sizeof(unsigned) +
           outcomes.size() * sizeof(TerrainOutcome);
}

void packedShadows(const Ground& ground, const PackedParts& parts, const glm::dvec4& light, TerrainMethod method,
                   double error, const glm::dvec3& origin, PackedShadows& found) {
    found.origin = origin;
    found.corners.clear();
    found.indices.clear();
    found.cornerEnds.clear();
    found.indexEnds.clear();
    found.outcomes.clear();
    found.highest = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const ConvexPart part = parts.part(i);
        const TerrainShadow shadow = terrainShadow(ground, part, light, method, error);
        add(found, shadow);
        found.highest = std::max(found.highest, heightOver(part.hull, shadow.triangles));
    }
}

/// Where a shadow moves from p to p', z' - z <= g |p' - p|, and p' - p = (z' - z) d - h (d - d').
double movedAtMost(const Ground& ground, const PackedShadows& shadows, const glm::dvec4& then, const glm::dvec4& now) {
    if (then == now) return 0.0;
    if (then.w != 0.0 || now.w != 0.0 || !(then.z > 0.0) || !(now.z > 0.0)) return infinite;
    if (shadows.corners.empty()) return infinite;
    const double straight = shadows.highest * glm::length(shiftOf(now) - shiftOf(then));
    const double slope = steepestAbout(ground, shadows, 2.0 * straight);
    const double share = 1.0 - slope * glm::length(shiftOf(now));
    return share >= 0.5 ? straight / share : infinite; // else it may be beyond the margin
}

} // namespace gnomon
