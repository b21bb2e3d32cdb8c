// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace gnomon {

/// Closed prisms over a rectangle of plan, in layers of which none overlaps itself.
struct PrismLayers {
    glm::dvec2 low, high;
    unsigned layers;   ///< 1 or more.
    unsigned mostOver; ///< how many of all its prisms hold one point at most.
};

/// Layers of one of the tiles, drawn one after the other.
struct LayerSlice {
    std::size_t tile;
    unsigned first, count;
};

/// What may be counted together: in a round at most `capacity` prisms hold any point.
///
/// @param capacity  what a counter can count to: 2^bits - 1, of a single bit 1. 1 or more.
/// @return rounds, none empty; each tile's layers once, whole tiles where they fit.
///
/// Cost  a look at the cells of a grid that each tile reaches into; where these do not tell that one round holds all, a sort,
///       and a comparison a pair of tiles whose extents along x overlap.
std::vector<std::vector<LayerSlice>> stencilBatches(const std::vector<PrismLayers>& tiles, unsigned capacity);

} // namespace gnomon
