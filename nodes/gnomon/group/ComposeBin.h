// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CompositorOptions.h>
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/CompositorTarget.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/MaterialHistory.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/compositor/ViewEffect.h>

#include <osgUtil/RenderBin>
#include <osgUtil/RenderStage>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Composes the jobs that it is given over what the stage has drawn before it: in draw, by a Compositor.
///
/// The stage's ShadowBin is one. Where some receivers are drawn later, or depths are cleared in between, the ShadowBin hands
/// their jobs to another, which takes its turn right after what it composes.
///
/// Threads it is filled in cull and draws in draw, as every RenderBin.
class ComposeBin : public osgUtil::RenderBin {
public:
    ComposeBin() = default;
    ComposeBin(const ComposeBin& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osgUtil::RenderBin(other, copyOp) {}
    osg::Object* cloneType() const override { return new ComposeBin; }
    osg::Object* clone(const osg::CopyOp& copyOp) const override { return new ComposeBin(*this, copyOp); }
    const char* libraryName() const override { return "gnomon"; }
    const char* className() const override { return "ComposeBin"; }

    /// The bin that composes what the bin `last` of the stage draws, right after it: a bin below it, or else beside it, or below
    /// the next. Only if that one has a state set of its own it is drawn in between, as is what follows it without a gap.
    static ComposeBin& after(osgUtil::RenderBin& last);

    void reset() override;
    void sortImplementation() override;
    void drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) override;
    unsigned computeNumberOfDynamicRenderLeaves() const override;
    void releaseGLObjects(osg::State* state) const override;

protected:
    ~ComposeBin() override = default;

    bool isIdle() const { return composesNothing() && !_saves; }
    /// Hands jobs to another bin, which composes what the stage draws before bin number `below`.
    void handOn(std::vector<ShadowJob>& jobs, ComposeBin& to, int below) const;
    /// Saves the frame for another bin, which then composes what is drawn from this bin on over it.
    /// @param hiding  leaves of those that hide what is behind, all over or in parts.
    void saveFor(ComposeBin& to, const std::vector<DrawnLeaf>& hiding);

    std::vector<ShadowJob> _jobs;
    std::vector<osg::ref_ptr<ViewEffect>> _effects;
    std::vector<osg::ref_ptr<DrawWatch>> _watches; ///< never null.
    std::vector<FrameReport> _waiting; ///< of techniques, for that the stage can be composed in, see StageVerdict.
    bool _holdsFrame = false;          ///< what it draws may be another in the next frame.
    bool _sharesStencil = false;       ///< leaves of the stage test or mark the stencil buffer themselves.
    CompositorOptions _options;        ///< of all whose jobs these are.
    osg::ref_ptr<SavedFrame> _saves;   ///< of what stands once all is composed; null: nobody asks for it.

private:
    bool composesNothing() const { return _jobs.empty() && _effects.empty() && _waiting.empty(); }
    bool holdsFrame() const { return _holdsFrame && !isIdle(); }
    void sortAsAsked();
    bool isStencilZero(const std::vector<DrawnLeaf>& leaves) const;
    std::string compose(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous);
    std::string compose(osg::RenderInfo& renderInfo, std::vector<DrawnLeaf> leaves, MaterialHistory& materials);
    bool findDepths(const CompositorStage& draw, const CompositorTarget& target, const ScreenRect& bounds) const;
    TargetNeeds needs(const std::vector<DrawnLeaf>& leaves) const;
    void tell(const std::string& cause);
    std::optional<double> drawStartIfWatched() const;
    void recordDraw(double begin) const;

    std::optional<DrawnSince> _since; ///< nullopt: all that the stage has drawn is drawn again.
    std::optional<int> _below;        ///< nullopt: composes what the stage draws before this bin.
};

} // namespace gnomon
