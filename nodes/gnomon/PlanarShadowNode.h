// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/PlanarShadowOptions.h>
#include <gnomon/ShadowTechnique.h>

#include <osg/Vec4d>

#include <glm/vec4.hpp>

#include <memory>
#include <vector>

namespace gnomon {

class PlanarCasterCache;
class PlanarCasters;
struct PlanarPrograms;

/// Casts shadows onto planes: floors, walls, table tops. It flattens the casters along the light's rays.
///
/// The shadow is exact to the pixel, and cheap. Use ShadowMapTechnique where receivers are curved or casters shadow one
/// another, and TerrainShadowGeode on hills.
///
///     osg::ref_ptr<gnomon::PlanarShadowNode> shadow = new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0));
///     shadow->setReceiver({ground}); // optional, and faster
///     group->addChild(shadow);
///
/// Name the receiver if you can: the shadow then ends at its edges, and the compositor draws less again.
/// Without a receiver, a depth comparison finds the pixels that lie in the plane.
///
/// Cost
/// - Each plane and light: one draw of the casters' triangles, stencil only.
/// - Smooth edges: a copy of the depths, eight steps over the pixels that shadow can reach, and the triangles' outlines as lines.
/// - With a receiver: one more draw of the receiver where it is shadowed.
/// - Without a receiver: one more draw of every drawable that the shadow can touch.
/// Needs
/// - One stencil bit a light, and one more for several planes or techniques of one light. Smooth edges: two more bits, alpha bits
///   and framebuffer objects.
/// Limits
/// - Receivers are flat. Casters do not shadow one another. diagnose() names a surface in view that stays lit.
/// - A level surface lies in the plane if it is nearer than 0.0001 of its drawable's radius: then it receives, and does not cast.
///   diagnose() names one that is farther, or a named receiver that leaves the plane, with the distance.
/// - A plane receives on its lit side only.
/// - Casters that are clear in part cast as if they were solid, and diagnose() says so.
/// - Casters that draw themselves, or are made of patches, cast nothing. diagnose() says so.
/// - Without a receiver, a wall that stands in the plane is marked at its foot: up to an eighth of a pixel's slope and
///   32 depth steps high.
/// - Without a receiver, what a polygon offset pulls forward is found where it is flat in its own frame: its drawable's box
///   tells. Surfaces that lie closely over it, within that offset, are marked, too.
/// - Without a receiver, a ground of many kilometres with a near plane of decimetres may lose the shadow, if it is one
///   drawable of more than 2,000 triangles or a program moves it.
///   diagnose() names a caster that is too far away for the depth buffer's steps.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - J. Blinn, "Me and My (Fake) Shadow", IEEE CG&A 8(1), 1988.
/// - CS-4470, "Fake Shadows"; GusOnGames; M. Kilgard, halomagic.c; Lab 8.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::PlanarShadowNode {
///       UniqueID 2
///       Receiver { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Planes 1 { 0 0 1 -0.1 }
///       Edges SMOOTH
///     }
class GNOMON_EXPORT PlanarShadowNode : public ShadowTechnique {
public:
    using Edges = PlanarShadowOptions::Edges;                    ///< See PlanarShadowOptions::Edges.
    static constexpr Edges HARD = PlanarShadowOptions::HARD;     ///< See PlanarShadowOptions::HARD.
    static constexpr Edges SMOOTH = PlanarShadowOptions::SMOOTH; ///< See PlanarShadowOptions::SMOOTH.

    /// A node without planes.
    PlanarShadowNode();
    /// A node with one plane, as addPlane() takes it.
    explicit PlanarShadowNode(const osg::Vec4d& plane);
    /// Copies the properties.
    PlanarShadowNode(const PlanarShadowNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, PlanarShadowNode)

    /// Adds a plane (a, b, c, d): a·x + b·y + c·z + d = 0 in this node's frame. Its normal points to the lit side and
    /// may have any length. A degenerate or non-finite plane gets no shadow, and diagnose() says so.
    void addPlane(const osg::Vec4d& plane);
    /// Replaces the planes.
    void setPlanes(const std::vector<osg::Vec4d>& planes);
    /// The planes, as given.
    const std::vector<osg::Vec4d>& getPlanes() const { return _planes; }

    /// Sets all properties but the planes. Unknown edges become the default.
    void setOptions(const PlanarShadowOptions& options) { _options.edges = options.edges == SMOOTH ? SMOOTH : HARD; }
    /// See setOptions().
    const PlanarShadowOptions& getOptions() const { return _options; }
    /// See PlanarShadowOptions::edges.
    void setEdges(Edges edges) { setOptions({edges}); }
    /// See PlanarShadowOptions::edges.
    Edges getEdges() const { return _options.edges; }

    /// Makes one mark for each plane that receives a shadow. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<Mark>> prepare(const ViewFrame& view, const ShadowLight& light,
                                            const Casters& casters) const override;

    /// False for a point in one of the planes if a caster above that plane blocks the light. True for any other point.
    /// A point is in a plane if it is nearer than 10⁻⁵ of the casters' size.
    bool isLit(const ShadowProbe& probe, const glm::dvec3& point) const override;

    /// True if the surface's box ends in one of the planes, as seen along its normal.
    bool shadowsSurface(const ViewFrame& view, const osgUtil::RenderLeaf& leaf) const override;
    /// How far a surface is from the plane, if that is more than 0.0001 of its radius, and yet close to it.
    std::string flawOn(const ViewFrame& view, const osgUtil::RenderLeaf& leaf) const override;
    /// True if it has planes.
    bool leavesSomeLit() const override { return !_planes.empty(); }

    /// See ShadowTechnique::letGo().
    void letGo() const override;

    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~PlanarShadowNode() override;

private:
    osg::ref_ptr<Mark> prepareOne(const ViewFrame& view, const ShadowLight& light, const PlanarCasters& casters,
                                  unsigned index, const glm::dvec4& groupPlane) const;

    std::vector<osg::Vec4d> _planes;
    PlanarShadowOptions _options;
    osg::ref_ptr<PlanarPrograms> _programs;
    std::unique_ptr<PlanarCasterCache> _casters;
};

} // namespace gnomon
