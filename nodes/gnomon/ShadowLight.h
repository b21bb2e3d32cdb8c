// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Vec4d>

namespace gnomon {

/// A light whose shadow is wanted.
struct ShadowLight {
    int number = 0;     ///< OpenGL light number, 0 … 7: whose diffuse and specular the shadow takes away.
    osg::Vec4d inGroup; ///< homogeneous, group frame: w = 0 the way towards a sun, w = 1 a lamp's position.

    bool operator==(const ShadowLight& other) const { return number == other.number && inGroup == other.inGroup; }
};

} // namespace gnomon
