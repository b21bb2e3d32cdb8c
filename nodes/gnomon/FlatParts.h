// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/Node>
#include <osg/Vec4d>

#include <vector>

namespace gnomon {

/// A plane that some triangles of a subgraph share.
struct FlatPart {
    osg::Vec4d plane; ///< (a, b, c, d) with a unit normal. The normal points to the triangles' front side.
    double area;      ///< Sum of the triangles' areas, square units.
};

/// Finds the flat parts of a subgraph, for example the planes to give to PlanarShadowNode.
///
/// A ground quad has one flat part, a table top six. Triangles share a part if their planes agree within the rounding
/// of their vertices and face the same way. The front side is the one that sees the corners counter-clockwise.
///
/// @param root   the subgraph. Planes are in its frame as VertexTraverser defines it.
/// @param limit  most parts to return.
/// @return       the parts, largest area first.
///
/// Cost
/// - One extraction and one sort of the triangles.
/// - 150 bytes a triangle while it runs.
/// Needs
/// - No OpenGL and no view.
/// Limits
/// - Skips triangles that are no higher than the rounding of their vertices.
/// - VertexTraverser's limits hold.
/// Threads
/// - Reads the graph as a cull traversal does.
GNOMON_EXPORT std::vector<FlatPart> flatParts(osg::Node& root, unsigned limit = 64);

} // namespace gnomon
