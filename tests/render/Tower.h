// SPDX-License-Identifier: MIT
#pragma once
#include <support/Mesh.h>
#include <support/Picture.h>

#include <osg/Vec4d>

namespace test {

/// A tower in a sun that throws its shadow to the left, seen from the side on which that lies.
inline const osg::Vec4d sun(1.0, 0.3, 1.2, 0.0);
inline const Mesh tower = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});
inline View fromTheSide() { return perspective({-6.0, -9.0, 6.0}, {0.0, 0.0, 0.0}, 160, 120); }

} // namespace test
