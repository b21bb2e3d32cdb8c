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
/// - Quads as the driver that draws this process's shadows cuts them; before it has drawn any, from the second vertex to the fourth.
/// - Float, double and integer vertex arrays of 2, 3 or 4 components; integers normalised if their array says so.
/// - Nested and mirrored transforms, switches, sequences and node masks.
/// - The most detailed loaded children of an LOD, for there is no view that chooses.
/// - Points and lines as vertices without triangles.
/// Cost
/// - One pass over the vertices.
/// - 24 bytes a vertex, 12 bytes a triangle, and 8 bytes a vertex of the largest array.
/// Needs
/// - No OpenGL and no view.
/// Limits
/// - Leaves out cameras, projections, text, shadow techniques and absolute transforms.
/// - Leaves out billboards, and AutoTransforms that turn or scale with the view.
/// - Leaves out drawables that hand out no triangles: particles, patches, and classes that only draw themselves.
/// - Leaves out vertices that no primitive uses.
/// - Counts instanced primitives once, and ignores displacement by vertex shaders.
/// Threads
/// - Reads the graph as a cull traversal does.
/// Source
/// - ARL-TN-156, its vertex traverser; this class adds the transforms.
class GNOMON_EXPORT VertexTraverser : public osg::NodeVisitor {
public:
    /// @param selection  the part of the visited subgraph to extract. Default: all of it.
    explicit VertexTraverser(const Selection& selection = {});
    /// Not to be copied: it holds what it has found.
    VertexTraverser(const VertexTraverser&) = delete;
    /// Not to be copied.
    VertexTraverser& operator=(const VertexTraverser&) = delete;
    ~VertexTraverser() override;
    META_NodeVisitor(gnomon, VertexTraverser)

    /// Forgets all results, for another traversal.
    void reset() override;
    /// Extracts the subgraph. osg::Node::accept() calls it.
    void apply(osg::Node& root) override;

    /// The vertices. All are finite and within the range of float. Triangles of one drawable share them.
    const std::vector<osg::Vec3d>& getVertices() const;
    /// The triangles: three indices each into getVertices(), counter-clockwise as seen from the drawable's front side.
    /// A mirroring transform keeps the front side. Triangles of no area are kept unless two of their indices are equal.
    const std::vector<unsigned>& getTriangles() const;

    /// Finds the vertex nearest to `point`, the first one among equals.
    /// @return nullopt if there is no vertex or `point` is not finite.
    std::optional<osg::Vec3d> nearestVertex(const osg::Vec3d& point) const;

    /// Largest error from storing a vertex as float in its own array, in the root's unit. 0 for double arrays.
    double getRounding() const;
    /// Number of triangles left out because a corner is not finite, beyond the range of float, or not in the array.
    unsigned getInvalidTriangles() const;
    /// Name of the first drawable with an invalid triangle: its own, or that of the nearest named node above it.
    /// Its class name if none of them has a name.
    const std::string& getInvalidNode() const;

private:
    osg::ref_ptr<CasterExtraction> _found;
};

} // namespace gnomon
