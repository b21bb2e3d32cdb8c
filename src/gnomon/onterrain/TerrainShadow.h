// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/Drape.h>
#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/onterrain/TerrainOutcome.h>

namespace gnomon {

struct TerrainShadow {
    Drape triangles; ///< in no order to rely on; none where there is no shadow.
    TerrainOutcome outcome;
};

/// The shadow of one part of a caster on the ground.
///
/// @param part   one that stands in the ground must reach below it everywhere.
/// @param light  homogeneous: w = 0 the way towards a sun, of any length; w > 0 a lamp.
/// @param error  how far off its edges may be in plan where it is draped, scene's unit, 0 is exact; default 0.1.
///
/// Limits a fan is straight from corner to corner; see TerrainOutcome for where it is not taken.
TerrainShadow terrainShadow(const Ground& ground, const ConvexPart& part, const glm::dvec4& light,
                            TerrainMethod method = TerrainMethod::hull, double error = 0.1);

} // namespace gnomon
