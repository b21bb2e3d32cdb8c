// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>

#include <functional>
#include <glm/vec2.hpp>
#include <osg/Group>

namespace gnomon::examples {

/// How a town is laid out: a square of plots.
struct TownPlan {
    int buildings = 400; ///< a plot each, 1 or more.
    int plots() const;   ///< along a side.
    double side() const; ///< metres, along the axes.
};

/// A group named "town": on the plots blocks turned at random, a fifth of them L-shaped, some towers, and some tanks of 20
/// sides. Each stands in the ground, its foot 2 m below the lowest ground at its corners, and is one closed mesh. They are
/// drawn by neighbourhoods, so that those out of sight can be left out. The same every time.
/// @param ground    metres, all over the square.
/// @param progress  told the share that is done, 0 … 1.
osg::ref_ptr<osg::Group> makeTown(
    const Ground& ground, const glm::dvec2& centre, const TownPlan& plan = {},
    const std::function<void(double)>& progress = [](double) {});

} // namespace gnomon::examples
