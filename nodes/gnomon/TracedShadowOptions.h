// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// Settings of a TracedShadowTechnique, with their defaults.
struct TracedShadowOptions {
    /// What a pixel at the edge of a shadow gets.
    enum Edges : int {
        HARD,  ///< All of the light or nothing, by one ray.
        SMOOTH ///< The share that reaches it, by 16 rays.
    };

    /// Edges of shadows. Default HARD.
    Edges edges = HARD;

    /// True if a pixel may get a part of the light.
    bool fades() const { return edges == SMOOTH; }
};

} // namespace gnomon
