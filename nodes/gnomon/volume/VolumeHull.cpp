// SPDX-License-Identifier: MIT
#include <gnomon/silhouette/LightFacing.h>
#include <gnomon/silhouette/ShadowVolumes.h>
#include <gnomon/volume/VolumeHull.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {

VolumeHull volumeHull(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& end, const glm::dvec4& light,
                      const glm::dmat4& clipFromBox) {
    VolumeHull points;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        const glm::dvec3 away = awayFrom(light, corner);
        const double length = lengthTo(end, corner, light);
        points[i] = clipFromBox * glm::dvec4(corner, 1.0);
        points[i + 8] = clipFromBox * (length < 0.0 ? glm::dvec4(away, 0.0) : glm::dvec4(corner + length * away, 1.0));
    }
    return points;
}

/// Not if it is beyond one of the sides of what is seen.
bool isInSight(const VolumeHull& hull) {
    const auto isBeyond = [&hull](auto&& distance) { return std::all_of(hull.begin(), hull.begin() + 8, distance); };
    return !(isBeyond([](const glm::dvec4& at) { return at.x < -at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.x > at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.y < -at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.y > at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.z < -at.w; }));
}

std::optional<ScreenRect> boundsOf(const VolumeHull& hull) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ScreenRect rect{glm::dvec2(infinity), glm::dvec2(-infinity)};
    for (const glm::dvec4& point : hull) {
        if (!(point.w > 1e-6 * (std::abs(point.x) + std::abs(point.y))))
            return screenBounds({hull.begin(), hull.end()});
        const glm::dvec2 at = glm::dvec2(point) / point.w;
        rect.low = glm::min(rect.low, at);
        rect.high = glm::max(rect.high, at);
    }
    rect = common(rect, wholeScreen);
    if (!overlap(rect, rect)) return std::nullopt;
    return rect;
}

} // namespace gnomon
