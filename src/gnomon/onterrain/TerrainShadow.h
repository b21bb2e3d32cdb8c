// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/Drape.h>
#include <gnomon/geometry/ConvexParts.h>

namespace gnomon {

enum class TerrainMethod {
    hull, ///< one polygon, see hullFan(); where that is not right, as drape.
    drape ///< the ground's triangles clipped, see drape().
};

/// What became of a part's shadow.
enum class TerrainOutcome : unsigned char {
    fan,    ///< one polygon.
    draped, ///< as asked.
    // As drape although hull was asked for:
    steep,       ///< rays graze the ground.
    rough,       ///< the ground between the corners' rays is not where the polygon is.
    noFan,       ///< a ray meets no ground, or the polygon overlaps itself.
    lightInside, ///< all of the ground, for the lamp is inside the part, or in its surface.
    // No shadow:
    lightBelow, ///< the light is not above the horizon, or a lamp in the ground.
    edgeOn,     ///< the light is in the plane of a plate, or there is no light.
    turnedAway, ///< the other plates of its solid cast its shadow.
    buried,     ///< nothing of the part stands out of the ground by a millionth of its size.
    noGround    ///< the shadow meets no ground.
};

/// What became of the shadow, in one sentence or two. @return the same for the whole of the program.
const char* sentence(TerrainOutcome outcome);

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
