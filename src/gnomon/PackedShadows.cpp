// SPDX-License-Identifier: MIT
#include <gnomon/PackedShadows.h>
#include <gnomon/TerrainSteps.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

constexpr std::size_t together = 256; // what is found of so many parts stays in the nearest cache

glm::vec3 rounded(const PackedShadows& found, const glm::dvec3& anchor, const glm::dvec3& corner) {
    return glm::vec3(anchor + corner - found.origin);
}

/// Room for more, at the end. @return the first of them.
template <class Kept>
Kept* room(std::vector<Kept>& kept, std::size_t count) {
    if (kept.capacity() < kept.size() + count) kept.reserve(2 * (kept.size() + count));
    kept.resize(kept.size() + count);
    return kept.data() + kept.size() - count;
}

void addFan(PackedShadows& found, const FanBatch& batch, std::size_t i) {
    const FanBatch::Entry& entry = batch.entry(i);
    glm::vec3* to = room(found.corners, entry.corners);
    const KernelEdge* edges = batch.edges(entry);
    double low = infinite;
    for (std::size_t k = 0; k < entry.corners; ++k) {
        const glm::dvec3 corner(edges[k].endX[entry.lane], edges[k].endY[entry.lane], edges[k].endZ[entry.lane]);
        low = std::min(low, corner.z);
        to[k] = rounded(found, entry.anchor, corner);
    }
    found.highest = std::max(found.highest, entry.high - low);
}

void addDrape(PackedShadows& found, const FanBatch::Entry& entry, const DrapeMesh& drape) {
    glm::vec3* to = room(found.corners, drape.corners.size());
    double low = infinite;
    for (const glm::dvec3& corner : drape.corners) {
        low = std::min(low, corner.z);
        *to++ = rounded(found, entry.anchor, corner);
    }
    std::copy(drape.indices.begin(), drape.indices.end(), room(found.indices, drape.indices.size()));
    found.highest = std::max(found.highest, entry.high - low);
}

void addEnds(PackedShadows& found, TerrainOutcome outcome) {
    found.cornerEnds.push_back(unsigned(found.corners.size()));
    found.indexEnds.push_back(unsigned(found.indices.size()));
    found.outcomes.push_back(outcome);
}

void clear(PackedShadows& found) {
    found.corners.clear();
    found.indices.clear();
    found.cornerEnds.clear();
    found.indexEnds.clear();
    found.outcomes.clear();
    found.highest = found.steepest = 0.0;
}

/// The light's way in plan a unit of height.
glm::dvec2 shiftOf(const glm::dvec4& sun) { return glm::dvec2(sun) / sun.z; }

double steepestAbout(const Ground& ground, const PackedShadows& shadows) {
    if (shadows.corners.empty()) return infinite;
    glm::vec3 low = shadows.corners[0], high = low;
    for (const glm::vec3& corner : shadows.corners) low = glm::min(low, corner), high = glm::max(high, corner);
    const glm::dvec2 origin(shadows.origin), margin(shadows.highest);
    const auto range =
        ground.range(origin + glm::dvec2(glm::vec2(low)) - margin, origin + glm::dvec2(glm::vec2(high)) + margin);
    return range ? range->steepest : infinite;
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

std::size_t PackedShadows::triangleCount() const {
    std::size_t count = indices.size() / 3;
    for (std::size_t i = 0; i < size(); ++i)
        if ((*this)[i].isFan()) count += (*this)[i].cornerCount - 2;
    return count;
}

std::size_t PackedShadows::bytes() const {
    return corners.size() * sizeof(glm::vec3) +
           (indices.size() + cornerEnds.size() + indexEnds.size()) * sizeof(unsigned) +
           outcomes.size() * sizeof(TerrainOutcome);
}

void packedShadows(const Ground& ground, const PackedParts& parts, const glm::dvec4& light, TerrainMethod method,
                   double error, const glm::dvec3& origin, PackedShadows& found) {
    found.origin = origin;
    clear(found);
    if (isLightBelow(ground, light)) {
        for (std::size_t i = 0; i < parts.size(); ++i) addEnds(found, TerrainOutcome::lightBelow);
        return;
    }
    const TerrainAsk asked{ground, light, method, error};
    FanBatch& batch = threadsBatch();
    batch.begin(ground, light);
    for (std::size_t first = 0; first < parts.size(); first += together) {
        findTogether(batch, asked, parts, first, std::min(first + together, parts.size()));
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const Settled one = settled(batch, i, asked, parts, first + i);
            if (one.outcome == TerrainOutcome::fan) addFan(found, batch, i);
            if (one.drape) addDrape(found, batch.entry(i), *one.drape);
            addEnds(found, one.outcome);
        }
    }
    found.steepest = steepestAbout(ground, found);
}

/// Where a shadow moves from p to p', z' - z <= g |p' - p|, and p' - p = (z' - z) d - h (d - d').
double movedAtMost(const PackedShadows& shadows, const glm::dvec4& then, const glm::dvec4& now) {
    if (then == now) return 0.0;
    if (then.w != 0.0 || now.w != 0.0 || !(then.z > 0.0) || !(now.z > 0.0)) return infinite;
    const double straight = shadows.highest * glm::length(shiftOf(now) - shiftOf(then));
    const double share = 1.0 - shadows.steepest * glm::length(shiftOf(now));
    const double moved = straight / share;
    return share > 0.0 && moved <= shadows.highest ? moved : infinite; // else beyond where the ground is known
}

} // namespace gnomon
