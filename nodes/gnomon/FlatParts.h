// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/Node>
#include <osg/Vec4d>

#include <vector>

namespace gnomon {

/// A plane that part of a subgraph lies in.
struct FlatPart {
    osg::Vec4d plane; ///< unit normal, towards the side that the triangles' front faces look to (counter-clockwise).
    double area;      ///< of its triangles, square units.
};

/// The planes that the triangles of a subgraph lie in, the largest area first; frame of the root, as VertexTraverser's.
/// Triangles belong together where their planes agree within the vertices' own rounding and face the same way. A table
/// top has six, a ground quad one. At most `limit` parts are returned. Triangles no higher than that rounding have no
/// plane.
///
/// Cost    an extraction and a sort of the triangles; 150 bytes a triangle while it runs.
GNOMON_EXPORT std::vector<FlatPart> flatParts(osg::Node& root, unsigned limit = 64);

} // namespace gnomon
