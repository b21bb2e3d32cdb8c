// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/FrameReport.h>
#include <gnomon/compositor/ViewEffect.h>
#include <gnomon/effects/SubgraphCull.h>

#include <osg/Vec4f>

#include <vector>

namespace gnomon {

class ScreenPass;

/// The halo of one node in one view.
class HaloEffect : public ViewEffect {
public:
    HaloEffect() : ViewEffect(Turn::Last) {}

    int width = 0;           ///< of a rim in pixels; 0 if the children are made larger instead.
    osg::Vec4f color;        ///< red, green, blue and opacity.
    bool stencilCure = true; ///< see HaloNode.
    osg::ref_ptr<SubgraphCull> children;
    std::vector<osg::Matrixd>
        larger; ///< eye space from drawable, of each of children->leaves(); empty where there is a rim in pixels.

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
