// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterVisitor.h>

#include <osg/Referenced>
#include <osg/Vec3>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Extracts the triangles and vertices of a subgraph into one frame, in double.
///
/// Use it to read a scene's geometry: for picking, physics, ray casting or statistics. Use flatParts() to find planes
/// and groundOf() to read terrain.
///
///     gnomon::VertexTraverser casters;
///     scene->accept(casters);
///     std::optional<osg::Vec3d> corner = casters.nearestVertex({1.0, 2.0, 0.0});
///
/// The frame is the one that the visited node stands in: its own transform counts, its parents' transforms do not.
///
/// Reads
/// - Every primitive mode, with and without indices, and ShapeDrawables.
/// - Float and double vertex arrays of 2, 3 or 4 components.
/// - Nested and mirrored transforms, switches, sequences and node masks.
/// - The most detailed loaded children of an LOD, so that all views see the same casters.
/// - Points and lines as vertices without triangles.
/// Cost
/// - One pass over the vertices.
/// - 24 bytes a vertex, 12 bytes a triangle, and 8 bytes a vertex of the largest array.
/// Needs
/// - No OpenGL and no view.
/// Limits
/// - Leaves out cameras, projections, text, shadow techniques and absolute transforms.
/// - Leaves out billboards, and AutoTransforms that turn or scale with the view.
/// - Leaves out integer vertex arrays, as all of OpenSceneGraph's functors do.
/// - Leaves out vertices that no primitive uses.
/// - Counts instanced primitives once, and ignores displacement by vertex shaders.
/// Threads
/// - Reads the graph as a cull traversal does.
/// Source
/// - ARL-TN-156, its vertex traverser; this class adds the transforms.
class GNOMON_EXPORT VertexTraverser : public CasterVisitor {
public:
    /// @param selection  the part of the visited subgraph to extract. Default: all of it.
    explicit VertexTraverser(const Selection& selection = {});
    ~VertexTraverser() override = default;
    META_NodeVisitor(gnomon, VertexTraverser)

    /// Forgets all results, for another traversal.
    void reset() override;

    /// The vertices. All are finite and within the range of float. Triangles of one drawable share them.
    const std::vector<osg::Vec3d>& getVertices() const { return _vertices; }
    /// The triangles: three indices each into getVertices(), counter-clockwise as seen from the drawable's front side.
    /// A mirroring transform keeps the front side. Triangles of no area are kept unless two of their indices are equal.
    const std::vector<unsigned>& getTriangles() const { return _triangles; }

    /// A drawable that the traversal read. Its triangles end at the next drawable's first.
    struct Drawn {
        const osg::Drawable* drawable; ///< Identifies the drawable. Do not dereference it: the drawable may be gone.
        std::size_t first;             ///< Index of its first corner in getTriangles().
    };
    /// The drawables, in traversal order.
    const std::vector<Drawn>& getDrawn() const { return _drawn; }

    /// A drawable with an alpha test, such as leaves or a fence.
    struct Cutout {
        std::size_t drawn;                  ///< Its index in getDrawn().
        AlphaTest test;                     ///< The test. It has a texture.
        unsigned firstVertex;               ///< Index of its first vertex in getVertices(). Its others follow.
        std::vector<osg::Vec3> coordinates; ///< Texture coordinates (s, t, q), one for each of its vertices.
    };
    /// The drawables whose alpha test is known, in traversal order.
    const std::vector<Cutout>& getCutouts() const { return _cutouts; }
    /// Number of drawables whose alpha test is unknown, for example because a shader decides. They count as solid.
    unsigned getUnknownTests() const { return _unknownTests; }
    /// Name of the first drawable with an unknown alpha test, found as for getInvalidNode().
    const std::string& getUnknownNode() const { return _unknownNode; }

    /// Finds the vertex nearest to `point`, the first one among equals.
    /// @return nullopt if there is no vertex or `point` is not finite.
    std::optional<osg::Vec3d> nearestVertex(const osg::Vec3d& point) const;
    /// Finds the vertex nearest to (x, y) in plan, whatever its height.
    std::optional<osg::Vec3d> nearestVertexInPlan(double x, double y) const;

    /// Largest error from storing a vertex as float in its own array, in the root's unit. 0 for double arrays.
    double getRounding() const { return _rounding; }
    /// Number of triangles left out because a corner is not finite, beyond the range of float, or not in the array.
    unsigned getInvalidTriangles() const { return _invalidTriangles; }
    /// Name of the first drawable with an invalid triangle: its own, or that of the nearest named node above it.
    /// Its class name if none of them has a name.
    const std::string& getInvalidNode() const { return _invalidNode; }

    /// The arrays and primitive sets that were read. Hold them to keep their addresses from being used again.
    const std::vector<osg::ref_ptr<const osg::Referenced>>& getSources() const { return _sources; }

protected:
    /// Reads one drawable.
    void applyCaster(osg::Drawable& drawable) override;

private:
    class Collector;
    /// Where a vertex of the current array went: its place in _vertices, if `array` is the current one's number.
    struct Slot {
        unsigned array = 0;
        unsigned place = 0;
    };
    /// Its place in _cutouts; null if no test leaves parts of it.
    Cutout* startCutout(const osg::Drawable& drawable);
    std::string nameHere(const osg::Drawable& drawable) const;

    std::vector<osg::Vec3d> _vertices;
    std::vector<unsigned> _triangles;
    std::vector<osg::ref_ptr<const osg::Referenced>> _sources;
    std::vector<Drawn> _drawn;
    std::vector<Cutout> _cutouts;
    std::vector<Slot> _slots;
    unsigned _array = 0;
    double _rounding = 0.0;
    unsigned _invalidTriangles = 0;
    std::string _invalidNode;
    unsigned _unknownTests = 0;
    std::string _unknownNode;
};

} // namespace gnomon
