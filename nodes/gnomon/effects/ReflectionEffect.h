// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Selection.h>
#include <gnomon/base/FrameReport.h>
#include <gnomon/compositor/ViewEffect.h>
#include <gnomon/effects/SubgraphCull.h>
#include <gnomon/gl/FrameColorCopy.h>

#include <glm/vec4.hpp>
#include <osg/Vec3f>

#include <memory>
#include <vector>

namespace gnomon {

/// What one mirror shows in one view.
class ReflectionEffect : public ViewEffect {
public:
    ReflectionEffect() : ViewEffect(Turn::BeforeBlending) {}

    osg::ref_ptr<const osg::Node> node; ///< whose effect it is.
    Selection surface;
    osg::Vec3f reflectance;
    bool stencilCure = true;             ///< see PlanarReflectionNode.
    osg::ref_ptr<SubgraphCull> mirrored; ///< the children, as their leaves stand in the mirror.
    glm::dvec4 eyePlane{0.0};            ///< unit normal, towards the side that is mirrored.
    std::shared_ptr<FrameColorCopy> saved;

    void prepare(osgUtil::RenderStage& stage, const std::vector<DrawnLeaf>& leaves) override;
    void draw(const CompositorStage& draw) const override;

private:
    void drawSurface(const CompositorStage& draw, unsigned write, bool standing) const;
    void drawImage(const CompositorStage& draw, unsigned reference, unsigned bit) const;
    void mirrorPositions(const CompositorStage& draw) const;
    void restorePositions(const CompositorStage& draw) const;
    void mix(const CompositorStage& draw, unsigned bit) const;

    std::vector<DrawnLeaf> _surface, _leaves;
    ScreenRect _bounds = wholeScreen;
};

} // namespace gnomon
