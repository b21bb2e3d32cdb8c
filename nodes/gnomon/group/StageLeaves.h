// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/Fingerprint.h>
#include <gnomon/compositor/LateReceivers.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/group/ProgramCauses.h>

#include <map>

namespace gnomon {

/// What one stage draws, as its ShadowBin of number `number` sees it after the cull.
struct StageLeaves {
    /// @param all  false: those that are drawn before the bin are enough.
    StageLeaves(osgUtil::RenderStage& stage, int number, bool all)
        : early(leavesBelow(stage, number)), late(all ? lateReceivers(stage, number) : LateReceivers()) {
        if (!all) return;
        programs = ProgramCauses(stage);
        for (const auto* leaves : {&early, &late.leaves}) findDisplaced(*leaves);
    }

    /// Of what is drawn, wherever it is.
    std::uint64_t fingerprint() const {
        Fingerprint drawables;
        for (const auto* leaves : {&early, &late.leaves})
            for (const DrawnLeaf& entry : *leaves) drawables.mix(entry.leaf->_drawable.get());
        return drawables.value();
    }

    std::vector<DrawnLeaf> early; ///< before the bin.
    LateReceivers late;
    ProgramCauses programs;
    std::map<const osgUtil::RenderLeaf*, DepthPlacement> displaced; ///< those whose depths are not the projection's.

private:
    void findDisplaced(const std::vector<DrawnLeaf>& leaves) {
        const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
        DepthPlacement placement;
        for (const DrawnLeaf& entry : leaves) {
            if (entry.leaf->_parent != graph) placement = depthPlacementOf(graph = entry.leaf->_parent);
            if (!placement.isPlain()) displaced[entry.leaf] = placement;
        }
    }
};

} // namespace gnomon
