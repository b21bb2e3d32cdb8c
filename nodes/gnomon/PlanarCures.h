// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// What cures the classic faults of planar shadows; see PlanarShadowNode.
struct PlanarCures {
    bool stencil = true, offset = true, clip = true;
};

} // namespace gnomon
