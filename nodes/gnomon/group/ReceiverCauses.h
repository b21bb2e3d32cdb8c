// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/group/EnlistedTechnique.h>
#include <gnomon/group/StageLeaves.h>
#include <gnomon/group/ViewFrame.h>

#include <vector>

namespace gnomon {

/// What a technique's prepare() is told of the view, but for its receivers.
ViewFrame viewOf(const EnlistedTechnique& entry, const osg::Viewport& viewport);

/// Those of the leaves that receive from a technique: its named receiver's, or all that its lens sees.
Leaves receivingOf(const EnlistedTechnique& entry, const std::vector<DrawnLeaf>& leaves, osgUtil::RenderStage& stage);

/// Says why a named receiver gets no shadow. One that is out of sight is nothing to report.
void reportNoReceiver(const EnlistedTechnique& entry, osgUtil::RenderStage& stage);

/// What a technique receives with in one view.
struct Receiving {
    const Leaves& early; ///< before the bin.
    const Leaves& late;
    const StageLeaves& drawn;
};
/// Says what of the receivers' states keeps shadows from them, or makes them wrong.
void reportReceiverStates(const EnlistedTechnique& entry, const Receiving& receiving, osgUtil::RenderStage& stage);

/// Says what keeps lights from all that is seen.
void reportEnclosers(const EnlistedTechnique& entry, const std::vector<ShadowLight>& lights,
                     const CasterDrawables& casters, const Leaves& receiving, osgUtil::RenderStage& stage);

/// Says which surface stays lit though a shadow can reach it. For techniques that shadow some of what is in view.
/// @param all  techniques of the stage: that surface may have the shadow of another one of the same group.
void reportUnshadowed(const EnlistedTechnique& entry, const std::vector<EnlistedTechnique>& all,
                      const std::vector<ShadowLight>& lights, const CasterDrawables& casters, const StageLeaves& drawn,
                      osgUtil::RenderStage& stage);

/// Says that the shadows of what is far away cannot be placed by depth. For techniques whose marks depend on it.
/// @param steps  see MarkJob::depthSteps(), above 0.
void reportCoarseDepth(const EnlistedTechnique& entry, const ShadowLight& light, const CasterDrawables& casters,
                       osgUtil::RenderStage& stage, double steps);

} // namespace gnomon
