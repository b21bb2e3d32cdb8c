// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>

#include <glm/vec4.hpp>
#include <osg/Viewport>

#include <vector>

namespace gnomon {

/// A leaf that OpenGL draws off its place, and its triangles in clip space as far as they are seen.
struct VastLeaf {
    DrawnLeaf entry;
    std::vector<glm::vec4> corners;
};

/// Finds leaves with polygons so vast that their depths are off, as a ground of many kilometres that begins under the eye:
/// OpenGL cuts it at the near plane in floats of that size.
///
/// Cost    a look at each leaf's box; at the triangles of those that are vast.
/// Limits  drawables of up to 2,000 triangles, which a program may not move, seen in perspective.
std::vector<VastLeaf> vastLeaves(const std::vector<DrawnLeaf>& leaves, const osg::Viewport& viewport);

} // namespace gnomon
