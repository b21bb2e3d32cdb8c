// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>

#include <glm/vec2.hpp>
#include <osg/Group>

namespace gnomon::examples {

constexpr double townSide = 900.0; ///< metres, along the axes.
constexpr int townPlots = 20;      ///< along a side; a building each.

/// A group named "town": on a square of plots blocks turned at random, a fifth of them L-shaped, some towers, and some
/// tanks of 20 sides. Each stands in the ground, its foot 2 m below the lowest ground at its corners, and is one
/// closed mesh. The same every time.
/// @param ground  metres, all over the square.
osg::ref_ptr<osg::Group> makeTown(const Ground& ground, const glm::dvec2& centre);

} // namespace gnomon::examples
