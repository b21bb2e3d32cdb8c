// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>

namespace gnomon {

/// Leaves of a stage that are drawn after its opaque bins and receive all the same.
///
/// They have bounds and write depth, and no constant alpha lets what is behind shine through all of them. Loaders put whatever has a
/// texture with an alpha channel among the transparent things.
struct LateReceivers {
    std::vector<DrawnLeaf> leaves;
    std::vector<DrawnLeaf>
        combined; ///< do not receive, because a logic operation combines them with what stands behind.
    osgUtil::RenderBin* last = nullptr; ///< the stage's last bin that draws some of them; null if there are none.
};

/// Those in bin `number` of the stage and later ones. Call it in cull.
LateReceivers lateReceivers(osgUtil::RenderStage& stage, int number);

} // namespace gnomon
