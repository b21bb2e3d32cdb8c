// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/PlanarCasters.h>
#include <gnomon/PlanarCures.h>
#include <gnomon/ShadowTechnique.h>

#include <osg/Vec4d>

#include <vector>

namespace gnomon {

struct PlanarPrograms;

/// Shadow on one or several planes: the casters flattened along the light's rays (Blinn 1988).
///
/// The shadow lies where what one sees lies in the plane, and ends at that thing's edges. Name the receiver
/// (setReceiver) where you can: only that receives then, to the pixel, and the leaves that it hides or that stand on it
/// need not be drawn again. Without one the plane is told from everything else by depth.
///
/// Cost    one draw of the casters a plane and light, stencil only, and one of the receiver where marked; with no
///         receiver named, one of every leaf that the marks can touch.
/// Needs   1 stencil bit a light, 1 more for several planes or techniques of one light.
/// Limits  flat receivers; a caster is not shadowed by another. A plane receives on its lit side only. Without a named
///         receiver walls that stand in the plane take marks up to an eighth of a pixel's slope and 32 steps of depth
///         high; a ground of many kilometres under a near plane of decimetres may lose its shadow, and one drawn
///         with a polygon offset or a depth range of its own does. Alpha-tested casters cast as if they were solid.
/// Threads any number of cull and draw threads; set properties between frames.
/// Cures   three classic faults of planar shadows are cured; each cure can be switched off, to show its fault:
///
///         stencil  off: each flattened triangle darkens what it covers by the group's setDark(), be it relight or blend,
///                  so that a pixel under n of them takes the factor n times. What lies in the plane receives, whatever
///                  receiver is named. Costs the casters' draw twice.
///         offset   off: the flattened triangles are tested at their own depth against what stands there, nothing between
///                  the two, as they would be if they were drawn: they fight the receiver for each pixel. Which pixels
///                  win is the rounding's, and differs from one OpenGL to the next.
///         clip     off: what lies under the plane, or above a lamp, casts as well: an anti-shadow, where the line
///                  through it and the light meets the plane. What lies in the plane never casts. The marks' bounds are
///                  then the whole screen.
///
/// Source: CS-4470 "Fake Shadows"; GusOnGames; M. Kilgard, halomagic.c; Lab 8; J. Blinn 1988.
///
/// In a file (.osgt, .osgb, .osgx), where what is left out has its default, here no receiver named, no plane, all
/// cures on:
///
///     gnomon::PlanarShadowNode {
///       UniqueID 2
///       Receiver { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Planes 1 { 0 0 1 -0.1 }
///       ClipCure FALSE
///     }
class GNOMON_EXPORT PlanarShadowNode : public ShadowTechnique {
public:
    PlanarShadowNode();
    explicit PlanarShadowNode(const osg::Vec4d& plane);
    PlanarShadowNode(const PlanarShadowNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, PlanarShadowNode)

    /// Plane (a, b, c, d), a·x + b·y + c·z + d = 0 in this node's frame, normal towards the lit side; any length of
    /// normal. Kept as given; one that is degenerate or not finite gets no shadow, and diagnose() says so.
    void addPlane(const osg::Vec4d& plane);
    void setPlanes(const std::vector<osg::Vec4d>& planes);
    const std::vector<osg::Vec4d>& getPlanes() const { return _planes; }

    /// A pixel is darkened once, however many triangles fall on it. Default on.
    void setStencilCure(bool on) { _cures.stencil = on; }
    bool getStencilCure() const { return _cures.stencil; }
    /// Marks do not fight the receiver for depth. Default on.
    void setOffsetCure(bool on) { _cures.offset = on; }
    bool getOffsetCure() const { return _cures.offset; }
    /// Casts only what lies between plane and light. Default on.
    void setClipCure(bool on) { _cures.clip = on; }
    bool getClipCure() const { return _cures.clip; }

    std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                               const GroupCasters& casters) const override;

    /// In shadow is what lies in one of the planes, to 10⁻⁵ of the casters' size, on its lit side, with a caster above
    /// that plane in the way. All else is lit, as it is in the picture.
    bool isLit(const LightProbe& probe, const glm::dvec3& point) const override;

    void resizeGLObjectBuffers(unsigned maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~PlanarShadowNode() override;

private:
    osg::ref_ptr<MarkJob> prepareOne(const ViewFrame& view, const ShadowLight& light, const CasterMesh& casters,
                                     unsigned index, const glm::dvec4& groupPlane) const;
    osg::ref_ptr<PlanarCasters> castersAbove(const CasterMesh& mesh, const glm::dvec4& plane, unsigned frame) const;

    std::vector<osg::Vec4d> _planes;
    PlanarCures _cures;
    osg::ref_ptr<PlanarPrograms> _programs;
    mutable OpenThreads::Mutex _cacheMutex;
    mutable std::vector<osg::ref_ptr<PlanarCasters>> _cache; ///< used last at the end.
};

} // namespace gnomon
