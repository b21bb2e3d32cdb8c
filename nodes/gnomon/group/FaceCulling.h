// SPDX-License-Identifier: MIT
#pragma once
#include <osgUtil/RenderLeaf>

namespace gnomon {

/// True if nothing of a leaf is seen because all its faces are turned so that face culling leaves them out.
///
/// Cost  the triangles up to the first that is seen.
bool areAllFacesCulled(const osgUtil::RenderLeaf& leaf);

} // namespace gnomon
