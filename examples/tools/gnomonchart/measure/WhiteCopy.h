// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Group>

namespace gnomon::examples {

/// A copy of a subgraph with the shapes as they are drawn, and none of their looks: no materials, textures, programs or fog.
/// What is left is that without which other pixels would be drawn: culling, polygon offset and mode, clip planes, depth,
/// masks, restarts, and an alpha test or blending with its texture and material. Geometries without normals get smooth ones. Vertex arrays are shared with the original.
osg::ref_ptr<osg::Group> whiteCopy(const osg::Group& content);

} // namespace gnomon::examples
