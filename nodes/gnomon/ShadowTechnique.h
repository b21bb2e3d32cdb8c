// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMarkers.h>
#include <gnomon/Export.h>
#include <gnomon/NamesNodes.h>
#include <gnomon/ObservedNode.h>
#include <gnomon/Selection.h>
#include <gnomon/ShadowLight.h>
#include <gnomon/ShadowReport.h>

#include <glm/vec3.hpp>
#include <osg/Geode>

#include <string>
#include <vector>

namespace osgUtil {
class CullVisitor;
class RenderLeaf;
} // namespace osgUtil

namespace gnomon {

class DrawWatch;
class FrameDiagnosis;
class Casters;
class Mark;
class ShadowCasterGroup;
struct FrameReport;
struct FrameWork;
struct ShadowProbe;
struct ViewFrame;

/// Base class of all shadow techniques: finds the pixels that a light does not reach.
///
/// To use a technique, take PlanarShadowNode, ShadowMapTechnique, ShadowVolumeTechnique, TerrainShadowGeode or
/// TracedShadowTechnique. A technique of your own derives from this class: prepare() returns a Mark, which a MarkProgram draws. See
/// examples/owntechnique.
///
/// A technique is a child of a ShadowCasterGroup, directly or under switches, LODs and transforms. The cull traversal
/// registers the technique with the compositor of its render stage. After the cull, the compositor calls prepare() once
/// a light in each view. The technique marks pixels; the compositor darkens them.
class GNOMON_EXPORT ShadowTechnique : public osg::Geode, public NeverCasts, public NamesNodes {
public:
    /// A technique with every opaque drawable as receiver.
    ShadowTechnique();
    /// Copies the properties.
    ShadowTechnique(const ShadowTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    /// "gnomon", as OSG's serializers ask.
    const char* libraryName() const override { return "gnomon"; }
    /// Name of the class without its namespace.
    const char* className() const override { return "ShadowTechnique"; }

    /// The part of the scene that receives the shadow. The shadow ends at its edges. Default: everything opaque.
    /// The technique does not keep the node, which may stand above it.
    void setReceiver(const Selection& receiver) { _receiver = receiver; }
    /// See setReceiver(). Null and the mask 0, which select nothing, if the node is gone.
    Selection getReceiver() const { return _receiver.in(*this); }
    /// True if setReceiver() has named a receiver.
    bool hasReceiver() const { return getReceiver() != Selection(); }
    /// True if setReceiver() has named a node that has been deleted since.
    bool isReceiverGone() const { return _receiver.isGone(*this); }

    /// Says why a shadow was missing or incomplete in the last frame, in any view.
    ///
    /// Some causes take up to tenths of a second to find: a node that encloses all, surfaces that stay lit, depths that are too
    /// coarse. The first two frames in which anything casts look for them, and the frame after each call; the others repeat what
    /// was found last. So call it, draw a frame, and call it again. To show causes in each frame, take lastReport().
    /// A program that never calls it gets each cause once, by osg::notify() at WARN.
    /// @return one sentence a cause, with the node and the remedy; empty if all is well.
    std::vector<std::string> diagnose() const;

    /// Says which library this build lacks for the technique, and what to install. Default, empty: none.
    /// The compositor then draws no shadow, and diagnose() says the same. A scene file keeps the node.
    virtual std::string whyUnavailable() const { return {}; }

    /// The technique's work in the last frame: marks, passes, time. The first call starts the record, which then holds
    /// the frames that follow.
    ShadowReport lastReport() const;
    /// How often the technique has made anew what it draws with, because something changed: maps drawn, volumes found,
    /// tiles computed, ray scenes built. Over all lights, views and contexts. Default 0.
    virtual unsigned passes() const { return 0; }
    /// The choices of a technique that chooses, see AutoShadowTechnique. Default: none.
    virtual std::vector<ShadowDecision> lastDecision() const { return {}; }

    /// Registers the technique with the compositor in a cull traversal.
    void traverse(osg::NodeVisitor& visitor) override;

    /// Finds the pixels that one light does not reach in one view. The compositor calls it after the cull.
    /// @return what marks those pixels in draw; empty if the light casts nothing in this view. If a user might
    ///         wonder why, prepare() calls report().
    virtual std::vector<osg::ref_ptr<Mark>> prepare(const ViewFrame& view, const ShadowLight& light,
                                                    const Casters& casters) const = 0;

    /// Lets go what it keeps of casters that are gone. The compositor calls it in place of prepare() where nothing casts.
    /// Default: nothing is kept.
    virtual void letGo() const {}

    /// A watch that is told of the compositor's work on one view in draw. The compositor asks once a view, after prepare().
    /// Default: null.
    virtual osg::ref_ptr<DrawWatch> watch(const ViewFrame& view) const;

    /// True if it draws casters that have no triangles to read, by their own code. Else the compositor reports them.
    /// Default false.
    virtual bool drawsCasters() const { return false; }
    /// True if it leaves out the parts of casters that are clear by a texture's alpha. Else the compositor reports them.
    /// Default: as drawsCasters().
    virtual bool cutsByTextures() const { return drawsCasters(); }

    /// True if the technique can shadow a surface that is among its receivers. Default true. Asked in cull, where a frame looks for slow causes.
    /// @param leaf  a leaf of the surface, in view.
    virtual bool shadowsSurface(const ViewFrame& view, const osgUtil::RenderLeaf& leaf) const;
    /// What makes the shadow on a surface that is among its receivers wrong in part, as a cause for report(). Asked as
    /// shadowsSurface() is. Default: nothing.
    virtual std::string flawOn(const ViewFrame& view, const osgUtil::RenderLeaf& leaf) const;
    /// True if shadowsSurface() may be false, or flawOn() tells something. Frames then look for a surface that the shadow
    /// could reach and that no technique shadows. Default false.
    virtual bool leavesSomeLit() const { return false; }

    /// True if the light reaches a point, as this technique draws it. ShadowQuery calls it.
    /// Default: true if a ray from the point to the light meets no caster.
    /// @param point  relative to the probe's origin, group frame.
    virtual bool isLit(const ShadowProbe& probe, const glm::dvec3& point) const;
    /// Prepares whatever isLit() needs for many points. ShadowQuery keeps the result and passes it as
    /// ShadowProbe::answers. Default: null.
    virtual osg::ref_ptr<const osg::Referenced> answersFor(const ShadowProbe& probe) const;

    /// The receiver, if one is named.
    std::vector<Selection> namedParts() const override;

    /// Adds a cause to diagnose(). Repeated causes count once. Call it in cull or draw.
    /// @param cause  the end of a sentence that begins with describe().
    void report(unsigned frame, const std::string& cause) const;
    /// Forgets the causes of earlier frames. A frame begins when `frame` or `time` changes, or when `view` comes a second
    /// time.
    /// @param time  seconds, by which viewers that count frames alike differ.
    /// @param view  any address that identifies the view.
    void beginFrame(unsigned frame, double time, const void* view) const;
    /// A reporter for one frame, for marks that outlive the frame's cull. It does as report().
    FrameReport reportIn(unsigned frame) const;
    /// True if lastReport() has been called: then record() is to be.
    bool isRecorded() const;
    /// Adds to lastReport(). Call it in cull or draw.
    void record(const FrameWork& work) const;
    /// Class and name, for messages: "PlanarShadowNode 'floor'".
    std::string describe() const;

protected:
    ~ShadowTechnique() override;

    /// Registers the technique with the compositor of the current render stage, or reports why it cannot.
    void enlist(osgUtil::CullVisitor& cull);

private:
    ObservedSelection _receiver;
    const osg::ref_ptr<FrameDiagnosis> _diagnosis;
};

} // namespace gnomon
