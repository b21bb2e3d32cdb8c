// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Math>
#include <osg/Matrixd>

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

} // namespace gnomon::examples
