// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// The cures for the classic faults of planar shadows. PlanarShadowNode explains each.
struct PlanarCures {
    bool stencil = true, offset = true, clip = true; ///< True: the cure is on.
};

} // namespace gnomon
