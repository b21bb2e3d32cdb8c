// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/Ground.h>
#include <gnomon/Selection.h>

#include <memory>

namespace osg {
class HeightField;
}

namespace gnomon {

/// The ground that a subgraph draws, in the frame of `root` as VertexTraverser's, z up, in double. Never null; where
/// nothing is drawn the ground is empty.
///
/// What is a regular grid along x and y, cells cut along either diagonal or left out, becomes a HeightPyramid, whose drapes
/// adapt: a ShapeDrawable of an osg::HeightField, a mesh, terrain tiles side by side as osgTerrain's GeometryTechnique draws
/// them. All else becomes a TriangleGround. A height field's skirt and border are left out; its posts without a height (see
/// isHeight()) are holes, whatever is drawn there.
///
/// Limits  those of VertexTraverser: what a vertex shader lifts, as osgTerrain's DisplacementMappingTechnique does, is not
///         seen.
/// @param groundFromRoot  to the frame that the ground is wanted in, of the root's own.
///
/// Cost    what VertexTraverser costs, and the ground's own. Holds nothing of the graph: make it anew after changes.
/// Threads reads the graph as a cull traversal does.
GNOMON_EXPORT std::shared_ptr<const Ground> groundOf(osg::Node& root, const Selection& terrain = {},
                                                     const osg::Matrixd& groundFromRoot = osg::Matrixd::identity());

/// The same of a field alone, as osgDB::readRefHeightFieldFile() returns it for an elevation model.
GNOMON_EXPORT std::shared_ptr<const Ground> groundOf(const osg::HeightField& field);

/// False for what elevation models hold where nothing was measured, -9999, -99999, -32767 and -32768 to the bit, and for
/// what is not finite or beyond 10¹⁸. OpenSceneGraph's readers do not pass on which of them a file uses.
GNOMON_EXPORT bool isHeight(float value);

} // namespace gnomon
