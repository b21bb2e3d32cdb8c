// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HaloNode.h>
#include <gnomon/compositor/ViewEffect.h>
#include <gnomon/effects/SubgraphCull.h>

namespace gnomon {

class ScreenPass;

/// The halo of one node in one view.
class HaloEffect : public ViewEffect {
public:
    HaloEffect() : ViewEffect(Turn::Last) {}

    osg::ref_ptr<const HaloNode> node;
    osg::ref_ptr<SubgraphCull> children;
    std::vector<osg::Matrixd> larger; ///< eye space from drawable, of each of children->leaves(); empty for PIXELS.
    unsigned frameNumber = 0;

    void prepare(osgUtil::RenderStage& stage, const std::vector<DrawnLeaf>& leaves) override;
    void draw(const CompositorStage& draw) const override;

private:
    void markRim(const CompositorStage& draw, unsigned bit) const;
    void blend(ScreenPass& screen) const;
    void blendEachTriangle(const CompositorStage& draw) const;

    std::vector<DrawnLeaf> _leaves, _larger;
    std::vector<osg::ref_ptr<osgUtil::RenderLeaf>> _own; ///< what `_larger` points to.
};

} // namespace gnomon
