// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Vec3d>
#include <osg/Vec4d>

namespace gnomon {

/// A light whose shadow is wanted.
struct ShadowLight {
    int number = 0;     ///< OpenGL light number, 0 … 7: whose diffuse and specular the shadow takes away.
    osg::Vec4d inGroup; ///< homogeneous, group frame: w = 0 the way towards a sun, w = 1 a lamp's position.
    /// Of a lamp that is a spot: the way its cone opens, group frame, of any length.
    osg::Vec3d direction{0.0, 0.0, -1.0};
    /// From a spot's axis to its cone's side, degrees, 0 … 90; default 180: a lamp that shines all around.
    double cutoff = 180.0;

    bool operator==(const ShadowLight& other) const {
        return number == other.number && inGroup == other.inGroup && direction == other.direction &&
               cutoff == other.cutoff;
    }
};

} // namespace gnomon
