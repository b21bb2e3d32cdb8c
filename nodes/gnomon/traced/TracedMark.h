// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/gl/ResolvedDepth.h>
#include <gnomon/traced/TracedFrames.h>

#include <glm/vec2.hpp>

#include <memory>

namespace gnomon {

/// Marks of one light in one view: a ray to the light from where the depth buffer says a surface is.
class TracedMark : public MarkJob {
public:
    TracedFrame frame;                       ///< without the picture.
    std::shared_ptr<TracedFrames> frames;    ///< the technique's.
    std::shared_ptr<ResolvedDepth> resolved; ///< the technique's, for framebuffers with several samples.
    double rounding = 0.0;                   ///< of the casters' vertices.
    glm::dvec2 pushedBack{0.0};              ///< see ViewFrame.

    /// Rays find the surface within what a depth may mean.
    double depthSteps() const override { return 0.0; }
    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;

protected:
    ~TracedMark() override = default;
};

} // namespace gnomon
