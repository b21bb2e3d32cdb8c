// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>

namespace gnomon {

/// Leaves of a stage that are drawn after its opaque bins and receive all the same.
///
/// They hide what is behind, all over or where their alpha is a half or more: leaves and nets do. Loaders put whatever has a
/// texture with an alpha channel among the transparent things. What has one alpha below 1 all over, as glass has, does not.
///
/// Limits  of a program's alpha nothing is known: such leaves may be clear anywhere.
struct LateReceivers {
    std::vector<DrawnLeaf> leaves;
    std::vector<DrawnLeaf>
        combined;                 ///< do not receive, because a logic operation combines them with what stands behind.
    std::vector<DrawnLeaf> clear; ///< do not receive, because what stands behind shines through all of them.
    bool areCut = false;          ///< some are clear in parts: the depth that stands there may be theirs all the same.
    osgUtil::RenderBin* last = nullptr; ///< the stage's last bin that draws some of them; null if there are none.
};

/// Those in bin `number` of the stage and later ones. Call it in cull.
LateReceivers lateReceivers(osgUtil::RenderStage& stage, int number);

/// The first of some leaves of the stage that blends and hides what is behind in some parts only; null if there is none.
const osgUtil::RenderLeaf* firstCut(const std::vector<DrawnLeaf>& leaves, osgUtil::RenderStage& stage);

} // namespace gnomon
