// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>
#include <osg/Shape>

namespace gnomon::examples {

/// Middle of the square of this side, along the axes, where a town stands best: its steepest cell is gentle, it rises
/// to the north, so that the sun is on it, and no post in it lacks a height, as far as 16 posts a side tell.
/// @param field  its origin is 0, and its rotation none.
/// @param side   field's unit, > 0.
/// @throws std::runtime_error, one sentence, if the field has no such square.
glm::dvec2 townSite(const osg::HeightField& field, double side);

} // namespace gnomon::examples
