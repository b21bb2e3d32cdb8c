// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/StencilMarks.h>
#include <gnomon/compositor/ViewEffect.h>

#include <map>
#include <vector>

namespace gnomon {

/// True if a job, alone, is composed without stencil or alpha: it darkens pixels itself. @param leaves  drawn before.
bool needsNoMarks(const ShadowJob& job, const std::vector<DrawnLeaf>& leaves);

/// What a ComposeBin does in draw: marks, takes light away where marked, and leaves the stencil bits it used at zero.
/// Jobs that fade go to the FadingCompositor.
class Compositor {
public:
    /// @param draw  must outlive this.
    explicit Compositor(const CompositorStage& draw);

    /// @param effects  drawn in their turn.
    void compose(const std::vector<ShadowJob>& jobs, const std::vector<osg::ref_ptr<ViewEffect>>& effects);

private:
    bool areFading(const Jobs& jobs) const;
    void relightAny(const Jobs& jobs, std::map<float, Jobs>& blended);
    bool composeDirectly(const Jobs& jobs);
    void relight(const Jobs& wanted);
    static void blendInstead(const Jobs& jobs, std::map<float, Jobs>& blended, const std::string& cause);
    void drawDebugViews(const std::vector<ShadowJob>& jobs) const;
    void blendAny(const Jobs& jobs, float dark);
    bool darkenDirectly(const Jobs& jobs, float dark) const;
    void blend(const Jobs& jobs, float dark);

    void replay(const MarkedLights& dark, unsigned lightBits, std::vector<ReplayedLeaf>& catchers);
    void replay(const std::vector<ReplayedLeaf>& leaves, LeafReplay::Overlay overlay, const Jobs& jobs);
    bool darkenUnlit(const Jobs& jobs, unsigned lightBits);
    void darken(const std::vector<ReplayedLeaf>& catchers, unsigned lightBits, const Jobs& jobs) const;
    bool reportNotRelit(const osgUtil::RenderLeaf& leaf, const Jobs& jobs) const;

    void resetMarked(unsigned where, const ScreenRect& bounds) const;
    void writeBackground(ScreenPass& screen) const;
    bool isBackgroundKnown() const;

    const CompositorStage& _draw;
    const StencilMarks _marks; ///< hard.
};

} // namespace gnomon
