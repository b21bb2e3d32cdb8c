// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/PlanarCasters.h>
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
/// Source: CS-4470 "Fake Shadows"; GusOnGames; M. Kilgard, halomagic.c; Lab 8; J. Blinn 1988.
///
/// In a file (.osgt, .osgb, .osgx), where what is left out has its default, here no receiver named and no plane:
///
///     gnomon::PlanarShadowNode {
///       UniqueID 2
///       Receiver { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Planes 1 { 0 0 1 -0.1 }
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

    std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                               const CasterMesh& casters) const override;

    void resizeGLObjectBuffers(unsigned maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~PlanarShadowNode() override;

private:
    osg::ref_ptr<MarkJob> prepareOne(const ViewFrame& view, const ShadowLight& light, const CasterMesh& casters,
                                     unsigned index, const glm::dvec4& groupPlane) const;
    osg::ref_ptr<PlanarCasters> castersAbove(const CasterMesh& mesh, const glm::dvec4& plane, unsigned frame) const;

    std::vector<osg::Vec4d> _planes;
    osg::ref_ptr<PlanarPrograms> _programs;
    mutable OpenThreads::Mutex _cacheMutex;
    mutable std::vector<osg::ref_ptr<PlanarCasters>> _cache; ///< used last at the end.
};

} // namespace gnomon
