// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawables.h>

#include <cstddef>
#include <vector>

namespace gnomon {

/// Whether two closed boxes have a point in common.
inline bool touch(const osg::BoundingBoxd& a, const osg::BoundingBoxd& b) { return a.intersects(b); }

/// For each piece the first of those that it is connected with over vertices at exactly one place, group frame: walls and a
/// roof of a house that are drawn apart. Reads the graph as a cull traversal does.
///
/// Cost  sorts the pieces, and those vertices that are within another piece's bounds.
std::vector<std::size_t> weldedDrawables(const CasterDrawables::List& pieces);

} // namespace gnomon
