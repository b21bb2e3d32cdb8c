// SPDX-License-Identifier: MIT
#include <gnomon/onterrain/FanBatch.h>
#include <gnomon/onterrain/HullFan.h>

namespace gnomon {

std::optional<HullFan> hullFan(const Ground& ground, const ConvexHull& hull, const glm::dvec4& light) {
    FanBatch batch;
    batch.begin(ground, light);
    batch.take(PackedParts({{hull, std::nullopt}}), 0, 1);
    batch.findFans();
    if (batch.entry(0).outcome != TerrainOutcome::fan) return std::nullopt;
    return HullFan{batch.triangles(0), batch.entry(0).off()};
}

} // namespace gnomon
