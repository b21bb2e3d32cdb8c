// SPDX-License-Identifier: MIT
#pragma once
#include <osg/BoundingBox>
#include <osg/Vec3d>
#include <osg/Vec4d>

namespace gnomon {

struct ShadowInView;

/// How a view, a light and its casters lie, in a few numbers. All in the group's frame.
struct Situation {
    Situation() = default;
    explicit Situation(const ShadowInView& shadow);

    osg::Vec3d eye, ahead;     ///< a place; length 1.
    double lens = 1.0;         ///< how much larger the view shows things than one of 90 degrees.
    double seen = 0.0;         ///< leaves in sight.
    osg::Vec4d light;          ///< w = 0 and length 1, or w = 1.
    osg::BoundingBoxd casters; ///< valid; the eye where casters draw themselves and have no bounds.

    /// The largest share by which anything is not as it was. Angles are in radians. Ways of the eye and of a lamp are shares of the
    /// distance to the casters' box, to which a tenth of the box's diagonal is added. The box counts by its corners, as a share of
    /// its diagonal, and the leaves by their number.
    double changeTo(const Situation& now) const;
};

} // namespace gnomon
