// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// Settings of a TerrainShadowGeode, with their defaults.
///
/// Use it to keep them apart from a node.
struct TerrainShadowOptions {
    /// How a caster's shadow is computed.
    enum Method : int {
        BOX, ///< The bounding-box method as published: a pentagon a caster.
        HULL ///< The silhouettes of the caster's convex parts, followed along the light into the ground.
    };

    /// What a pixel at the edge of a shadow gets.
    enum Edges : int {
        HARD, ///< All of the light or nothing, as its middle.
        SMOOTH ///< The share that reaches it, where the frame has one sample a pixel. Else edges are as smooth as samples are.
    };

    /// Method. Default HULL: it is exact for convex casters and prisms, on any terrain.
    Method method = HULL;
    /// Edges of shadows. Default HARD.
    Edges edges = HARD;

    /// True if a pixel may get a part of the light.
    bool fades() const { return edges == SMOOTH; }
};

} // namespace gnomon
