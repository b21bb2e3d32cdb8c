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

    /// Method. Default HULL: it is exact for convex casters and prisms, on any terrain.
    Method method = HULL;
};

} // namespace gnomon
