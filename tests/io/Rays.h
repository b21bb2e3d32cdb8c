// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Vec3d>

#include <algorithm>
#include <cmath>

namespace gnomon::testing {

/// How far along from + t · way a box is met, in the box's own frame; infinite if not.
inline double meetBox(const osg::Vec3d& from, const osg::Vec3d& way, const osg::Vec3d& low, const osg::Vec3d& high) {
    double enter = 0.0, leave = INFINITY;
    for (int i = 0; i < 3; ++i) {
        const double one = (low[i] - from[i]) / way[i], other = (high[i] - from[i]) / way[i];
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
    }
    return enter <= leave ? enter : INFINITY;
}

/// The same of a sphere, from outside.
inline double meetSphere(const osg::Vec3d& from, const osg::Vec3d& way, const osg::Vec3d& centre, double radius) {
    const osg::Vec3d away = from - centre;
    const double a = way * way, b = away * way, c = away * away - radius * radius;
    const double t = (-b - std::sqrt(b * b - a * c)) / a;
    return t > 0.0 ? t : INFINITY; // NaN too
}

} // namespace gnomon::testing
