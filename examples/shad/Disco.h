// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Math>
#include <osg/Matrixd>

#include <cmath>
#include <vector>

namespace gnomon::examples {

/// Where something that looks at the origin stands, y up. Degrees; at azimuth 0 it stands on the z axis.
struct Orbit {
    double elevation = 0.0, azimuth = 0.0, distance = 1.0;

    osg::Matrixd view() const {
        return osg::Matrixd::rotate(osg::DegreesToRadians(azimuth), osg::Y_AXIS) *
               osg::Matrixd::rotate(osg::DegreesToRadians(elevation), osg::X_AXIS) *
               osg::Matrixd::translate(0.0, 0.0, -distance);
    }
    osg::Vec3d place() const { return osg::Vec3d() * osg::Matrixd::inverse(view()); }
};

/// Where a light is, what disco adds to that, and how it then turns from the middle. Degrees.
struct DiscoPlace {
    Orbit orbit;
    double raise = 0.0, turn = 0.0, wiggle = 0.0;

    osg::Matrixd view() const {
        return Orbit{orbit.elevation + raise, orbit.azimuth + turn, orbit.distance}.view() *
               osg::Matrixd::rotate(osg::DegreesToRadians(wiggle), osg::Y_AXIS);
    }
};

/// Lights that move one after the other, a unit of disco time each, 0.03 a frame: the first swings by 25 degrees to both
/// sides, the second goes a third of the way round, the third tips over and, the next time, back.
/// @param frame  0 is the first. @return which of the lights has moved.
/// Source: CS-4470, part 2, discotimestep() of shad.c.
inline std::size_t discoStep(std::vector<DiscoPlace>& lights, int frame) {
    constexpr double step = 0.03;
    const double time = step * frame, t = (time - std::floor(time)) / (1.0 - step);
    const std::size_t unit = std::size_t(time), light = unit % lights.size(), round = unit / lights.size();
    DiscoPlace& p = lights[light];
    if (light == 0) p.wiggle = 25.0 * std::sin(2.0 * osg::PI * t);
    if (light == 1) p.turn = 120.0 * (t + double(round % 3));
    if (light == 2) p.raise = (180.0 - 2.0 * p.orbit.elevation) * (round % 2 ? 1.0 - t : t);
    return light;
}

} // namespace gnomon::examples
