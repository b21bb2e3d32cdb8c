// SPDX-License-Identifier: MIT
#pragma once
#include <support/Mesh.h>

#include <osg/Geode>
#include <osg/Vec4d>

namespace test {

/// One of 8 × 8 tiles of a hilly ground of 800 × 800 m. @param cells  on a side of it.
osg::ref_ptr<osg::Geode> hillTile(int column, int row, int cells);
/// The middle of a tile in plan.
osg::Vec3 centreOfTile(int column, int row);
/// A sun 35° above the level.
osg::Vec4d sunOverHills();

} // namespace test
