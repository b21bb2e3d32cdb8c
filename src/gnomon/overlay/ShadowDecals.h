// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/onterrain/PackedShadows.h>

#include <optional>

namespace gnomon {

/// Shadows as triangles in the ground's own planes: drawn over that very ground, cut as it is, they cover what of it is in
/// shadow.
struct ShadowDecals {
    std::vector<glm::vec3> vertices; ///< about the shadows' origin.
    std::vector<unsigned> triangles; ///< three places in `vertices` each, counter-clockwise from above.
    glm::dvec3 low{0.0}, high{0.0};  ///< bounds of `triangles`, about the origin.
};

/// Whether a decal is what shows a shadow best: it is a fan, or a drape where no fan would do, over few of the ground's
/// cells. For others there are prisms.
/// @param origin  see PackedShadows.
bool isDecal(const HeightPyramid& ground, const PackedShadow& shadow, const glm::dvec3& origin);
/// The cells that it is over; nullopt of what is to be no decal, and beside the ground.
std::optional<HeightPyramid::Cells> decalCells(const HeightPyramid& ground, const PackedShadow& shadow,
                                               const glm::dvec3& origin);

/// Of those that are to be decals. Memory that `into` has is used again.
///
/// Threads any number, each with its own `into`. Cost  a fan on one triangle of the ground is itself; all else is clipped to
/// the triangles that it lies on.
void shadowDecals(const HeightPyramid& ground, const PackedShadows& shadows, ShadowDecals& into);

} // namespace gnomon
