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

/// Triangles and vertices of a subgraph, in the frame that its root stands in (as if the root had no parent), in
/// double.
///
/// Takes every primitive mode with and without indices, 2-, 3- and 4-component float and double arrays, ShapeDrawables,
/// nested and mirrored transforms; obeys switches, sequences, node masks; of an LOD it takes the most detailed child,
/// so that two views see the same casters. Leaves out what CasterVisitor leaves out. Points and lines have vertices but
/// no triangles. A drawable's vertices stay shared between its triangles; those that no primitive uses are left out.
///
///     gnomon::VertexTraverser casters;
///     scene->accept(casters);
///     std::optional<osg::Vec3d> corner = casters.nearestVertex({1.0, 2.0, 0.0});
///
/// Cost    one pass over the vertices; 24 bytes a vertex, 12 a triangle, and 8 a vertex of the largest array.
/// Limits  billboards, text, absolute transforms and cameras inside the subgraph are left out; instanced primitives
///         count once, and what a vertex shader moves stays where it was; integer vertex arrays are left out, as by every
///         functor of OpenSceneGraph's.
/// Threads reads the graph as a cull traversal does.
/// Source: ARL-TN-156, its vertex traverser, with the transforms that it ignored.
class GNOMON_EXPORT VertexTraverser : public CasterVisitor {
public:
    explicit VertexTraverser(const Selection& selection = {});
    ~VertexTraverser() override = default;
    META_NodeVisitor(gnomon, VertexTraverser)

        void reset() override;

    /// All of them finite, and within the range of float.
    const std::vector<osg::Vec3d>& getVertices() const { return _vertices; }
    /// Three indices into getVertices() a triangle, counter-clockwise seen from the side that was the front in the
    /// drawable's own frame, mirrored or not. Triangles of no area are kept, unless two of their indices are equal.
    const std::vector<unsigned>& getTriangles() const { return _triangles; }

    /// A drawable that was met, and where its triangles begin in getTriangles(); they end where the next one's begin.
    struct Drawn {
        const osg::Drawable* drawable; ///< to be told apart from others only: it may be gone.
        std::size_t first;
    };
    const std::vector<Drawn>& getDrawn() const { return _drawn; }

    /// One of them that an alpha test leaves parts of.
    struct Cutout {
        std::size_t drawn;                  ///< its place in getDrawn().
        AlphaTest test;                     ///< which has a texture.
        unsigned firstVertex;               ///< in getVertices(), where all of its own follow one another.
        std::vector<osg::Vec3> coordinates; ///< of the texture, of each of its vertices.
    };
    const std::vector<Cutout>& getCutouts() const { return _cutouts; }
    /// Drawables that an alpha test leaves parts of which are not known here.
    unsigned getUnknownTests() const { return _unknownTests; }
    /// As getInvalidNode(), of the first of them.
    const std::string& getUnknownNode() const { return _unknownNode; }

    /// Vertex nearest to `point`; nullopt if there is no vertex or `point` is not finite. Of equals the first.
    std::optional<osg::Vec3d> nearestVertex(const osg::Vec3d& point) const;
    /// The same in plan: nearest in (x, y), whatever the height.
    std::optional<osg::Vec3d> nearestVertexInPlan(double x, double y) const;

    /// Largest error that storing a vertex as float in its own array can have made, in the root's unit; 0 for doubles.
    double getRounding() const { return _rounding; }
    /// Triangles left out: a corner is not finite, or beyond the range of float, or its index is out of the array.
    unsigned getInvalidTriangles() const { return _invalidTriangles; }
    /// The nearest name on the way up from the first drawable that has such a triangle; its class if none has a name.
    const std::string& getInvalidNode() const { return _invalidNode; }

    /// Arrays and primitive sets that were read. While they are held, nothing new can take their addresses: a
    /// CasterRevision compared with an earlier value relies on it.
    const std::vector<osg::ref_ptr<const osg::Referenced>>& getSources() const { return _sources; }

protected:
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
