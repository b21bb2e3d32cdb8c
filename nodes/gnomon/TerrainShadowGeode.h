// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>

#include <osg/BoundingBox>
#include <osg/StateSet>
#include <osg/Vec3d>
#include <osg/Vec4d>

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <vector>

namespace gnomon {

class TerrainCache;
struct TerrainPlace;
struct TerrainShadows;

/// Shadows of buildings and the like on terrain, as polygons: the bounding-box method of ARL-TN-156 as published, and two
/// successors that follow the caster and the ground.
///
///     osg::ref_ptr<gnomon::TerrainShadowGeode> shadow = new gnomon::TerrainShadowGeode;
///     shadow->setReceiver({terrain});
///     group->addChild(shadow);
///
/// BOX    as published: five vertices of the caster's bounding box by the light's quadrant, moved to its nearest own
///        vertices, three rays, twelve triangles. Off for whatever is no upright box along the axes.
/// HULL   the silhouette of each convex part of the caster, a ray for each corner above the ground, and the polygon between
///        them: four triangles for a house. Where rays do not settle (slopes as steep as the light, borders, holes, cliffs)
///        it drapes instead, and diagnose() says how often.
/// DRAPE  the ground's triangles cut by the caster's shadow, to within setError() in plan; with 0 exact
///        once the light stands still.
///
/// Below a ShadowCasterGroup it marks what of the receiver, which must be named, lies under the polygons, whatever level of
/// detail is drawn: once where they overlap. Where a grid's own triangles are drawn, HULL's polygons are laid on them, a
/// pixel's length nearer to the eye, and, where there are very many, far ones as bitmaps, off by 0.28 pixels at most; all
/// else is marked by prisms that reach through the ground. What belongs to the receiver casts no such shadow. With no
/// group above, it draws the shadow of one object as plain transparent geometry of its own, as the published class did:
///
///     shadow->setObjectGraphic(house);
///     shadow->setObjectPos({120.0, 80.0, 0.0});
///     shadow->setReceiver({terrain});
///     if (!shadow->compute(sun)) osg::notify(osg::WARN) << shadow->diagnose().front() << std::endl;
///     root->addChild(shadow);
///
/// Any number of casters: their shadows are kept in tiles of 256 neighbours at most, and found where they may be seen. A
/// caster that moves, comes or goes has its tile found anew, and so has a light that moves by so much that a shadow of the
/// tile may be off by more than setError() and by more than a quarter of a pixel; what is off by less follows within 2 ms of
/// each frame, and all that is seen once the light stands still, when the picture is that of a fresh start. A jump of the
/// light is right in the frame in which it happens. Tiles out of sight are not drawn, nor those whose largest shadow is
/// smaller than a pixel.
///
/// Cost    found on all cores; then 4 to 10 triangles a house on a grid, 20 elsewhere, stencil only, and the receiver once more
///         where marked. A caster that is neither convex nor an upright prism takes a polygon for each of its flat faces: a
///         bunny of 70,000 triangles 0.03 s a frame, 0.06 s where the light moves (OSMesa, 2 cores).
/// Needs   z up in the group's frame; a stencil bit, for prisms another, one more where they lie over one another, and fewer
///         passes with each more.
/// Limits  receivers are ground: walls receive nothing. Casters stand in the ground or on it: what hangs down lower than
///         a silhouette's corner shows no light below it in HULL. Terrain that overlaps itself in plan receives on all of
///         its storeys. A shader that moves the terrain's vertices, or discards its pixels, is not known here. With no group
///         above: edges may sink into rough ground between the polygon's corners, overlaps darken twice, and vertices are
///         floats about this node's origin.
/// Threads any number of cull and draw threads; set properties, compute() and update() between frames.
/// Source: ARL-TN-156, "Real-Time Shadows for Terrain Objects by the Bounding-Box Method".
///
/// In a file (.osgt, .osgb, .osgx), where what is left out has its default, here HULL and 0.1:
///
///     gnomon::TerrainShadowGeode {
///       UniqueID 2
///       Receiver { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Method DRAPE
///       Error 0.5
///     }
class GNOMON_EXPORT TerrainShadowGeode : public ShadowTechnique {
public:
    enum Method : int {
        BOX,  ///< the bounding-box method as published.
        HULL, ///< the silhouette's rays.
        DRAPE ///< the ground's own triangles, cut.
    };

    TerrainShadowGeode();
    TerrainShadowGeode(const TerrainShadowGeode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, TerrainShadowGeode)

    /// Default HULL, which any value that is none of the three stands for too.
    void setMethod(Method method) { _method = method == BOX || method == DRAPE ? method : HULL; }
    Method getMethod() const { return _method; }

    /// How far a draped edge may be off in plan, group's unit; default 0.1; 0 is exact. Negative or not a number is refused
    /// with a warning.
    void setError(double error);
    double getError() const { return _error; }

    /// What casts where there is no group above. Default none.
    void setObjectGraphic(osg::Node* object) { _object = object; }
    osg::Node* getObjectGraphic() { return _object.get(); }
    const osg::Node* getObjectGraphic() const { return _object.get(); }
    /// Where it stands, this node's frame. Default (0, 0, 0).
    void setObjectPos(const osg::Vec3d& position) { _position = position; }
    const osg::Vec3d& getObjectPos() const { return _position; }
    /// Heading, degrees, counter-clockwise from above. Default 0.
    void setObjectOrientation(double heading) { _heading = heading; }
    double getObjectOrientation() const { return _heading; }
    /// BOX alone: bounds about the position, along this node's axes. Default invalid: found from the object.
    void setObjectBounds(const osg::BoundingBoxd& bounds) { _bounds = bounds; }
    const osg::BoundingBoxd& getObjectBounds() const { return _bounds; }

    /// With no group above: finds the object's shadow on the receiver and makes it this node's geometry, black of half
    /// opacity, in the transparent bin.
    /// @param light  homogeneous, this node's frame: w = 0 the way towards a sun, w = 1 a lamp.
    /// @return whether there is one; if not, diagnose() says why, and there is no geometry.
    bool compute(const osg::Vec4d& light);
    /// As compute(), but does nothing if neither light, object, terrain nor settings have changed since.
    bool update(const osg::Vec4d& light);
    /// The triangles that compute() found, three corners each, counter-clockwise from above, this node's frame, in double.
    const std::vector<osg::Vec3d>& getTriangles() const { return _triangles; }
    /// Settings, light and triangles, for people.
    void print(std::ostream& out) const;

    /// How often shadows were found anew: those of a tile of neighbours, or by compute(), rise it by one.
    unsigned builds() const;

    std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                               const GroupCasters& casters) const override;
    bool takesPieces() const override { return true; }

    /// In shadow is what lies on the ground, to 10⁻⁵ of the casters' size, under one of the polygons.
    osg::ref_ptr<const osg::Referenced> answersFor(const LightProbe& probe) const override;
    bool isLit(const LightProbe& probe, const glm::dvec3& point) const override;

    void traverse(osg::NodeVisitor& visitor) override;
    void resizeGLObjectBuffers(unsigned maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~TerrainShadowGeode() override;

private:
    struct Asked; // what compute() was asked for
    Asked asked(const osg::Vec4d& light) const;
    bool compute(const Asked& with);
    osg::ref_ptr<osg::Node> placedObject() const;
    TerrainPlace terrain() const;
    osg::ref_ptr<const CasterMesh> meshOf(std::uint64_t object) const;
    void show();

    Method _method = HULL;
    double _error = 0.1;
    osg::ref_ptr<osg::Node> _object;
    osg::Vec3d _position;
    double _heading = 0.0;
    osg::BoundingBoxd _bounds;
    std::vector<osg::Vec3d> _triangles;
    osg::ref_ptr<const TerrainShadows> _shown; ///< by compute().
    std::uint64_t _shownObject = 0;            ///< revision of the placed object then.
    unsigned _foundAlone = 0;                  ///< by compute().
    osg::ref_ptr<osg::StateSet> _program, _bitmapProgram;
    std::unique_ptr<TerrainCache> _cache;
};

} // namespace gnomon
