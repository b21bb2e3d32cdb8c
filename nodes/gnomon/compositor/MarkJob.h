// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/LightUniform.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/geometry/ScreenBounds.h>

#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <osg/Referenced>
#include <osg/RenderInfo>
#include <osg/StateSet>
#include <osgUtil/RenderLeaf>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

class ScreenPass;

/// Why marks that lie over each other, and are counted, cannot be drawn.
constexpr const char* noCounter =
    "overlapping shadows need another stencil bit. Leave one more out of CompositorOptions::reservedStencilBits.";

/// One technique's share of one view: marks, in draw, the pixels that one light does not reach.
class MarkJob : public osg::Referenced {
public:
    /// Where marks can fall; everything the compositor does is cut to it.
    ScreenRect screenBounds = wholeScreen;

    /// Leaves on which all of the shadow falls, and in whose surfaces no other leaf has any; null: none are known.
    /// The compositor then cuts the marks to them, and relighting draws them alone.
    std::shared_ptr<const LeafSet> surfaces;
    /// True if that cut is enough: the job need not find out what one sees.
    bool cutBySurfaces = false;

    /// Sets `bit` in the stencil buffer where the light does not reach. The bit is zero before, within the bounds;
    /// other bits, colour and depth stay as they are. Called within a CleanState and `pass`, which is cut to the
    /// bounds; state that is applied on top must be taken back by state.apply().
    /// @return why nothing could be marked, as a cause for ShadowTechnique::report(); empty if all is well.
    virtual std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const = 0;

    /// True if it can darken().
    virtual bool canDarken() const { return false; }
    /// Multiplies what stands by `factor` where the light does not reach, without marks.
    /// @return as mark().
    virtual std::string darken(osg::RenderInfo&, ScreenPass&, float /*factor*/) const { return ""; }

    /// True if mark() needs ScreenPass::counters().
    virtual bool counts() const { return false; }

    /// How many steps of the depth buffer a surface may be off its place for its marks; 0: however many.
    virtual double depthSteps() const { return 1.0; }

    /// True of what relighting alone must darken: what OpenGL has drawn without the light, as far as it could.
    virtual bool relightsOnly() const { return false; }

    /// True if drawView() draws anything.
    virtual bool hasView() const { return false; }
    /// Draws over the finished picture how its marks come about.
    /// @param before  how many other jobs of the view have done so.
    virtual void drawView(osg::RenderInfo&, ScreenPass&, int /*before*/) const {}

    /// False if it is known that no mark falls on this leaf, as a cause of diagnose() should be about what receives.
    virtual bool canReach(const osgUtil::RenderLeaf&) const { return true; }

    /// False for a box if it is known that no mark falls on what is in it.
    using BoxTest = std::function<bool(const osg::BoundingBox&)>;
    /// For boxes of one frame. Default empty: nothing is known.
    virtual BoxTest boxTest(const osg::Matrixd& /*eyeFromBox*/) const { return {}; }

protected:
    ~MarkJob() override = default;
};

/// A job whose edges are soft: each pixel knows what share of the light reaches it. mark() then marks what less than
/// half of the light reaches. Pixels at which nothing stands (far depth) get all of the light.
class SoftMarkJob : public MarkJob {
public:
    /// As mark(), wherever not all of the light arrives; with the share that does in the fragments' alpha. The pass's blending
    /// and colour mask stand.
    virtual std::string markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const = 0;

    /// What drawShare() puts into alpha.
    enum class Share { Arriving, Blocked };
    /// Draws over the pixels that markTouched() marks, and any others; `share` of the light, 0 … 1, in alpha; pixels whose
    /// alpha would be 1 may be left out. The pass's stencil test, blending and colour mask stand.
    virtual std::string drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const = 0;

protected:
    ~SoftMarkJob() override = default;
};

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

class ProgramVisibilityJob;
class SoftMarkJob;

/// True if two views have the same lens: the same but for near and far, which a nested camera finds for itself.
bool isSameLens(const osg::Matrixd& a, const osg::Matrixd& b);

/// A technique's job for one light in one view, and how its marks are to be used.
struct ShadowJob {
    osg::ref_ptr<const MarkJob> marks;
    FrameReport report;  ///< for the technique.
    int light = 0;       ///< OpenGL light number.
    bool relight = true; ///< else blended.
    float dark = 1.0f;
    osg::ref_ptr<const osg::RefMatrix> projection; ///< of the technique's view.
    bool receiverNamed = false;
    std::shared_ptr<const LeafSet> receivers; ///< the leaves of the named receiver, for all jobs; null: none is named.
    bool hidingOnly = false; ///< a receiver loses the light only where it hides what is behind, see LateReceivers.
    std::vector<LightUniform> lightUniforms; ///< of the group.

    /// True if the leaf is of the named receiver.
    bool isNamed(const osgUtil::RenderLeaf* leaf) const { return receivers && receivers->count(leaf) > 0; }
    /// The marks, if their edges are soft; else null.
    const SoftMarkJob* softMarks() const;
    /// The job, if it is for programs alone; else null.
    const ProgramVisibilityJob* programMarks() const;
    /// True if the leaf loses the light where marked: it is of the named receiver, or with none named, of this view.
    bool isReceiver(const osgUtil::RenderLeaf& leaf) const;
    /// True if the leaf is seen through the technique's lens, unlike what a nested camera lays over the view.
    bool isOfView(const osgUtil::RenderLeaf& leaf) const { return isOfView(projectionOf(leaf)); }
    bool isOfView(const osg::Matrixd& lens) const { return isSameLens(lens, *projection); }
};

/// Is told, in draw, when the compositor begins its work for one stage, and when it has done it.
class DrawWatch : public osg::Referenced {
public:
    /// State sets are off the stack. OpenGL's state stays as it is.
    virtual void begin(osg::RenderInfo& renderInfo) = 0;
    /// The same. Only called after begin().
    virtual void end(osg::RenderInfo& renderInfo) = 0;

protected:
    ~DrawWatch() override = default;
};

} // namespace gnomon
