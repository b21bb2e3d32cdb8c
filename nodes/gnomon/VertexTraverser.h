// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/Selection.h>

#include <osg/NodeVisitor>
#include <osg/Vec3d>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

class CasterExtraction;

/// Triangles and vertices of a subgraph, in the frame that its root stands in (as if the root had no parent), in
/// double.
///
/// Takes every primitive mode with and without indices, 2-, 3- and 4-component float and double arrays, ShapeDrawables,
/// nested and mirrored transforms; obeys switches, sequences, node masks; of an LOD it takes the most detailed child,
/// so that two views see the same casters. Points and lines have vertices but no triangles. A drawable's vertices stay
/// shared between its triangles; those that no primitive uses are left out.
///
///     gnomon::VertexTraverser casters;
///     scene->accept(casters);
///     std::optional<osg::Vec3d> corner = casters.nearestVertex({1.0, 2.0, 0.0});
///
/// Cost    one pass over the vertices; 24 bytes a vertex, 12 a triangle, and 8 a vertex of the largest array.
/// Limits  billboards, text, techniques, absolute transforms and cameras inside the subgraph are left out; instanced
///         primitives count once, and what a vertex shader moves stays where it was; integer vertex arrays are left out,
///         as by every functor of OpenSceneGraph's.
/// Threads reads the graph as a cull traversal does.
/// Source: ARL-TN-156, its vertex traverser, with the transforms that it ignored.
class GNOMON_EXPORT VertexTraverser : public osg::NodeVisitor {
public:
    explicit VertexTraverser(const Selection& selection = {});
    ~VertexTraverser() override;
    META_NodeVisitor(gnomon, VertexTraverser)

        void reset() override;
    void apply(osg::Node& root) override;

    /// All of them finite, and within the range of float.
    const std::vector<osg::Vec3d>& getVertices() const;
    /// Three indices into getVertices() a triangle, counter-clockwise seen from the side that was the front in the
    /// drawable's own frame, mirrored or not. Triangles of no area are kept, unless two of their indices are equal.
    const std::vector<unsigned>& getTriangles() const;

    /// Vertex nearest to `point`; nullopt if there is no vertex or `point` is not finite. Of equals the first.
    std::optional<osg::Vec3d> nearestVertex(const osg::Vec3d& point) const;
    /// The same in plan: nearest in (x, y), whatever the height.
    std::optional<osg::Vec3d> nearestVertexInPlan(double x, double y) const;

    /// Largest error that storing a vertex as float in its own array can have made, in the root's unit; 0 for doubles.
    double getRounding() const;
    /// Triangles left out: a corner is not finite, or beyond the range of float, or its index is out of the array.
    unsigned getInvalidTriangles() const;
    /// The nearest name on the way up from the first drawable that has such a triangle; its class if none has a name.
    const std::string& getInvalidNode() const;

private:
    osg::ref_ptr<CasterExtraction> _found;
};

} // namespace gnomon
