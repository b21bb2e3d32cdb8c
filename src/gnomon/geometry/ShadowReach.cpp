// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ShadowReach.h>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

/// Those t from `from` to `to` at which some linear functions of t are not above 0.
struct Span {
    double from, to;

    void require(double atZero, double slope) {
        if (slope > 0.0)
            to = std::min(to, -atZero / slope);
        else if (slope < 0.0)
            from = std::max(from, -atZero / slope);
        else if (!(atZero <= 0.0))
            to = -std::numeric_limits<double>::infinity();
    }
};

} // namespace

/// A point p is at (1 - w t) p + t l on its way to the light (l, w). So at each t the surface's box has become another
/// box along the axes. It meets the caster's where it does so along each axis.
bool shadowReaches(const AlignedBox& caster, const AlignedBox& surface, const glm::dvec4& light) {
    Span way{0.0, light.w > 0.0 ? 1.0 / light.w : std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const double low = surface.low[axis], high = surface.high[axis];
        way.require(low - caster.high[axis], light[axis] - light.w * low);
        way.require(caster.low[axis] - high, light.w * high - light[axis]);
    }
    return way.from <= way.to;
}

} // namespace gnomon
