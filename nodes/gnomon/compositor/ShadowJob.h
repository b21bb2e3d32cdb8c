// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/LightUniform.h>
#include <gnomon/Mark.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/compositor/DrawnLeaves.h>

#include <osg/Matrixd>
#include <osg/Referenced>
#include <osg/RenderInfo>
#include <osg/StateSet>
#include <osgUtil/RenderLeaf>

#include <memory>
#include <string>
#include <vector>

namespace gnomon {

/// Why marks that lie over each other, and are counted, cannot be drawn.
constexpr const char* noCounter =
    "overlapping shadows need another stencil bit. Leave one more out of CompositorOptions::reservedStencilBits.";

/// Marks nothing, but lets the programs of a view's drawables find out what share of a light arrives.
class ProgramMark : public Mark {
public:
    osg::ref_ptr<osg::StateSet> state; ///< applied under all that the stage draws.

    /// Draws what the state refers to, before anything else of the stage is drawn. Called within a CleanState.
    /// @return why that cannot be, as a cause for ShadowTechnique::report(); empty if all is well.
    virtual std::string drawAhead(osg::RenderInfo& renderInfo) const = 0;

    std::string draw(ScreenPass&) const final { return ""; }

protected:
    ProgramMark() { depthSteps = 0.0; }
    ~ProgramMark() override = default;
};

/// A mark of a technique in one view, and how the compositor is to use it.
struct ShadowJob {
    osg::ref_ptr<const Mark> mark;
    FrameReport report;  ///< for the technique.
    int light = 0;       ///< OpenGL light number.
    bool relight = true; ///< else blended.
    float dark = 1.0f;
    osg::ref_ptr<const osg::RefMatrix> projection; ///< of the technique's view: its lens.
    bool receiverNamed = false;                    ///< only `receivers` lose the light.
    std::shared_ptr<const LeafSet> receivers;      ///< see ViewFrame.
    std::shared_ptr<const LeafSet> moved; ///< leaves of the view that a program moves out of their boxes; null: none.
    bool hidingOnly = false; ///< a receiver loses the light only where it hides what is behind, see LateReceivers.
    bool isCut = false; ///< that is not everywhere. Its edges are hard: what is seen through a pixel has other shares.
    std::vector<LightUniform> lightUniforms; ///< of the group.
    bool findsEdges =
        false; ///< shares of light are found where marks end, see Mark::edges(); of the frame that is drawn to.

    /// True if the leaf is of the named receiver.
    bool isNamed(const osgUtil::RenderLeaf* leaf) const { return receivers && receivers->count(leaf) > 0; }
    /// True if pixels may have a part of the light.
    bool fades() const { return !isCut && (findsEdges || mark->kind() == Mark::Kind::Fades); }
    /// The mark, if it is for programs alone; else null.
    const ProgramMark* programMark() const { return dynamic_cast<const ProgramMark*>(mark.get()); }
    /// True if the leaf loses the light where marked: it is of the named receiver, or with none named, of this lens.
    bool isReceiver(const osgUtil::RenderLeaf& leaf) const { return receiverNamed ? isNamed(&leaf) : isOfLens(leaf); }
    /// True if the leaf is seen through the technique's lens, unlike what a nested camera lays over the view.
    bool isOfLens(const osgUtil::RenderLeaf& leaf) const { return isOfLens(projectionOf(leaf)); }
    bool isOfLens(const osg::Matrixd& lens) const { return isSameLens(lens, *projection); }
};

/// Is told, in draw, when the compositor begins its work for one stage.
class DrawWatch : public osg::Referenced {
public:
    /// State sets are off the stack. OpenGL's state stays as it is.
    virtual void begin(osg::RenderInfo& renderInfo) = 0;

protected:
    ~DrawWatch() override = default;
};

} // namespace gnomon
