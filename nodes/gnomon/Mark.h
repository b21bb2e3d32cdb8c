// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ScreenRect.h>

#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <osg/Referenced>
#include <osgUtil/RenderLeaf>

#include <functional>
#include <string>
#include <unordered_set>

namespace gnomon {

class MarkEdges;
class ScreenPass;

/// Leaves of a render stage, to be asked for by address.
using LeafSet = std::unordered_set<const osgUtil::RenderLeaf*>;

/// One technique's share of one view: marks, in draw, the pixels that one light does not reach.
class GNOMON_EXPORT Mark : public osg::Referenced {
public:
    /// Where marks can fall; everything the compositor does is cut to it.
    ScreenRect screenBounds = wholeScreen;

    /// True if it can draw ScreenPass::Want::Factor, as a MarkProgram can.
    bool canDarken = false;
    /// True of what relighting alone must darken: what OpenGL has drawn without the light, as far as it could.
    bool relightsOnly = false;
    /// True if drawDebugView() draws anything.
    bool hasDebugView = false;
    /// How many steps of the depth buffer a surface may be off its place for its marks; 0: however many.
    double depthSteps = 1.0;

    /// What its fragments say of the pixels that they cover.
    enum class Kind {
        Hard,  ///< None of the light arrives. They may lie over each other.
        Fades, ///< A share of the light arrives. At most one a pixel; none where nothing stands (far depth).
        Counts ///< As Hard, found by ScreenPass::counters().
    };
    /// Default: Hard.
    virtual Kind kind() const { return Kind::Hard; }

    /// Draws fragments where not all of the light arrives, as ScreenPass::wanted() has it. Colour, stencil and depth that the pass
    /// does not ask for stay as they are. Called within a CleanState and `pass`, which is cut to the bounds; state that is
    /// applied on top must be taken back by state.apply().
    /// @return why nothing could be drawn, as a cause for ShadowTechnique::report(); empty if all is well.
    virtual std::string draw(ScreenPass& pass) const = 0;

    /// Of Kind::Fades: looks at what it must know of the frame, where the next draw() draws to something else. Called as draw() is.
    /// Default: nothing.
    virtual void look(ScreenPass&) const {}

    /// What finds where within their pixels its marks end, so that a share of the light arrives there if the frame has one sample
    /// a pixel. Of Kind::Hard or Counts. Default null: nothing does.
    virtual const MarkEdges* edges() const { return nullptr; }
    /// Draws what its marks end at, by the program of edges().
    virtual void drawEdges(ScreenPass&) const {}

    /// Draws over the finished picture how its marks come about.
    /// @param before  how many other marks of the view have done so.
    virtual void drawDebugView(ScreenPass& pass, int before) const {
        static_cast<void>(pass), static_cast<void>(before);
    }

    /// False if it is known that no mark falls on this leaf, as a cause of diagnose() should be about what receives.
    virtual bool canReach(const osgUtil::RenderLeaf&) const { return true; }

    /// False for a box if it is known that no mark falls on what is in it.
    using BoxTest = std::function<bool(const osg::BoundingBox&)>;
    /// For boxes of one frame. Default empty: nothing is known.
    virtual BoxTest boxTest(const osg::Matrixd& /*eyeFromBox*/) const { return {}; }

protected:
    ~Mark() override = default;
};

} // namespace gnomon
