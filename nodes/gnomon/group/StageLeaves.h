// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/Fingerprint.h>
#include <gnomon/compositor/LateReceivers.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/group/ProgramCauses.h>

#include <map>
#include <optional>

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

    /// Of what is drawn and shaded, wherever it is; nullopt if nothing is.
    std::optional<std::uint64_t> shadedFingerprint() const {
        Fingerprint drawables;
        const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
        bool shaded = false, any = false;
        for (const auto* leaves : {&early, &late.leaves})
            for (const DrawnLeaf& entry : *leaves) {
                if (entry.leaf->_parent != graph) shaded = isShaded(graph = entry.leaf->_parent);
                any = any || shaded;
                if (!shaded) continue;
                drawables.mix(entry.leaf->_drawable.get());
                if (const osg::RefMatrix* place = entry.leaf->_modelview.get())
                    for (int i = 0; i < 3; ++i) drawables.mix((*place)(3, i));
            }
        if (!any) return std::nullopt;
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
