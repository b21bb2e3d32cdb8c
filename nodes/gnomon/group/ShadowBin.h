// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Casters.h>
#include <gnomon/group/ComposeBin.h>
#include <gnomon/group/StageLeaves.h>
#include <gnomon/group/ViewLights.h>

#include <deque>
#include <optional>
#include <vector>

namespace gnomon {

/// The compositor: takes each light away from the pixels that techniques mark, in one RenderStage. All groups share it.
///
/// It runs after all opaque bins of the stage and before the transparent ones. Lights and leaves are asked for after the
/// whole cull, so their order in the graph does not matter; nothing is kept from frame to frame or view to view.
/// Where leaves of later bins receive too (LateReceivers), a ComposeBin runs after the last of them. Where code of the
/// application's own may clear depth in an earlier bin, another runs before that one.
///
/// Cost    scissored to where marks can fall: the marks, a stencil clear, and the leaves that the marks can touch, once
///         more, big ones in part (TriangleClusters). One job with a named receiver that nothing else shows on: its leaves
///         alone, at equal depth. Marks that fade: a few more steps, and each set of lights that are gone once more.
/// Needs   one stencil bit a relit light, one more for several jobs or for receivers that others show on; for marks
///         that fade alpha bits; alpha is 1 afterwards where something stands within the marks' bounds. Where the
///         framebuffer lacks them, or leaves use its stencil, all is done in one of the kit's own (CompositorTarget). A stage that clears depth clears stencil too,
///         unless bits are reserved or in use. Interlaced stereo keeps its stencil bit.
/// Limits  three relit lights; the others stay unshadowed. Unlit receivers, those without colour, and those whose program
///         reads no OpenGL light's colour, take a factor; where an opaque leaf has a stencil test of its own all is blended; under soft
///         edges what blends or writes no depth takes the factor. diagnose() says so.
///         Under soft edges opaque layers at the very same depth are mixed one after the other. A leaf that sets no
///         colour of its own and takes that of the leaf before it may take another. Reversed depth is refused.
///         Of several colour attachments the first alone is shadowed; the others stay as the leaves have drawn them.
///         What is drawn in bin 8 or later receives where it hides what is behind: it writes depth and its alpha is 1, or
///         of an alpha that differs from place to place, a half or more. Then edges are hard there. What one alpha lets shine
///         through receives nothing there; nor does what is seen through it, if it writes depth and both are late and none is
///         clear in parts. A leaf that a logic operation draws receives there if it hides what is behind; diagnose() names the
///         others.
/// Threads sort in the cull thread, draw in the draw thread, as every RenderBin.
class ShadowBin : public ComposeBin {
public:
    ShadowBin() = default;
    ShadowBin(const ShadowBin& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : ComposeBin(other, copyOp) {}
    osg::Object* cloneType() const override { return new ShadowBin; }
    osg::Object* clone(const osg::CopyOp& copyOp) const override { return new ShadowBin(*this, copyOp); }
    const char* className() const override { return "ShadowBin"; }

    /// The bin of `stage`, made if it has none: number 8, or the next lower one that another kind of bin has not taken.
    static ShadowBin& of(osgUtil::RenderStage* stage);

    void enlist(const EnlistedTechnique& technique);
    /// The same for what is no shadow: mirror images and halos.
    void enlist(ViewEffect& effect, const CompositorOptions& options);

    void reset() override;
    /// Also lets the stage clear its stencil buffer, if it clears depth and no bits are reserved: the two together cost
    /// less than a clear of our bits later.
    void sortImplementation() override;

protected:
    ~ShadowBin() override = default;

private:
    struct Start {
        double time; ///< see secondsNow().
        std::size_t jobs, lateJobs;
    };
    void askTechniques();
    struct ViewCasters;
    const Casters& castersOf(const EnlistedTechnique& entry, std::deque<ViewCasters>& known);
    std::size_t askTechnique(const EnlistedTechnique& entry, const StageLeaves& drawn, std::deque<ViewCasters>& known);
    void askForMarks(const EnlistedTechnique& entry, const GroupLights& found, const Casters& casters,
                     const StageLeaves& drawn);
    void addJobs(const TechniqueInStage& asked, const GroupLights& found, const Casters& casters,
                 const Receiving& receiving);
    void clearWithStage();
    void saveColorsIfBlended(const StageLeaves& drawn);
    std::optional<Start> startIfWatched(const EnlistedTechnique& entry) const;
    void recordCull(const EnlistedTechnique& entry, const Start& start, std::size_t lights) const;

    std::vector<EnlistedTechnique> _enlisted;
    std::vector<ShadowJob> _lateJobs; ///< for the bin that composes what is drawn later.
};

} // namespace gnomon
