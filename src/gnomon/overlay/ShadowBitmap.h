// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/overlay/ShadowDecals.h>

#include <cstdint>

namespace gnomon {

/// What shadows cover in plan, as a bit for each texel of a regular grid, and the ground's own triangles to show it on: many
/// small shadows on few triangles. A bit is set where the middle of its texel is in a shadow; so an edge is off by half a
/// texel's diagonal at most.
struct ShadowBitmap {
    static constexpr int wide = 8, high = 4; ///< texels of a block of bytes: what is near in plan is near in memory.

    glm::dvec2 low{0.0};       ///< where the texels begin, about the shadows' origin; those at the border are empty.
    double texel = 1.0;        ///< its side.
    int columns = 0, rows = 0; ///< of blocks.
    std::vector<std::uint8_t> bytes; ///< block by block, row by row; of texel (x, y) of a block byte y, bit x.
    std::vector<glm::vec3> vertices; ///< of the ground, about the shadows' origin.
    std::vector<unsigned> triangles; ///< three places in `vertices` each, counter-clockwise from above.

    std::size_t place(int x, int y) const; ///< of a texel's byte.
    bool isSet(int x, int y) const;        ///< of a texel that is there.
};

/// Of those that are to be decals. Memory that `into` has is used again.
///
/// Threads any number, each with its own `into`. Cost  what is cleared, and each row of texels of each triangle.
void shadowBitmap(const HeightPyramid& ground, const PackedShadows& shadows, double texel, ShadowBitmap& into);

} // namespace gnomon
