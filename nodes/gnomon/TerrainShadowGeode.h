// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>
#include <gnomon/TerrainShadowOptions.h>

#include <osg/StateSet>

#include <memory>
#include <vector>

namespace gnomon {

class MarkEdges;
class TerrainShadowCache;

/// Casts shadows of buildings and other upright objects onto terrain.
///
/// It works for one house and for a town of 100,000. Only the terrain receives. Use ShadowMapTechnique if walls and
/// roofs receive, too, and PlanarShadowNode if the ground is flat.
///
///     osg::ref_ptr<gnomon::TerrainShadowGeode> shadow = new gnomon::TerrainShadowGeode;
///     shadow->setReceiver({terrain}); // required
///     group->addChild(shadow);
///
/// Methods
/// - HULL, the default: follows the silhouette of each convex part along the light into the ground. It is exact to a
///   sample, on any terrain: hills, crests, holes, decks and the ground below them.
/// - BOX: the bounding-box method of ARL-TN-156, as published. It is wrong for casters whose outline differs from that of
///   their box along the axes; diagnose() counts them in each light.
/// Cost
/// - Shadows are computed on all cores, only for tiles in view, and kept.
/// - Each frame: up to 20 triangles a house, stencil only.
/// - Smooth edges: a copy of the depths, eight steps over the pixels that shadow can reach, and the triangles once more.
/// - Each frame: one more draw of the receiver where it is shadowed.
/// - A caster that is neither convex nor an upright prism takes a solid for each flat face. Detailed models are
///   therefore slow.
/// Needs
/// - A named receiver, see setReceiver(). It casts no shadow of this kind.
/// - z up in the group's frame.
/// - Qhull for HULL: see OptionalPart::Terrain.
/// - Two stencil bits; three if shadows overlap. More bits save passes. Smooth edges: one more bit, alpha bits and framebuffer
///   objects.
/// Limits
/// - Walls and roofs receive nothing. diagnose() names one in view that stays lit.
/// - The terrain casts nothing on itself. diagnose() says so if some of it is turned away from the light.
/// - Casters that are clear in part cast as if they were solid, and diagnose() says so.
/// - Casters that draw themselves, or are made of patches, cast nothing. diagnose() says so.
/// - Far from a very close near plane, depths are too coarse to place shadows. diagnose() names such a caster.
/// - BOX spans rough ground between its corners, and closes openings in a box.
/// - A coarser level of the terrain's detail may miss the end of a shadow where it lies lower than the finest one by more
///   than half of that shadow.
/// - A polygon offset of the terrain moves the shadow's edges by as many pixels as its factor.
/// - Shaders that move the terrain's vertices or discard its pixels are not known here.
/// - Moving light: a silhouette may lag by a quarter of a pixel. It catches up when the light stops.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - ARL-TN-156, "Real-Time Shadows for Terrain Objects by the Bounding-Box Method". See boxShadow() for one object
///   without a group, as the published class has it.
///
/// Tiles
/// - The casters' shadows are kept in tiles of up to 256 neighbours.
/// - If a caster moves, comes or goes, only its tile is computed again.
/// - A sun that turns takes the shadows with it. A tile is computed again when its silhouettes would be off by more than
///   a quarter of a pixel. The others follow a few a frame.
/// - Tiles out of sight, or with shadows smaller than a pixel, are not drawn.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::TerrainShadowGeode {
///       UniqueID 2
///       Receiver { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Method BOX
///     }
class GNOMON_EXPORT TerrainShadowGeode : public ShadowTechnique {
public:
    using Method = TerrainShadowOptions::Method;                  ///< See TerrainShadowOptions::Method.
    static constexpr Method BOX = TerrainShadowOptions::BOX;      ///< See TerrainShadowOptions::BOX.
    static constexpr Method HULL = TerrainShadowOptions::HULL;    ///< See TerrainShadowOptions::HULL.
    using Edges = TerrainShadowOptions::Edges;                    ///< See TerrainShadowOptions::Edges.
    static constexpr Edges HARD = TerrainShadowOptions::HARD;     ///< See TerrainShadowOptions::HARD.
    static constexpr Edges SMOOTH = TerrainShadowOptions::SMOOTH; ///< See TerrainShadowOptions::SMOOTH.

    /// A technique with the default properties.
    TerrainShadowGeode();
    /// Copies the properties.
    TerrainShadowGeode(const TerrainShadowGeode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, TerrainShadowGeode)

    /// Sets all options, as the setters below do.
    void setOptions(const TerrainShadowOptions& options) {
        setMethod(options.method);
        setEdges(options.edges);
    }
    /// See setOptions().
    const TerrainShadowOptions& getOptions() const { return _options; }

    /// See TerrainShadowOptions::method. An unknown value, as DRAPE was, becomes the default with a warning.
    void setMethod(Method method);
    /// See TerrainShadowOptions::method.
    Method getMethod() const { return _options.method; }

    /// See TerrainShadowOptions::edges. An unknown value becomes the default.
    void setEdges(Edges edges) { _options.edges = edges == SMOOTH ? SMOOTH : HARD; }
    /// See TerrainShadowOptions::edges.
    Edges getEdges() const { return _options.edges; }

    /// Number of computations so far. Each computed tile adds one.
    unsigned builds() const;
    /// The same.
    unsigned passes() const override { return builds(); }

    /// See OptionalPart::Terrain. BOX is in every build.
    std::string whyUnavailable() const override;

    /// Makes the mark of the tiles in view. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<Mark>> prepare(const ViewFrame& view, const ShadowLight& light,
                                            const Casters& casters) const override;
    /// See ShadowTechnique::letGo().
    void letGo() const override;
    /// True: it shadows its receiver alone.
    bool leavesSomeLit() const override { return true; }

    /// Computes all shadows of one light, for isLit().
    osg::ref_ptr<const osg::Referenced> answersFor(const ShadowProbe& probe) const override;
    /// False for a point on the ground in one of the shadows. True for any other point.
    /// A point is on the ground if it is nearer than 10⁻⁵ of the casters' size.
    bool isLit(const ShadowProbe& probe, const glm::dvec3& point) const override;

    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~TerrainShadowGeode() override;

private:
    TerrainShadowOptions _options;
    osg::ref_ptr<osg::StateSet> _program;
    osg::ref_ptr<MarkEdges> _edges;
    std::unique_ptr<TerrainShadowCache> _cache;
};

} // namespace gnomon
