// SPDX-License-Identifier: MIT
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/silhouette/ShadowVolumes.h>
#include <gnomon/volume/LightVolumes.h>
#include <gnomon/volume/VolumeForecast.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace gnomon {
namespace {

constexpr unsigned keptRounds = 16; // views of different levels of detail take turns

/// Two numbers that stand for a place. -0 is 0.
struct PlaceKeys {
    explicit PlaceKeys(const glm::vec3& place) {
        Fingerprint key;
        for (int axis = 0; axis < 3; ++axis) key.mix(double(place[axis] + 0.0f));
        first = key.value();
        key.mix(std::uint64_t{1});
        second = key.value();
    }
    std::uint64_t first, second;
};

/// Corners of a drawable's triangles, in a mesh.
struct Share {
    const unsigned *begin, *end;
};

std::vector<Share> sharesOf(const CasterMesh& mesh) {
    const unsigned* corners = &mesh.triangles->front();
    std::vector<Share> shares{{corners, corners}};
    for (const CasterExtraction::Drawn& drawn : mesh.drawn) {
        shares.back().end = corners + drawn.first;
        shares.push_back({corners + drawn.first, nullptr});
    }
    shares.back().end = corners + mesh.triangles->size();
    return shares;
}

/// True if each edge is passed as often one way as the other: what an edge adds changes its sign with the way.
bool isClosed(const Share& share, const std::vector<PlaceKeys>& keys) {
    std::uint64_t sum = 0;
    for (const unsigned* triangle = share.begin; triangle != share.end; triangle += 3)
        for (int side = 0; side < 3; ++side) {
            const PlaceKeys &from = keys[triangle[side]], &to = keys[triangle[(side + 1) % 3]];
            sum += from.first * to.second - to.first * from.second;
        }
    return sum == 0;
}

DrawnCasters::Drawable drawableOf(const Share& share, const glm::vec3* positions) {
    DrawnCasters::Drawable result{glm::vec3(std::numeric_limits<float>::infinity()), {}, 0};
    result.high = -result.low;
    for (const unsigned* corner = share.begin; corner != share.end; ++corner) {
        result.low = glm::min(result.low, positions[*corner]);
        result.high = glm::max(result.high, positions[*corner]);
    }
    result.triangles = static_cast<std::size_t>(share.end - share.begin) / 3;
    return result;
}

/// @param places  three a triangle.
std::shared_ptr<const SilhouetteMesh> edgesOf(const std::vector<glm::vec3>& places) {
    if (places.empty() || places.size() > 3 * OpenCasters::mostTriangles) return nullptr;
    std::vector<unsigned> corners(places.size());
    std::iota(corners.begin(), corners.end(), 0u);
    return std::make_shared<const SilhouetteMesh>(
        SilhouetteMesh::Source{places.data(), places.size(), corners.data(), corners.size()});
}

DrawnCasters find(const CasterMesh& mesh) {
    DrawnCasters result;
    if (mesh.empty()) return result;
    const glm::vec3* positions = positionsOf(mesh);
    const std::vector<PlaceKeys> keys(positions, positions + mesh.vertices->size());
    std::vector<glm::vec3> places; // of the open ones
    for (const Share& share : sharesOf(mesh)) {
        if (share.begin == share.end) continue;
        const bool closed = isClosed(share, keys);
        (closed ? result.closed : result.open).push_back(drawableOf(share, positions));
        for (const unsigned* corner = share.begin; !closed && corner != share.end; ++corner)
            places.push_back(positions[*corner]);
    }
    result.openEdges = edgesOf(places);
    return result;
}

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
double across(const ScreenRect& rect, const glm::dvec2& pixels) {
    return glm::length((rect.high - rect.low) / 2.0 * pixels);
}

/// From the middle of a box to where its volume ends, as far as that is in sight, pixels.
double lengthOf(const VolumeHull& hull, const ScreenRect& seen, const glm::dvec2& pixels) {
    const glm::dvec4 from = hull[0] + hull[7], to = hull[8] + hull[15];
    const double most = across(seen, pixels);
    if (!(from.w > 0.0 && to.w > 0.0)) return most;
    const glm::dvec2 way = (glm::dvec2(to) / to.w - glm::dvec2(from) / from.w) / 2.0;
    return std::min(most, glm::length(way * pixels));
}

/// What is to be drawn of one view.
class Forecaster {
public:
    Forecaster(const ViewFrame& view, const SceneFrame& scene, const glm::dvec4& light)
        : _light(light),
          _receivers(receiverBoxOf(view, scene)),
          _planes(endPlanes(_receivers.low, _receivers.high)),
          _clipFromScene(scene.clipFromScene(view)),
          _pixels(view.pixels.x(), view.pixels.y()) {}

    /// One of whose edges nothing is known. @param low,high  bounds, in the scene.
    void add(const glm::dvec3& low, const glm::dvec3& high, double triangles) {
        const glm::dvec3 extent = high - low;
        const VolumeHull hull = volumeHull(low, high, nearestEnd(_planes, low, high, _light), _light, _clipFromScene);
        const double longest = std::max({extent.x, extent.y, extent.z});
        const double flat = longest > 0.0 ? std::min({extent.x, extent.y, extent.z}) / longest : 0.0;
        const glm::dvec3 way = awayFrom(_light, (low + high) / 2.0);
        const double steep = std::abs(way.z) / std::max(std::hypot(way.x, way.y), 1e-9 * glm::length(way));
        const auto seen = screenBounds(hull);
        if (!seen) return;
        const double sides = outlineOf(triangles, flat, steep);
        const auto body = screenBounds(hull.data(), 8);
        const double edge = across(body.value_or(*seen), _pixels) * std::sqrt(3.0 / std::max(triangles, 3.0));
        constexpr double slanted = 0.64; // of a length, seen from any side
        _all.sides += sides;
        _all.pixels += sides * lengthOf(hull, *seen, _pixels) * (slanted * edge + narrowest);
    }

    /// The volumes are found under AutoChooser's lock. Isolated: a thread that waits for others must not take up work that might
    /// ask in turn.
    void count(const VolumeCaster& caster) {
        const osg::ref_ptr<LightVolumes> volumes = new LightVolumes;
        tbb::this_task_arena::isolate([&] { volumes->set(caster, _light, _receivers); });
        constexpr double near = 1.0; // of vertices' steps, for which nobody asks
        const std::shared_ptr<const SeenVolumes> seen = seenVolumes({volumes}, _clipFromScene, near);
        if (!seen) return;
        const glm::dmat4& clipFromMesh = seen->meshes.front().clipFromMesh;
        const std::vector<glm::dvec4> places = placesOf(volumes->volumes(), clipFromMesh);
        for (const SeenPart& each : seen->parts) {
            addSides(volumes->volumes(), each.part, places);
            const unsigned backs = each.showsBack ? each.caps.light.count : 0u;
            const unsigned closing = each.holding ? 0u : each.caps.light.count + each.caps.dark.count;
            const SilhouetteMesh::Part& part = caster.mesh->parts[each.part];
            const auto body = boxCorners(glm::dvec3(part.low), glm::dvec3(part.high), clipFromMesh);
            addCaps({body.begin(), body.end()}, (backs + closing) / 3u);
        }
    }

    /// What was added since the last time.
    VolumeForecast take() { return std::exchange(_all, {}); }

private:
    /// In clip space, of the volumes' vertices.
    static std::vector<glm::dvec4> placesOf(const ShadowVolumes& volumes, const glm::dmat4& clipFromMesh) {
        std::vector<glm::dvec4> places;
        for (const glm::vec4& vertex : volumes.vertices) {
            const glm::dvec3 at(vertex), away = awayFrom(volumes.light, at);
            places.push_back(clipFromMesh *
                             (vertex.w < 0.0f ? glm::dvec4(away, 0.0) : glm::dvec4(at + double(vertex.w) * away, 1.0)));
        }
        return places;
    }

    /// As they lie in memory: a side is two triangles, see findShadowVolumes().
    void addSides(const ShadowVolumes& volumes, unsigned index, const std::vector<glm::dvec4>& places) {
        const ShadowVolumes::Part& part = volumes.parts[index];
        for (unsigned i = part.first; i < part.first + part.count; i += 6) {
            const unsigned* of = volumes.corners.data() + i;
            const ScreenArea seen = screenArea({places[of[0]], places[of[1]], places[of[2]], places[of[5]]}, _pixels);
            _all.sides += 1.0;
            _all.pixels += seen.area + narrowest * seen.around / 2.0;
        }
    }

    /// They cover no more than the box about the body. @param body  corners of that, in clip space.
    void addCaps(const std::vector<glm::dvec4>& body, double triangles) {
        _all.caps += triangles;
        const auto seen = triangles > 0.0 ? screenBounds(body) : std::nullopt;
        if (!seen) return;
        const glm::dvec2 size = (seen->high - seen->low) / 2.0 * _pixels;
        _all.pixels += size.x * size.y;
    }

    const glm::dvec4 _light; ///< in the scene.
    const ReceiverBox _receivers;
    const std::vector<glm::dvec4> _planes;
    const glm::dmat4 _clipFromScene;
    const glm::dvec2 _pixels;
    VolumeForecast _all;
};

CountedVolumes beside(const VolumeForecast& counted, const VolumeForecast& estimated, double triangles) {
    return {counted.sides / estimated.sides, counted.pixels / std::max(estimated.pixels, 1.0),
            counted.caps / triangles};
}

VolumeForecast corrected(const VolumeForecast& estimated, const CountedVolumes& by, double triangles) {
    return {by.sides * estimated.sides, by.caps * triangles, by.pixels * estimated.pixels};
}

void add(VolumeForecast& all, const VolumeForecast& more) {
    all.sides += more.sides;
    all.caps += more.caps;
    all.pixels += more.pixels;
}

} // namespace

std::size_t DrawnCasters::openTriangles() const {
    std::size_t sum = 0;
    for (const Drawable& each : open) sum += each.triangles;
    return sum;
}

void OpenCasters::startRound() {
    ++_round;
    for (auto entry = _entries.begin(); entry != _entries.end();) {
        const bool isOld = _round - entry->second.used > keptRounds || !entry->second.mesh.valid();
        entry = isOld ? _entries.erase(entry) : std::next(entry);
    }
}

DrawnCasters& OpenCasters::of(const CasterMesh& mesh) {
    Entry& entry = _entries[&mesh];
    if (!entry.mesh.valid()) entry = {&mesh, find(mesh), 0};
    entry.used = _round;
    return entry.drawn;
}

VolumeForecast forecastVolumes(const ViewFrame& view, const CasterLayers& casters, const glm::dvec4& light,
                               OpenCasters& known) {
    const SceneFrame scene(casters.origin);
    Forecaster forecaster(view, scene, light - light.w * glm::dvec4(scene.origin, 0.0));
    std::size_t left = OpenCasters::mostTriangles;
    VolumeForecast all;
    known.startRound();
    for (const PlacedMesh& placed : casters.meshes()) {
        const auto estimated = [&](const std::vector<DrawnCasters::Drawable>& drawables) {
            for (const DrawnCasters::Drawable& each : drawables) {
                const glm::dvec3 low = placed.isBody ? scene.point(placed.bounds._min) : glm::dvec3(each.low);
                const glm::dvec3 high = placed.isBody ? scene.point(placed.bounds._max) : glm::dvec3(each.high);
                forecaster.add(low, high, double(each.triangles));
            }
            return forecaster.take();
        };
        DrawnCasters& drawn = known.of(*placed.mesh);
        add(all, estimated(drawn.closed));
        if (drawn.open.empty()) continue;
        const VolumeForecast open = estimated(drawn.open);
        const std::size_t triangles = drawn.openTriangles();
        if (!drawn.counted && drawn.openEdges && triangles <= left && open.sides > 0.0) {
            left -= triangles;
            forecaster.count({drawn.openEdges, placed.sceneFromMesh});
            drawn.counted = beside(forecaster.take(), open, double(triangles));
            drawn.openEdges.reset();
        }
        add(all, drawn.counted ? corrected(open, *drawn.counted, double(triangles)) : open);
    }
    return all;
}

} // namespace gnomon
