// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/onterrain/PartShadow.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

// Of a fan's area. On hills of 8.5 degrees 1 % would drape every fifth shadow in a sun at 10 degrees, and a mean of 17
// triangles buys 0.2 %; what is missed is in proportion to it.
constexpr double mostOff = 0.05;
constexpr double grazing = 0.8; // of the light's tangent: above it a small height moves an edge by five times as much

bool isBelow(const Ground& ground, const glm::dvec3& point, double margin = 0.0) {
    const auto height = ground.height(point.x, point.y);
    return height && point.z <= *height + margin;
}

/// Whether a triangle of the ground is under the part's upper side by more than `margin` somewhere.
bool reachesUnder(const glm::dvec3* triangle, const ConvexShadow& beneath, double margin) {
    const glm::dvec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    return std::all_of(beneath.planes.begin(), beneath.planes.end(),
                       [&](const glm::dvec4& plane) { return distance(plane, middle) > margin; });
}

/// What lies straight below a part.
ConvexShadow beneath(const TerrainRequest& request, const PackedParts& parts, std::size_t part) {
    FanBatch batch;
    batch.begin(request.ground, {0.0, 0.0, 1.0, 0.0}, request.kernel);
    batch.take(parts, part, part + 1);
    return batch.isThere(0) ? batch.shadow(0) : ConvexShadow();
}

/// Whether the ground is over all of the part, or in it as a rug is. @param i  of the part in the batch.
bool isBuried(const FanBatch& batch, std::size_t i, const TerrainRequest& request, const PackedParts& parts,
              std::size_t part) {
    const FanBatch::Entry& entry = batch.entry(i);
    const double margin = FanBatch::inGround * entry.size;
    const auto isUnder = [&](const glm::dvec3& corner) {
        return isBelow(request.ground, entry.anchor + corner, margin);
    };
    if (!isUnder(batch.top(i)) || !isUnder(glm::dvec3(0.0))) return false;
    for (unsigned k = 0; k + 1 < parts.topology(part).corners; ++k)
        if (!isUnder(glm::dvec3(parts.others(part)[k]))) return false;
    const ConvexShadow below = beneath(request, parts, part);
    const Drape under = below.planes.empty() ? Drape() : drape(request.ground, below, 0.0);
    for (std::size_t k = 0; k + 2 < under.size(); k += 3)
        if (reachesUnder(&under[k], below, margin)) return false;
    return true;
}

} // namespace

bool isLightBelow(const Ground& ground, const glm::dvec4& light) {
    if (light.w == 0.0) return !(light.z > 0.0);
    return isBelow(ground, glm::dvec3(light) / light.w);
}

void findTogether(FanBatch& batch, const TerrainRequest& request, const PackedParts& parts, std::size_t first,
                  std::size_t end) {
    batch.take(parts, first, end);
    if (request.method == TerrainMethod::hull) batch.findFans();
}

PartShadow partShadow(FanBatch& batch, std::size_t i, const TerrainRequest& request, const PackedParts& parts,
                      std::size_t part) {
    const FanBatch::Entry& entry = batch.entry(i);
    TerrainOutcome outcome = entry.outcome;
    if (outcome == TerrainOutcome::lightInside) return {outcome, &batch.allGround(i)};
    if (outcome != TerrainOutcome::fan && outcome != TerrainOutcome::noFan) return {outcome};
    const bool isDrape = request.method == TerrainMethod::drape;
    if ((isDrape || !batch.isOut(i)) && isBuried(batch, i, request, parts, part)) return {TerrainOutcome::buried};
    if (isDrape) outcome = TerrainOutcome::draped;
    if (outcome == TerrainOutcome::fan && entry.off() <= mostOff) return {outcome};
    if (outcome == TerrainOutcome::fan) {
        const double slope = request.ground.steepest(batch.shadow(i).planes);
        outcome = slope >= grazing * entry.tangent ? TerrainOutcome::steep : TerrainOutcome::rough;
    }
    const DrapeMesh& drape = batch.drape(i, request.error);
    if (drape.indices.empty()) return {TerrainOutcome::noGround};
    return {outcome, &drape};
}

FanBatch& threadsBatch() {
    thread_local FanBatch batch;
    return batch;
}

} // namespace gnomon
