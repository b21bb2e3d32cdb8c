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

/// Reads terrain from a subgraph, for questions about heights, rays and slopes. See Ground.
///
///     const std::shared_ptr<const gnomon::Ground> ground = gnomon::groundOf(*terrain);
///     const std::optional<double> height = ground->height(x, y);
///
/// A regular grid along x and y is recognised and answers faster: an osg::HeightField, a mesh, or osgTerrain's tiles
/// side by side. Cells may be cut along either diagonal or be missing. Other terrain is kept as triangles.
/// A height field's skirt and border are left out. Posts without a height, see isHeight(), are holes.
///
/// @param root            the subgraph.
/// @param terrain         the part of it that is terrain. Default: all of it.
/// @param groundFromRoot  transform to the frame of the ground, z up, from the root's frame as VertexTraverser has it.
/// @return                never null; an empty ground if there is no terrain.
///
/// Cost
/// - One extraction as by VertexTraverser, and the ground's own structure.
/// Needs
/// - No OpenGL and no view.
/// Limits
/// - The ground does not follow later changes of the graph.
/// - Heights from vertex shaders, as osgTerrain's DisplacementMappingTechnique makes them, are not seen.
/// - VertexTraverser's limits hold.
/// Threads
/// - Reads the graph as a cull traversal does.
GNOMON_EXPORT std::shared_ptr<const Ground> groundOf(osg::Node& root, const Selection& terrain = {},
                                                     const osg::Matrixd& groundFromRoot = osg::Matrixd::identity());

/// Reads terrain from a height field, such as an elevation model by osgDB::readRefHeightFieldFile().
GNOMON_EXPORT std::shared_ptr<const Ground> groundOf(const osg::HeightField& field);

} // namespace gnomon
