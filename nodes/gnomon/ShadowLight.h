// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Vec3d>
#include <osg/Vec4d>

namespace gnomon {

/// A light that casts shadows, given by its position in the group's frame.
///
/// Use it with ShadowCasterGroup::addLight() and ShadowQuery. Positions are in double, for lamps far from the origin.
/// If the scene has an osg::LightSource in the right place, pass that instead.
struct ShadowLight {
    int number = 0;     ///< OpenGL light number, 0 … 7. The shadow removes this light's diffuse and specular.
    osg::Vec4d inGroup; ///< Homogeneous, group frame: w = 0 is the direction towards a sun, w = 1 a lamp's position.
    /// Direction of a spot's cone, group frame, any length. Default (0, 0, -1).
    osg::Vec3d direction{0.0, 0.0, -1.0};
    /// Angle from a spot's axis to the side of its cone, degrees, 0 … 90. The default, 180, is a lamp without a cone.
    double cutoff = 180.0;

    /// True if all members are equal.
    bool operator==(const ShadowLight& other) const {
        return number == other.number && inGroup == other.inGroup && direction == other.direction &&
               cutoff == other.cutoff;
    }
};

} // namespace gnomon
