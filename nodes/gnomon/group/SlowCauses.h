// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/group/StageLeaves.h>

#include <string>
#include <vector>

namespace gnomon {

/// What a technique shows in one view.
struct ShownByTechnique {
    const std::vector<ShadowLight>& lights;
    const Casters& casters;
    const Receiving& receiving;
    bool marks;        ///< it has something to draw; else it has said why not, or is out of sight.
    double depthSteps; ///< the largest of Mark::depthSteps; 0 if no mark depends on depth.
};

/// Finds what keeps lights from all that is seen; which surface stays lit though a shadow can reach it, unless it has that of
/// another technique of the same group; that the shadows of what is far away cannot be placed by depth; and which receiver is drawn
/// off its place because its vertices lie far from their origin.
///
/// Cost    see LitCauses.h, and for planes a look at the triangles of what lies close to them: tenths of a second in large scenes.
/// @return causes of CauseKind::Slow. Reads the graph: call in cull.
std::vector<std::string> slowCauses(const TechniqueInStage& asked, const ShownByTechnique& shown);

} // namespace gnomon
