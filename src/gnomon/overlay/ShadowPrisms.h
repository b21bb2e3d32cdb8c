// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/Drape.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/onterrain/PackedShadows.h>

namespace gnomon {

/// Closed upright prisms over shadows on the ground. What of the ground is inside one is in shadow, however the ground is
/// drawn: finer, coarser, or cut otherwise than the ground that the shadow was made on.
struct ShadowPrisms {
    std::vector<glm::vec3> vertices; ///< about the origin.
    /// Triangles, three places in `vertices` each, counter-clockwise from outside. Nothing in a layer overlaps.
    std::vector<std::vector<unsigned>> layers;
    unsigned mostOver = 0;          ///< not more prisms, of all layers, are over or under any one place.
    glm::dvec3 low{0.0}, high{0.0}; ///< bounds, about the origin.
};

/// @param shadows  triangles as drape()'s, of one caster each; in plan they may lie over one another.
/// @param origin   z up; floats about it.
///
/// A prism reaches half its diameter in plan below and above its shadow's own heights. Cost  linear in the triangles; of a
/// polygon of n corners 4 n - 4 triangles.
ShadowPrisms shadowPrisms(const std::vector<Drape>& shadows, const glm::dvec3& origin);

/// About the shadows' own origin, but for those that shadowDecals() takes. Memory that `into` has is used again.
///
/// @param margin  how far a prism reaches below the lowest and above the highest ground about its shadow, as a share of the
///                shadow's diameter in plan: some hundredths where that very ground is drawn, half where others of its
///                levels of detail are.
/// @param drawn   the ground, if it is drawn triangle by triangle: what isDecal() there is left out; else null.
///
/// Threads any number, each with its own `into`. Cost  linear in the corners; of a drape in its triangles.
void shadowPrisms(const Ground& ground, const PackedShadows& shadows, double margin, const HeightPyramid* drawn,
                  ShadowPrisms& into);

} // namespace gnomon
