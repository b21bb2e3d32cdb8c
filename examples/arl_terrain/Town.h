// SPDX-License-Identifier: MIT
#pragma once
#include "SceneSetup.h"

#include <gnomon/SunClock.h>

#include <glm/vec2.hpp>
#include <osg/Shape>

namespace gnomon::examples {

/// How a town is laid out: a square of plots.
struct TownPlan {
    int buildings = 400; ///< a plot each, 1 or more.
    int plots() const;   ///< along a side.
    double side() const; ///< metres, along the axes.
};

/// Middle of the square of this side, along the axes, where a town stands best: its steepest cell is gentle, it rises
/// to the north, so that the sun is on it, and no post in it lacks a height, as far as 16 posts a side tell.
/// @param field  its origin is 0, and its rotation none.
/// @param side   field's unit, > 0.
/// @throws std::runtime_error, one sentence, if the field has no such square.
glm::dvec2 townSite(const osg::HeightField& field, double side);

/// Mean solar time at which the sun is up; at the ends 4.7 and 7.6 degrees, whatever the model.
constexpr double firstHour = 6.5, lastHour = 17.5;

/// The sun over the Jacksboro fault (36.6° north) on 20 March 2026.
SunPosition townSun(double hour);

/// A town on an elevation model: nodes "town", which casts, and "terrain", which receives; a camera that looks over it.
class TownScene {
public:
    /// @param view    shadows and picture's size; what else it says is not looked at.
    /// @param plan    of the town. ProgressLine is shown on a terminal.
    /// @param terrain metres. Its origin becomes 0, so that floats suffice.
    /// @throws std::runtime_error, one sentence, if it has no place for a town.
    TownScene(ViewOptions view, double hour, osg::HeightField& terrain, const TownPlan& plan = {});

    /// @param hour  firstHour to lastHour.
    void setHour(double hour);
    double hour() const { return _hour; }
    const ViewOptions& view() const { return _view; }
    SceneSetup& setup() { return _setup; }
    const SceneSetup& setup() const { return _setup; }

private:
    double _given, _hour;
    ViewOptions _view;
    SceneSetup _setup;
};

} // namespace gnomon::examples
