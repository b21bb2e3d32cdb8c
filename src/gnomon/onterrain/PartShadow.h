// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/onterrain/FanBatch.h>

namespace gnomon {

/// How shadows are to be found; the same for many parts.
struct TerrainRequest {
    const Ground& ground;
    glm::dvec4 light;
    TerrainMethod method;
    double error; ///< in plan.
    const ShadowKernel& kernel = bestShadowKernel();
};

bool isLightBelow(const Ground& ground, const glm::dvec4& light);

/// Adds parts `first` up to `end` to a batch that is begun, and finds what the batch can.
void findTogether(FanBatch& batch, const TerrainRequest& request, const PackedParts& parts, std::size_t first,
                  std::size_t end);

/// What becomes of one of a batch's, and its triangles about its anchor if it is no fan.
struct PartShadow {
    TerrainOutcome outcome;
    const DrapeMesh* drape = nullptr; ///< until the next one is requested.
};

PartShadow partShadow(FanBatch& batch, std::size_t i, const TerrainRequest& request, const PackedParts& parts,
                      std::size_t part);

/// One a thread, used again.
FanBatch& threadsBatch();

} // namespace gnomon
