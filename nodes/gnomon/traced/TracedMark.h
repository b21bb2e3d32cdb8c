// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/gl/ResolvedDepth.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <memory>

namespace gnomon {

/// Marks of one light in one view: a ray to the light from where the depth buffer says a surface is.
class TracedMark : public MarkJob {
public:
    std::shared_ptr<const RayScene> scene;   ///< casters, about their mesh's origin.
    std::shared_ptr<ResolvedDepth> resolved; ///< the technique's, for framebuffers with several samples.
    double rounding = 0.0;                   ///< of the casters' vertices.
    glm::dmat4 clipFromScene{1.0};           ///< as drawn.
    glm::dvec2 pushedBack{0.0};              ///< see ViewFrame.
    glm::dvec4 light{0.0};                   ///< about the same origin; w is 0 or 1.

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;

protected:
    ~TracedMark() override = default;
};

} // namespace gnomon
