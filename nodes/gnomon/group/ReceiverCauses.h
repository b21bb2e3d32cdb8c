// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/group/StageLeaves.h>

#include <string>
#include <vector>

namespace gnomon {

/// Why a view is no picture of the scene, in which shadows could fall; empty if it is one. A program over all that takes
/// neither light nor normals nor textures draws data, as identifiers of objects are.
std::string whyNoPicture(const EnlistedTechnique& entry);

/// Those of the leaves that receive from a technique, as its lens sees them: its named receiver's, or all.
Leaves receivingOf(const EnlistedTechnique& entry, const std::vector<DrawnLeaf>& leaves, osgUtil::RenderStage& stage);

/// A technique in the stage that it was met in.
struct TechniqueInStage {
    const EnlistedTechnique& entry;
    const std::vector<EnlistedTechnique>& all; ///< that were met there.
    const StageLeaves& drawn;
    osgUtil::RenderStage& stage;
};

/// Says what a technique's group, or its named receiver, draws through a lens that no technique is asked for.
/// @return true if it has.
bool reportOtherLens(const TechniqueInStage& asked);

/// Says why a named receiver gets no shadow. One that is out of sight is nothing to report.
void reportNoReceiver(const EnlistedTechnique& entry, osgUtil::RenderStage& stage);

/// What a technique receives with in one view.
struct Receiving {
    Leaves early; ///< before the bin.
    Leaves late;
};
/// Says what of the receivers' states keeps shadows from them, or makes them wrong.
void reportReceiverStates(const TechniqueInStage& asked, const Receiving& receiving);

} // namespace gnomon
