// SPDX-License-Identifier: MIT
#include <gnomon/EffectNode.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/base/OptimizerGuard.h>
#include <gnomon/effects/SubgraphCull.h>
#include <gnomon/group/ShadowBin.h>

namespace gnomon {

EffectNode::EffectNode() : _diagnosis(new FrameDiagnosis) {}

EffectNode::EffectNode(const EffectNode& other, const osg::CopyOp& copyOp)
    : osg::Group(other, copyOp), _options(other._options), _diagnosis(new FrameDiagnosis) {}

EffectNode::~EffectNode() = default;

std::vector<std::string> EffectNode::diagnose() const { return _diagnosis->all(); }

void EffectNode::report(unsigned frame, const std::string& cause) const { reportIn(frame)(cause); }

FrameReport EffectNode::reportIn(unsigned frame) const { return {_diagnosis, described(*this), frame}; }

void EffectNode::traverse(osg::NodeVisitor& visitor) {
    if (keptFromOptimizer(*this, visitor)) return;
    osg::Group::traverse(visitor);
    osgUtil::CullVisitor* cull = visitor.asCullVisitor();
    if (cull && !isSubgraphCull(visitor)) enlist(*cull);
}

void EffectNode::ascend(osg::NodeVisitor& visitor) {
    if (!endsForOptimizer(visitor)) osg::Group::ascend(visitor);
}

void EffectNode::enlist(osgUtil::CullVisitor& cull) {
    osgUtil::RenderStage* stage = cull.getCurrentRenderBin()->getStage();
    _diagnosis->begin(frameOf(cull), timeOf(cull), stage);
    if (cull.getViewport() != stage->getViewport())
        report(frameOf(cull), "a nested camera above this node has a viewport of its own, where the effect would be "
                              "drawn in the wrong place. Set that camera's render order to PRE_RENDER or POST_RENDER.");
    else if (const osg::ref_ptr<ViewEffect> effect = makeEffect(cull))
        ShadowBin::of(stage).enlist(*effect, _options);
}

} // namespace gnomon
