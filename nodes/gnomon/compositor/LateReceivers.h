// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>

namespace gnomon {

/// Leaves of a stage that are drawn after its opaque bins and receive all the same.
///
/// They have bounds and write depth, and neither a constant alpha nor that of a texture lets what is behind shine through. Loaders
/// put whatever has a texture with an alpha channel among the transparent things.
///
/// Limits  of a program's alpha nothing is known: such leaves receive where it is 1.
struct LateReceivers {
    std::vector<DrawnLeaf> leaves;
    std::vector<DrawnLeaf>
        combined;                 ///< do not receive, because a logic operation combines them with what stands behind.
    std::vector<DrawnLeaf> torn;  ///< do not receive, because their alpha is 1 in some parts only.
    std::vector<DrawnLeaf> clear; ///< do not receive, because what stands behind shines through all of them.
    osgUtil::RenderBin* last = nullptr; ///< the stage's last bin that draws some of them; null if there are none.
};

/// Those in bin `number` of the stage and later ones. Call it in cull.
LateReceivers lateReceivers(osgUtil::RenderStage& stage, int number);

} // namespace gnomon
