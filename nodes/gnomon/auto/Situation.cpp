// SPDX-License-Identifier: MIT
#include <gnomon/auto/CandidateFacts.h>
#include <gnomon/auto/Situation.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

double distance(const osg::BoundingBoxd& box, const osg::Vec3d& place) {
    osg::Vec3d nearest;
    for (int axis = 0; axis < 3; ++axis) nearest[axis] = std::clamp(place[axis], box._min[axis], box._max[axis]);
    return (nearest - place).length();
}

double ratio(double then, double now) { return std::abs(now / then - 1.0); }

osg::Vec3d directionOf(const osg::Vec4d& sun) { return {sun.x(), sun.y(), sun.z()}; }

} // namespace

Situation::Situation(const ShadowInView& shadow)
    : lens(shadow.view.projection(1, 1)),
      seen(double(shadow.view.seen.size())),
      light(shadow.towards.x, shadow.towards.y, shadow.towards.z, shadow.towards.w),
      casters(shadow.casters.bounds) {
    const osg::Matrixd groupFromEye = osg::Matrixd::inverse(shadow.view.eyeFromGroup);
    eye = groupFromEye.getTrans();
    ahead = osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, -1.0), groupFromEye);
    ahead.normalize();
    if (!casters.valid() || !std::isfinite(casters.radius2())) casters.set(eye, eye);
}

double Situation::changeTo(const Situation& now) const {
    const double size = std::max((casters._max - casters._min).length(), 1e-12);
    const auto moved = [&](const osg::Vec3d& from, const osg::Vec3d& to) {
        return (to - from).length() / (distance(casters, from) + 0.1 * size);
    };
    const osg::Vec3d lamp = directionOf(light), lampNow = directionOf(now.light);
    return std::max({moved(eye, now.eye), (now.ahead - ahead).length(), ratio(lens, now.lens),
                     ratio(std::max(seen, 1.0), std::max(now.seen, 1.0)),
                     light.w() > 0.0 ? moved(lamp, lampNow) : (lampNow - lamp).length(),
                     (now.casters._min - casters._min).length() / size,
                     (now.casters._max - casters._max).length() / size});
}

} // namespace gnomon
