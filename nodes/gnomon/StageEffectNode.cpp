// SPDX-License-Identifier: MIT
#include <gnomon/ShadowBin.h>
#include <gnomon/StageEffectNode.h>
#include <gnomon/SubgraphCull.h>

namespace gnomon {

void StageEffectNode::report(unsigned frame, const std::string& cause) const {
    _causes.add(frame, described(*this) + ": " + cause);
}

void StageEffectNode::traverse(osg::NodeVisitor& visitor) {
    osg::Group::traverse(visitor);
    osgUtil::CullVisitor* cull = visitor.asCullVisitor();
    if (cull && !isSubgraphCull(visitor)) enlist(*cull);
}

void StageEffectNode::enlist(osgUtil::CullVisitor& cull) {
    osgUtil::RenderStage* stage = cull.getCurrentRenderBin()->getStage();
    _causes.begin(frameOf(cull), stage);
    if (cull.getViewport() != stage->getViewport())
        report(frameOf(cull), "a nested camera above this node has a viewport of its own, where the effect would be "
                              "drawn in the wrong place. Set that camera's render order to PRE_RENDER or POST_RENDER.");
    else if (const osg::ref_ptr<StageEffect> effect = makeEffect(cull))
        ShadowBin::of(stage).enlist(*effect);
}

} // namespace gnomon
