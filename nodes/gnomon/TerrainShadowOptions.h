// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// Settings of a TerrainShadowGeode, with their defaults.
///
/// Use it to set both at once, or to keep them apart from a node. A technique's setters change one each.
struct TerrainShadowOptions {
    /// How a caster's shadow is computed.
    enum Method : int {
        BOX,  ///< The bounding-box method as published: 12 triangles a caster.
        HULL, ///< Rays from the silhouettes of the caster's convex parts: four triangles for a house.
        DRAPE ///< The ground's own triangles, cut by the shadow: exact if error is 0.
    };

    /// Method. Default HULL: it has the fewest triangles, and drapes if it must.
    Method method = HULL;
    /// Largest error of a draped edge in plan, group's unit, 0 (exact) or more. Default 0.1: a decimetre if the unit is
    /// the metre.
    double error = 0.1;
};

} // namespace gnomon
