// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/group/StageLeaves.h>

#include <string>

namespace gnomon {

/// Why a view is no picture of the scene, in which shadows could fall; empty if it is one. A program over all that takes
/// neither light nor normals nor textures draws data, as identifiers of objects are.
std::string whyNoPicture(const EnlistedTechnique& entry);

/// Says what a technique's group, or its named receiver, draws through a lens that no technique is asked for.
/// @return true if it has.
bool reportOtherLens(const TechniqueInStage& asked);

/// Says why a named receiver gets no shadow. One that is out of sight is nothing to report.
void reportNoReceiver(const EnlistedTechnique& entry, osgUtil::RenderStage& stage);

/// Says what of the receivers' states keeps shadows from them, or makes them wrong.
void reportReceiverStates(const TechniqueInStage& asked, const Receiving& receiving);

} // namespace gnomon
