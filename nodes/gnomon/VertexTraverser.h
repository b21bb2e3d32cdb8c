// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterVisitor.h>

#include <osg/Vec3d>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Triangles and vertices of a subgraph, in the frame that its root stands in (as if the root had no parent), in double.
///
/// Takes every primitive mode with and without indices, 2-, 3- and 4-component float and double arrays, ShapeDrawables,
/// nested and mirrored transforms; obeys switches, sequences, node masks; of an LOD it takes the most detailed child,
/// so that two views see the same casters. Leaves out what CasterVisitor leaves out. Points and lines have vertices but no triangles.
///
///     gnomon::VertexTraverser casters;
///     scene->accept(casters);
///     std::optional<osg::Vec3d> corner = casters.nearestVertex({1.0, 2.0, 0.0});
///
/// Cost    one pass over the vertices; 24 bytes a vertex, 12 a triangle.
/// Limits  billboards, text, absolute transforms and cameras inside the subgraph are left out.
/// Threads reads the graph as a cull traversal does.
/// Source: ARL-TN-156, its vertex traverser, with the transforms that it ignored.
class GNOMON_EXPORT VertexTraverser : public CasterVisitor {
public:
    explicit VertexTraverser(const Selection& selection = {});
    META_NodeVisitor(gnomon, VertexTraverser)

    void reset() override;
    void apply(osg::Drawable& drawable) override;

    const std::vector<osg::Vec3d>& getVertices() const { return _vertices; }
    /// Three indices into getVertices() a triangle. Triangles of no area are kept; those with a vertex that is not finite are not.
    const std::vector<unsigned>& getTriangles() const { return _triangles; }

    /// Vertex nearest to `point`; nullopt if there is no finite vertex or `point` is not finite. Of equals the first.
    std::optional<osg::Vec3d> nearestVertex(const osg::Vec3d& point) const;
    /// The same in plan: nearest in (x, y), whatever the height.
    std::optional<osg::Vec3d> nearestVertexInPlan(double x, double y) const;

    /// Largest error that storing a vertex as float in its own array can have made, in the root's unit; 0 for doubles.
    double getRounding() const { return _rounding; }
    unsigned getInvalidTriangles() const { return _invalidTriangles; }
    const std::string& getInvalidNode() const { return _invalidNode; }

protected:
    ~VertexTraverser() override = default;

private:
    std::vector<osg::Vec3d> _vertices;
    std::vector<unsigned> _triangles;
    double _rounding = 0.0;
    unsigned _invalidTriangles = 0;
    std::string _invalidNode;
};

} // namespace gnomon
