// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// The cures for the classic faults of planar shadows. PlanarShadowNode explains each.
struct PlanarCures {
    bool stencil = true; ///< Against double darkening.
    bool offset = true;  ///< Against z-fighting.
    bool clip = true;    ///< Against anti-shadows.
};

} // namespace gnomon
