// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMarkers.h>
#include <gnomon/Export.h>
#include <gnomon/Selection.h>
#include <gnomon/ShadowLight.h>

#include <glm/vec3.hpp>
#include <osg/Geode>

#include <string>
#include <vector>

namespace osgUtil {
class CullVisitor;
}

namespace gnomon {

class FrameDiagnosis;
class FrameCasters;
class MarkJob;
class ShadowCasterGroup;
struct ShadowProbe;
struct ViewFrame;

/// Base of all shadow techniques: finds the pixels that a light does not reach. The compositor (ShadowBin) takes the
/// light away from them.
///
/// A technique is a child of a ShadowCasterGroup, directly or under switches, LODs and transforms. In a cull traversal
/// it registers itself with the ShadowBin of the stage being filled, and draws nothing else. After the whole cull the
/// bin calls prepare() once a light, in each view.
class GNOMON_EXPORT ShadowTechnique : public osg::Geode, public NeverCasts {
public:
    ShadowTechnique();
    ShadowTechnique(const ShadowTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    const char* libraryName() const override { return "gnomon"; }
    const char* className() const override { return "ShadowTechnique"; }

    /// What receives: the shadow ends at its edges. Default: everything opaque.
    void setReceiver(const Selection& receiver) { _receiver = receiver; }
    const Selection& getReceiver() const { return _receiver; }
    bool hasReceiver() const { return _receiver != Selection(); }

    /// Why there was no (or no full) shadow in the last frame, over all its views: one sentence a cause, with the node
    /// and the remedy. Empty if all is well.
    std::vector<std::string> diagnose() const;

    void traverse(osg::NodeVisitor& visitor) override;

    /// Called by the ShadowBin after the whole cull, once a light and view.
    /// @return what to draw; nothing if this light casts nothing in this view (report() says why, where a user could
    /// wonder).
    virtual std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                                       const FrameCasters& casters) const = 0;
    /// True if prepare() asks for the casters' pieces alone, so that nobody need make a mesh of all.
    virtual bool takesDrawables() const { return false; }

    /// Whether the light reaches a point as this technique draws it; see ShadowQuery, which asks.
    /// Default: whether a ray from there to the light meets no caster.
    /// @param point  about the probe's origin.
    virtual bool isLit(const ShadowProbe& probe, const glm::dvec3& point) const;
    /// What isLit() needs to have found before, for many points; the ShadowQuery keeps it, and hands it over as
    /// ShadowProbe::answers. Default none.
    virtual osg::ref_ptr<const osg::Referenced> answersFor(const ShadowProbe& probe) const;

    /// Notes a cause for diagnose(); repeated causes count once. Called in cull or draw.
    void report(unsigned frame, const std::string& cause) const;
    /// Forgets the causes of frames before this one: `frame` is another number, or `view` (any address that stands for
    /// it) has been met in it before, as where nobody counts frames.
    void beginFrame(unsigned frame, const void* view) const;
    /// What report() adds to; for jobs that outlive their frame's cull.
    FrameDiagnosis* frameDiagnosis() const;
    /// "PlanarShadowNode 'floor'": what a cause begins with.
    std::string describe() const;

protected:
    ~ShadowTechnique() override;

    /// Registers this with the ShadowBin of the stage that is being filled, or reports why it cannot be.
    void enlist(osgUtil::CullVisitor& cull);
    static bool hasGroupAbove(const osg::NodeVisitor& visitor);

private:
    Selection _receiver;
    const osg::ref_ptr<FrameDiagnosis> _diagnosis;
};

} // namespace gnomon
