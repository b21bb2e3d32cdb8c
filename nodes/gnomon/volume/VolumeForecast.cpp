// SPDX-License-Identifier: MIT
#include <gnomon/silhouette/LightFacing.h>
#include <gnomon/silhouette/VolumeEnd.h>
#include <gnomon/volume/ReceiverBox.h>
#include <gnomon/volume/VolumeForecast.h>
#include <gnomon/volume/VolumeHull.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double narrowest = 14.0;  // pixels: llvmpipe looks at squares of 4 × 4 pixels along both triangles of a side
constexpr double ofATerrain = 2000; // triangles, and more

/// Edges on the outline of a body. Those of a terrain are the fewer the flatter it is and the higher the light.
/// @param flat   its shortest extent over its longest.
/// @param steep  tangent of the angle between the way of the light and the level.
double outlineOf(double triangles, double flat, double steep) {
    const double dense = 0.45 * std::pow(triangles, 0.8);
    const double folded = triangles < ofATerrain ? 1.0 : std::min(1.0, 4.0 * flat / std::max(steep, 1e-3));
    return std::max(std::min(triangles, 6.0), dense * folded);
}

/// Pixels from one corner of a rectangle to the other.
double across(const ScreenRect& rect, const osg::Vec2d& pixels) {
    return glm::length((rect.high - rect.low) / 2.0 * glm::dvec2(pixels.x(), pixels.y()));
}

/// From the middle of a box to where its volume ends, as far as that is in sight, pixels.
double lengthOf(const VolumeHull& hull, const ScreenRect& seen, const osg::Vec2d& pixels) {
    const glm::dvec4 from = hull[0] + hull[7], to = hull[8] + hull[15];
    const double most = across(seen, pixels);
    if (!(from.w > 0.0 && to.w > 0.0)) return most;
    const glm::dvec2 way = (glm::dvec2(to) / to.w - glm::dvec2(from) / from.w) / 2.0;
    return std::min(most, glm::length(way * glm::dvec2(pixels.x(), pixels.y())));
}

void add(VolumeForecast& all, const CasterDrawable& caster, const std::vector<glm::dvec4>& planes,
         const glm::dvec4& light, const glm::dmat4& clipFromGroup, const osg::Vec2d& pixels) {
    const glm::dvec3 low = toGlm(caster.bounds._min), high = toGlm(caster.bounds._max), extent = high - low;
    const VolumeHull hull = volumeHull(low, high, nearestEnd(planes, low, high, light), light, clipFromGroup);
    const auto seen = boundsOf(hull);
    if (!seen) return;
    const auto body = screenBounds({hull.begin(), hull.begin() + 8});
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double flat = longest > 0.0 ? std::min({extent.x, extent.y, extent.z}) / longest : 0.0;
    const glm::dvec3 way = awayFrom(light, (low + high) / 2.0);
    const double steep = std::abs(way.z) / std::max(std::hypot(way.x, way.y), 1e-9 * glm::length(way));
    const double triangles = double(caster.triangles), sides = outlineOf(triangles, flat, steep);
    const double edge = across(body.value_or(*seen), pixels) * std::sqrt(3.0 / std::max(triangles, 3.0));
    constexpr double slanted = 0.64; // of a length, seen from any side
    all.sides += sides;
    all.pixels += sides * lengthOf(hull, *seen, pixels) * (slanted * edge + narrowest);
}

} // namespace

VolumeForecast forecastVolumes(const ViewFrame& view, const CasterDrawables& casters, const glm::dvec4& light) {
    const SceneFrame group(glm::dvec3(0.0));
    const ReceiverBox receivers = receiversOf(view, group);
    const std::vector<glm::dvec4> planes = endPlanes(receivers.low, receivers.high);
    const glm::dmat4 clipFromGroup = group.clipFromScene(view);
    VolumeForecast all;
    for (const auto& caster : casters.list)
        if (caster->bounds.valid()) add(all, *caster, planes, light, clipFromGroup, view.pixels);
    return all;
}

} // namespace gnomon
