// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Group>

namespace gnomon::examples {

/// A copy of a subgraph with the shapes as they are drawn, and none of their looks: no materials, textures, programs, fog
/// or blending. What is left is back-face culling, polygon offset and alpha test with its texture, without which other
/// pixels would be drawn. Geometries without normals get smooth ones. Vertex arrays are shared with the original.
osg::ref_ptr<osg::Group> whiteCopy(const osg::Group& content);

} // namespace gnomon::examples
