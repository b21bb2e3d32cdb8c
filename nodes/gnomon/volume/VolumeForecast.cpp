// SPDX-License-Identifier: MIT
#include <gnomon/silhouette/LightFacing.h>
#include <gnomon/silhouette/VolumeEnd.h>
#include <gnomon/volume/LightVolumes.h>
#include <gnomon/volume/VolumeForecast.h>
#include <gnomon/volume/VolumeHull.h>
#include <gnomon/volume/VolumeView.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>

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

/// What is to be drawn of one view.
class Forecaster {
public:
    Forecaster(const ViewFrame& view, const SceneFrame& scene, const glm::dvec4& light)
        : _light(light),
          _receivers(receiversOf(view, scene)),
          _planes(endPlanes(_receivers.low, _receivers.high)),
          _clipFromScene(scene.clipFromScene(view)),
          _pixels(view.pixels) {}

    /// One of whose edges nothing is known. @param low,high  bounds, in the scene.
    void add(const glm::dvec3& low, const glm::dvec3& high, double triangles) {
        const glm::dvec3 extent = high - low;
        const VolumeHull hull = volumeHull(low, high, nearestEnd(_planes, low, high, _light), _light, _clipFromScene);
        const double longest = std::max({extent.x, extent.y, extent.z});
        const double flat = longest > 0.0 ? std::min({extent.x, extent.y, extent.z}) / longest : 0.0;
        const glm::dvec3 way = awayFrom(_light, (low + high) / 2.0);
        const double steep = std::abs(way.z) / std::max(std::hypot(way.x, way.y), 1e-9 * glm::length(way));
        addSides(hull, outlineOf(triangles, flat, steep), triangles);
    }

    /// The volumes are found under AutoChooser's lock. Isolated: a thread that waits for others must not take up work that might
    /// ask in turn.
    void count(const VolumeCaster& caster) {
        const osg::ref_ptr<LightVolumes> volumes = new LightVolumes;
        tbb::this_task_arena::isolate([&] { volumes->set(caster, _light, _receivers); });
        const std::optional<SeenVolumes> seen = seenVolumes({volumes}, _clipFromScene);
        if (!seen) return;
        for (const SeenPart& each : seen->parts) {
            const SilhouetteMesh::Part& part = caster.mesh->parts[each.part];
            const ShadowVolumes::Part& volume = volumes->volumes().parts[each.part];
            const VolumeHull hull = volumeHull(glm::dvec3(part.low), glm::dvec3(part.high), volume.end,
                                               volumes->volumes().light, seen->meshes.front().clipFromMesh);
            addSides(hull, volume.edges, part.triangles);
            const unsigned backs = each.showsBack ? each.caps.light.count : 0u;
            const unsigned closing = each.holding ? 0u : each.caps.light.count + each.caps.dark.count;
            addCaps(hull, (backs + closing) / 3u);
        }
    }

    VolumeForecast all;

private:
    void addSides(const VolumeHull& hull, double sides, double triangles) {
        const auto seen = boundsOf(hull);
        if (!seen) return;
        const auto body = bodyOf(hull);
        const double edge = across(body.value_or(*seen), _pixels) * std::sqrt(3.0 / std::max(triangles, 3.0));
        constexpr double slanted = 0.64; // of a length, seen from any side
        all.sides += sides;
        all.pixels += sides * lengthOf(hull, *seen, _pixels) * (slanted * edge + narrowest);
    }

    /// They cover no more than the body's box.
    void addCaps(const VolumeHull& hull, double triangles) {
        all.caps += triangles;
        const auto body = triangles > 0.0 ? bodyOf(hull) : std::nullopt;
        if (!body) return;
        const glm::dvec2 size = (body->high - body->low) / 2.0;
        all.pixels += size.x * _pixels.x() * size.y * _pixels.y();
    }

    static std::optional<ScreenRect> bodyOf(const VolumeHull& hull) {
        return screenBounds({hull.begin(), hull.begin() + 8});
    }

    const glm::dvec4 _light; ///< in the scene.
    const ReceiverBox _receivers;
    const std::vector<glm::dvec4> _planes;
    const glm::dmat4 _clipFromScene;
    const osg::Vec2d _pixels;
};

} // namespace

VolumeForecast VolumeForecast::operator-(const VolumeForecast& some) const {
    return {std::max(sides - some.sides, 0.0), std::max(caps - some.caps, 0.0), std::max(pixels - some.pixels, 0.0),
            counted && some.counted};
}

VolumeForecast forecastVolumes(const ViewFrame& view, const CasterLayers& casters, const glm::dvec4& light,
                               OpenCasters& known, bool counts) {
    const SceneFrame scene(casters.origin);
    Forecaster forecaster(view, scene, light - light.w * glm::dvec4(scene.origin, 0.0));
    known.startRound();
    for (const PlacedMesh& placed : casters.meshes()) {
        const auto addAll = [&](const std::vector<DrawnCasters::Drawable>& drawables) {
            for (const DrawnCasters::Drawable& each : drawables) {
                const glm::dvec3 low = placed.isBody ? scene.point(placed.bounds._min) : glm::dvec3(each.low);
                const glm::dvec3 high = placed.isBody ? scene.point(placed.bounds._max) : glm::dvec3(each.high);
                forecaster.add(low, high, double(each.triangles));
            }
        };
        const DrawnCasters& drawn = known.of(*placed.mesh);
        addAll(drawn.closed);
        if (drawn.open.empty()) continue;
        if (counts && drawn.openEdges)
            forecaster.count({drawn.openEdges, placed.sceneFromMesh});
        else
            addAll(drawn.open), forecaster.all.counted = false;
    }
    return forecaster.all;
}

} // namespace gnomon
