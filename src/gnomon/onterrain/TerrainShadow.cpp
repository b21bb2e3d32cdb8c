// SPDX-License-Identifier: MIT
#include <gnomon/onterrain/PartShadow.h>
#include <gnomon/onterrain/TerrainShadow.h>

namespace gnomon {

TerrainShadow terrainShadow(const Ground& ground, const ConvexPart& part, const glm::dvec4& light, TerrainMethod method,
                            double error) {
    if (isLightBelow(ground, light)) return {{}, TerrainOutcome::lightBelow};
    const TerrainRequest request{ground, light, method, error};
    const PackedParts parts({part});
    FanBatch& batch = threadsBatch();
    batch.begin(ground, light);
    findTogether(batch, request, parts, 0, 1);
    const PartShadow found = partShadow(batch, 0, request, parts, 0);
    if (found.outcome == TerrainOutcome::fan) return {batch.triangles(0), found.outcome};
    if (!found.drape) return {{}, found.outcome};
    Drape triangles;
    for (const unsigned corner : found.drape->indices)
        triangles.push_back(found.drape->corners[corner] + batch.entry(0).anchor);
    return {std::move(triangles), found.outcome};
}

} // namespace gnomon
