// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

enum class TerrainMethod {
    hull, ///< one polygon, see hullFan(); where that is not right, as drape.
    drape ///< the ground's triangles clipped, see drape().
};

/// What became of a part's shadow.
enum class TerrainOutcome : unsigned char {
    fan,    ///< one polygon.
    draped, ///< as requested.
    block,  ///< that of the bounding box, as requested, which is the caster's own.
    boxed,  ///< that of the bounding box, as requested, and not the caster's own.
    // As drape although hull was requested:
    steep,       ///< rays graze the ground.
    rough,       ///< the ground between the corners' rays is not where the polygon is, or a slanting wall is in it.
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

} // namespace gnomon
