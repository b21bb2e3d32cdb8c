// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// Settings of a PlanarShadowNode, with their defaults.
struct PlanarShadowOptions {
    /// What a pixel at the edge of a shadow gets.
    enum Edges : int {
        HARD, ///< All of the light or nothing, as its middle.
        SMOOTH ///< The share that reaches it, where the frame has one sample a pixel. Else edges are as smooth as samples are.
    };

    /// Edges of shadows. Default HARD.
    Edges edges = HARD;

    /// True if a pixel may get a part of the light.
    bool fades() const { return edges == SMOOTH; }
};

} // namespace gnomon
