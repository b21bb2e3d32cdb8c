// SPDX-License-Identifier: MIT
#include <gnomon/FrameCauses.h>
#include <gnomon/ShadowBin.h>
#include <gnomon/StageEffectNode.h>
#include <gnomon/SubgraphCull.h>

namespace gnomon {

StageEffectNode::StageEffectNode() : _diagnosis(new FrameCauses) {}

StageEffectNode::StageEffectNode(const StageEffectNode& other, const osg::CopyOp& copyOp)
    : osg::Group(other, copyOp), _options(other._options), _diagnosis(new FrameCauses) {}

StageEffectNode::~StageEffectNode() = default;

std::vector<std::string> StageEffectNode::diagnose() const { return _diagnosis->all(); }

void StageEffectNode::report(unsigned frame, const std::string& cause) const {
    _diagnosis->add(frame, described(*this), cause);
}

void StageEffectNode::traverse(osg::NodeVisitor& visitor) {
    osg::Group::traverse(visitor);
    osgUtil::CullVisitor* cull = visitor.asCullVisitor();
    if (cull && !isSubgraphCull(visitor)) enlist(*cull);
}

void StageEffectNode::enlist(osgUtil::CullVisitor& cull) {
    osgUtil::RenderStage* stage = cull.getCurrentRenderBin()->getStage();
    _diagnosis->begin(frameOf(cull), stage);
    if (cull.getViewport() != stage->getViewport())
        report(frameOf(cull), "is under a nested camera with a viewport of its own, where it would draw elsewhere: set "
                              "that camera's render order to PRE_RENDER or POST_RENDER.");
    else if (const osg::ref_ptr<StageEffect> effect = makeEffect(cull))
        ShadowBin::of(stage).enlist(*effect, _options);
}

} // namespace gnomon
