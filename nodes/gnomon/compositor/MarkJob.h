// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/geometry/ScreenBounds.h>

#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <osg/Referenced>
#include <osg/RenderInfo>
#include <osgUtil/RenderLeaf>

#include <functional>
#include <memory>
#include <string>

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

} // namespace gnomon
