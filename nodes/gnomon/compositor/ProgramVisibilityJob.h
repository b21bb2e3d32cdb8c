// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>

#include <osg/StateSet>

namespace gnomon {

/// A job that marks nothing, but lets the programs of a view's drawables find out what share of a light arrives.
class ProgramVisibilityJob : public MarkJob {
public:
    osg::ref_ptr<osg::StateSet> state; ///< applied under all that the stage draws.

    /// Draws what the state refers to, before anything else of the stage is drawn. Called within a CleanState.
    /// @return why that cannot be, as a cause for ShadowTechnique::report(); empty if all is well.
    virtual std::string drawAhead(osg::RenderInfo& renderInfo) const = 0;

    double depthSteps() const final { return 0.0; }
    std::string mark(osg::RenderInfo&, ScreenPass&, unsigned) const final { return ""; }

protected:
    ~ProgramVisibilityJob() override = default;
};

} // namespace gnomon
