// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Geometry>

namespace gnomon {

/// Keeps a geometry's arrays and primitive sets, which it has already, in buffer objects, and tells OpenGL that they change:
/// a driver may put what is said to be static where writing takes long.
inline void keepInChangingBuffers(osg::Geometry& geometry) {
    geometry.setUseDisplayList(false);
    geometry.setUseVertexBufferObjects(true);
    geometry.getOrCreateVertexBufferObject()->setUsage(GL_DYNAMIC_DRAW);
    geometry.getOrCreateElementBufferObject()->setUsage(GL_DYNAMIC_DRAW);
}

} // namespace gnomon
