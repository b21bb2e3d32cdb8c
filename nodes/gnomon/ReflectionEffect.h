// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/SavedColors.h>
#include <gnomon/StageEffect.h>
#include <gnomon/SubgraphCull.h>

#include <glm/vec4.hpp>

namespace gnomon {

/// What one mirror shows in one view.
class ReflectionEffect : public StageEffect {
public:
    ReflectionEffect() : StageEffect(Turn::BeforeBlending) {}

    osg::ref_ptr<const PlanarReflectionNode> node;
    osg::ref_ptr<SubgraphCull> mirrored; ///< the children, as their leaves stand in the mirror.
    glm::dvec4 eyePlane{0.0};            ///< unit normal, towards the side that is mirrored.
    std::shared_ptr<SavedColors> saved;
    unsigned frameNumber = 0;

    void prepare(osgUtil::RenderStage& stage, const std::vector<StageLeaf>& leaves) override;
    void draw(const StageDraw& draw) const override;

private:
    void drawSurface(const StageDraw& draw, unsigned write, bool standing) const;
    void drawImage(const StageDraw& draw, unsigned reference, unsigned bit) const;
    void mirrorPositions(const StageDraw& draw) const;
    void restorePositions(const StageDraw& draw) const;
    void mix(const StageDraw& draw, unsigned bit) const;

    std::vector<StageLeaf> _surface, _leaves;
    ScreenRect _bounds = wholeScreen;
};

} // namespace gnomon
