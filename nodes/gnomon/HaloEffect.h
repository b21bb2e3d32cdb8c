// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HaloNode.h>
#include <gnomon/StageEffect.h>
#include <gnomon/SubgraphCull.h>

namespace gnomon {

class ScreenPass;

/// The halo of one node in one view.
class HaloEffect : public StageEffect {
public:
    HaloEffect() : StageEffect(Turn::Last) {}

    osg::ref_ptr<const HaloNode> node;
    osg::ref_ptr<SubgraphCull> children;
    std::vector<osg::Matrixd> larger; ///< eye space from drawable, of each of children->leaves(); empty for PIXELS.
    unsigned frameNumber = 0;

    void prepare(osgUtil::RenderStage& stage, const std::vector<StageLeaf>& leaves) override;
    void draw(const StageDraw& draw) const override;

private:
    void markRim(const StageDraw& draw, unsigned bit) const;
    void blend(ScreenPass& screen) const;
    void blendEachTriangle(const StageDraw& draw) const;

    std::vector<StageLeaf> _leaves, _larger;
    std::vector<osg::ref_ptr<osgUtil::RenderLeaf>> _own; ///< what `_larger` points to.
};

} // namespace gnomon
