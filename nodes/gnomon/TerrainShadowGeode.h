// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>
#include <gnomon/TerrainShadowOptions.h>

#include <osg/BoundingBox>
#include <osg/StateSet>
#include <osg/Vec3d>
#include <osg/Vec4d>

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <vector>

namespace gnomon {

class CasterMesh;
class TerrainShadowCache;
struct TerrainPlace;
struct TerrainShadows;

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
/// - HULL, the default: casts the silhouette of each convex part, with a ray for each corner above the ground. A house
///   takes four triangles. If the rays fail, for example at cliffs and holes, it drapes; diagnose() says how often.
/// - DRAPE: cuts the ground's triangles by the caster's shadow, within setError() in plan.
/// - BOX: the bounding-box method of ARL-TN-156, as published. It is wrong for casters whose outline differs from that of
///   their box along the axes; diagnose() counts them in each light.
/// Cost
/// - Shadows are computed on all cores, only for tiles in view, and kept.
/// - Each frame: 4 to 10 triangles a house on a regular grid, 20 elsewhere, stencil only.
/// - Each frame: one more draw of the receiver where it is shadowed.
/// - A caster that is neither convex nor an upright prism takes a polygon for each flat face. Detailed models are
///   therefore slow.
/// Needs
/// - A named receiver, see setReceiver(). It casts no shadow of this kind.
/// - z up in the group's frame.
/// - Qhull for HULL and DRAPE: see OptionalPart::Terrain.
/// - One stencil bit; two for shadows off a grid; three if those overlap. More bits save passes.
/// Limits
/// - Walls and roofs receive nothing. diagnose() names one in view that stays lit.
/// - The terrain casts nothing on itself. diagnose() says so if some of it is turned away from the light.
/// - Casters that are clear in part cast as if they were solid, and diagnose() says so.
/// - Casters that draw themselves, or are made of patches, cast nothing. diagnose() says so.
/// - Far from a very close near plane, depths are too coarse to place shadows off a regular grid. diagnose() names such a
///   caster.
/// - Casters stand on or in the ground. HULL shows no light below an overhang.
/// - HULL leaves out corners of round casters, for at most 1 % of their shadow's area in plan.
/// - BOX spans rough ground between its eleven points, and closes openings in a box.
/// - Shadows are found on the terrain's finest level of detail. On a coarser one they lie beside their places, by the
///   difference of heights over the light's tangent. diagnose() says so if one is drawn.
/// - Terrain that overlaps itself in plan receives on all of its levels.
/// - Shaders that move the terrain's vertices or discard its pixels are not known here.
/// - In a town seen from afar, a shadow's edge may be off by 0.3 pixels, because far tiles are drawn as bitmaps.
/// - Moving light: a shadow may lag by setError() or a quarter of a pixel, whichever is larger. It catches up when the
///   light stops. After a jump of the light, shadows are right at once.
/// Threads
/// - Any number of cull and draw threads. Set properties, compute() and update() between frames.
/// Source
/// - ARL-TN-156, "Real-Time Shadows for Terrain Objects by the Bounding-Box Method".
///
/// Tiles
/// - The casters' shadows are kept in tiles of up to 256 neighbours.
/// - If a caster moves, comes or goes, only its tile is computed again.
/// - If the light moves, a tile is computed again when its error would exceed both bounds above. Smaller errors are
///   repaired within 2 ms a frame.
/// - Tiles out of sight, or with shadows smaller than a pixel, are not drawn.
/// Marking
/// - The shadow falls on whatever level of detail is drawn. Overlaps darken once.
/// - On a regular grid, HULL's polygons lie on the drawn triangles, a pixel's length nearer to the eye. If there are
///   very many, far tiles are bitmaps. Other shadows are prisms through the ground.
///
/// One object, without a group
/// - With no ShadowCasterGroup above, it draws the shadow of one object as plain transparent geometry. The published
///   class works like this.
/// - Edges may sink into rough ground, overlaps darken twice, and vertices are floats about this node's origin.
///
///     shadow->setObjectGraphic(house);
///     shadow->setObjectPos({120.0, 80.0, 0.0});
///     shadow->setReceiver({terrain});
///     shadow->compute(sun); // if it returns false, osg::notify() has said why
///     root->addChild(shadow);
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::TerrainShadowGeode {
///       UniqueID 2
///       Receiver { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Method DRAPE
///       Error 0.5
///     }
class GNOMON_EXPORT TerrainShadowGeode : public ShadowTechnique {
public:
    using Method = TerrainShadowOptions::Method;                 ///< See TerrainShadowOptions::Method.
    static constexpr Method BOX = TerrainShadowOptions::BOX;     ///< See TerrainShadowOptions::BOX.
    static constexpr Method HULL = TerrainShadowOptions::HULL;   ///< See TerrainShadowOptions::HULL.
    static constexpr Method DRAPE = TerrainShadowOptions::DRAPE; ///< See TerrainShadowOptions::DRAPE.

    /// A technique with the default properties.
    TerrainShadowGeode();
    /// Copies the properties, and the geometry of compute().
    TerrainShadowGeode(const TerrainShadowGeode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, TerrainShadowGeode)

    /// Sets method and error at once, as the setters below do.
    void setOptions(const TerrainShadowOptions& options);
    /// See setOptions().
    const TerrainShadowOptions& getOptions() const { return _options; }

    /// See TerrainShadowOptions::method. An unknown value becomes the default.
    void setMethod(Method method);
    /// See TerrainShadowOptions::method.
    Method getMethod() const { return _options.method; }
    /// See TerrainShadowOptions::error. A negative or non-finite value is refused with a warning.
    void setError(double error);
    /// See TerrainShadowOptions::error.
    double getError() const { return _options.error; }

    /// Without a group: the object that casts. Default null.
    void setObjectGraphic(osg::Node* object) { _object = object; }
    /// See setObjectGraphic().
    osg::Node* getObjectGraphic() { return _object.get(); }
    /// See setObjectGraphic().
    const osg::Node* getObjectGraphic() const { return _object.get(); }
    /// Without a group: position of the object, this node's frame. Default (0, 0, 0).
    void setObjectPos(const osg::Vec3d& position) { _position = position; }
    /// See setObjectPos().
    const osg::Vec3d& getObjectPos() const { return _position; }
    /// Without a group: heading of the object, degrees, counter-clockwise from above. Default 0.
    void setObjectOrientation(double heading) { _heading = heading; }
    /// See setObjectOrientation().
    double getObjectOrientation() const { return _heading; }
    /// Without a group, BOX only: bounds about the position, along this node's axes.
    /// Default: an invalid box, which stands for the object's own bounds.
    void setObjectBounds(const osg::BoundingBoxd& bounds) { _bounds = bounds; }
    /// See setObjectBounds().
    const osg::BoundingBoxd& getObjectBounds() const { return _bounds; }

    /// Without a group: computes the object's shadow on the receiver. It becomes this node's geometry, black at half
    /// opacity, in the transparent bin.
    /// @param light  homogeneous, this node's frame: w = 0 is the direction towards a sun, w = 1 a lamp's position.
    /// @return       true if there is a shadow. If not, diagnose() says why and the node has no geometry.
    bool compute(const osg::Vec4d& light);
    /// As compute(), but only if light, object, terrain or properties have changed since.
    bool update(const osg::Vec4d& light);
    /// The triangles of compute(): three corners each, counter-clockwise from above, this node's frame, in double.
    const std::vector<osg::Vec3d>& getTriangles() const { return _triangles; }
    /// Prints properties, light and triangles of compute() as text.
    void print(std::ostream& out) const;

    /// Number of computations so far. Each computed tile adds one, and each compute() that finds a new shadow.
    unsigned builds() const;
    /// The same.
    unsigned passes() const override { return builds(); }

    /// See OptionalPart::Terrain. BOX is in every build.
    std::string whyUnavailable() const override;

    /// Makes the job that marks the tiles in view. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                               const FrameCasters& casters) const override;
    /// True: the technique keeps casters by drawable.
    bool takesDrawables() const override { return true; }
    /// See ShadowTechnique::letGo().
    void letGo() const override;
    /// 1: it shadows its receiver alone.
    std::uint64_t surfacesKey() const override { return 1; }

    /// Computes all shadows of one light, for isLit().
    osg::ref_ptr<const osg::Referenced> answersFor(const ShadowProbe& probe) const override;
    /// False for a point on the ground under one of the shadow polygons. True for any other point.
    /// A point is on the ground if it is nearer than 10⁻⁵ of the casters' size.
    bool isLit(const ShadowProbe& probe, const glm::dvec3& point) const override;

    /// Registers the technique with the compositor. Without a group, it draws the geometry of compute().
    void traverse(osg::NodeVisitor& visitor) override;
    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~TerrainShadowGeode() override;

private:
    struct Request; // of a shadow by compute()
    Request requestFor(const osg::Vec4d& light) const;
    bool compute(const Request& with);
    osg::ref_ptr<osg::Node> placedObject() const;
    TerrainPlace terrain() const;
    osg::ref_ptr<const CasterMesh> meshOf(std::uint64_t object) const;
    void show();

    TerrainShadowOptions _options;
    osg::ref_ptr<osg::Node> _object;
    osg::Vec3d _position;
    double _heading = 0.0;
    osg::BoundingBoxd _bounds;
    std::vector<osg::Vec3d> _triangles;
    osg::ref_ptr<const TerrainShadows> _shown; ///< by compute().
    std::uint64_t _shownObject = 0;            ///< revision of the placed object then.
    unsigned _foundAlone = 0;                  ///< by compute().
    osg::ref_ptr<osg::StateSet> _program, _bitmapProgram;
    std::unique_ptr<TerrainShadowCache> _cache;
};

} // namespace gnomon
