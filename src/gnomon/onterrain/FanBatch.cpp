// SPDX-License-Identifier: MIT
#include <gnomon/onterrain/FanBatch.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace gnomon {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t together = 4; // blocks whose rays stay in the nearest cache

bool isUsable(const glm::dvec4& light) {
    const double size = glm::length(glm::dvec3(light));
    return std::isfinite(size) && light.w >= 0.0 && size + light.w > 0.0;
}

/// Where a point's shadow falls; the ground over it, if it is not above the ground.
std::optional<glm::dvec3> shadowOf(const glm::dvec3& point, const Ground& ground, const glm::dvec4& light) {
    const auto height = ground.height(point.x, point.y);
    if (height && point.z <= *height) return glm::dvec3(point.x, point.y, *height);
    return ground.hit(point, light.w * point - glm::dvec3(light));
}

} // namespace

void FanBatch::begin(const Ground& ground, const glm::dvec4& light, const ShadowKernel& kernel) {
    _entries.clear();
    _kernel = &kernel;
    _ground = &ground;
    _light = light;
    _isLight = isUsable(light);
    _way = -glm::dvec2(light) / light.z;
    _grid = dynamic_cast<const HeightPyramid*>(&ground);
    _origin = _grid ? _grid->field().origin() : glm::dvec2(0.0);
    _scale = _grid ? 1.0 / _grid->field().step() : glm::dvec2(1.0);
    _base = _grid ? _grid->field().base() : 0.0;
    _tangent = light.z / std::hypot(light.x, light.y);
    if (_grid) {
        _steepest = _grid->steepest();
        const HeightField& field = _grid->field();
        _view = {field.heights(), field.cuts(), field.columns(), field.rows(), std::isfinite(_steepest)};
    }
}

glm::dvec3 FanBatch::silhouette(const Entry& entry, std::size_t e) const {
    const KernelEdge& edge = edgeOf(entry, e < fanOf(entry).edges ? e : 0);
    return {edge.x[entry.lane], edge.y[entry.lane], edge.z[entry.lane]};
}

glm::dvec4 FanBatch::edgePlane(const Entry& entry, std::size_t e) const {
    const KernelEdge& edge = edgeOf(entry, e);
    return {edge.planeX[entry.lane], edge.planeY[entry.lane], edge.planeZ[entry.lane], edge.planeW[entry.lane]};
}

glm::dvec4 FanBatch::facePlane(const Entry& entry, std::size_t f) const {
    const KernelFace& face = _faces[fanOf(entry).face + f];
    return {face.x[entry.lane], face.y[entry.lane], face.z[entry.lane], face.w[entry.lane]};
}

void FanBatch::setEnd(const Entry& entry, std::size_t e, const glm::dvec3& end) {
    KernelEdge& edge = edgeOf(entry, e);
    edge.endX[entry.lane] = end.x;
    edge.endY[entry.lane] = end.y;
    edge.endZ[entry.lane] = end.z;
}

/// Tangent of the light's least elevation as seen from where the shadow falls.
///
/// It is the same all along a ray, and all points from which it is at least so much are convex: so it is least at a
/// corner of the silhouette.
double FanBatch::leastTangent(const Entry& entry) const {
    double least = infinite;
    for (std::size_t e = 0; e < fanOf(entry).edges; ++e) {
        const glm::dvec3 towards = glm::dvec3(entry.light) - entry.light.w * silhouette(entry, e);
        least = std::min(least, towards.z / std::hypot(towards.x, towards.y));
    }
    return least;
}

glm::dvec3 FanBatch::top(std::size_t i) const {
    const Entry& entry = _entries[i];
    glm::dvec3 highest = silhouette(entry, 0);
    for (std::size_t e = 1; e < fanOf(entry).edges; ++e) {
        const glm::dvec3 corner = silhouette(entry, e);
        if (corner.z > highest.z) highest = corner;
    }
    return highest;
}

KernelFans FanBatch::kernelFans(std::size_t first, std::size_t end) {
    return {end - first,
            _fans.data() + first,
            _parts.data() + first,
            _edges.data(),
            _faces.data(),
            _rays.data(),
            _rayCount,
            _order.data(),
            _inside.data(),
            _light.x,
            _light.y,
            _light.z,
            _light.w,
            _scale.x,
            _scale.y,
            _way.x,
            _way.y};
}

Drape FanBatch::triangles(std::size_t i) const {
    Drape result;
    const auto at = [&](std::size_t k) { return _entries[i].anchor + corner(i, k); };
    for (std::size_t k = 2; k < cornerCount(i); ++k) result.insert(result.end(), {at(0), at(k - 1), at(k)});
    return result;
}

ConvexShadow FanBatch::shadow(std::size_t i) const {
    const Entry& entry = _entries[i];
    const KernelFan& fan = fanOf(entry);
    ConvexShadow shadow;
    const auto add = [&](const glm::dvec4& plane) {
        const glm::dvec3 normal(plane);
        const double size = glm::length(normal);
        if (size > 0.0) shadow.planes.emplace_back(normal / size, (plane.w - glm::dot(normal, entry.anchor)) / size);
    };
    for (std::size_t f = 0; f < fan.faces; ++f) add(facePlane(entry, f));
    for (std::size_t e = 0; e < fan.edges; ++e) {
        add(edgePlane(entry, e));
        shadow.silhouette.push_back(entry.anchor + silhouette(entry, e));
    }
    return shadow;
}

glm::dvec2 FanBatch::wayOf(const Entry& entry, const glm::dvec3& point) const {
    if (entry.light.w == 0.0) return _way;
    const glm::dvec3 towards = glm::dvec3(entry.light) - entry.light.w * point;
    return towards.z > 0.0 ? -glm::dvec2(towards) / towards.z : glm::dvec2(nan);
}

/// Room for the rays of some fans, and for places in their triangles.
void FanBatch::beginRays(std::size_t first, std::size_t end) {
    std::size_t edges = 0;
    for (std::size_t i = first; i < end; ++i) {
        _fans[i].ray = 2 * edges;
        _fans[i].place = edges;
        edges += _fans[i].edges;
    }
    _rayCount = 2 * edges;
    if (_rays.size() >= _rayCount) return;
    _rays.resize(2 * _rayCount);
    _inside.resize(_rayCount);
    _order.resize(_rays.size() * kernelLanes + kernelPad);
}

void FanBatch::cast(std::size_t first, std::size_t end) {
    const KernelFans fans = kernelFans(first, end);
    _kernel->rays(fans);
    if (_grid) {
        _kernel->cast(_view, fans);
        return;
    }
    for (std::size_t i = 0; i < _rayCount; ++i)
        for (std::size_t lane = 0; lane < kernelLanes; ++lane) {
            KernelRay& ray = _rays[i];
            if (!(ray.z[lane] > -infinite)) continue;
            ray.height[lane] = _ground->height(ray.u[lane], ray.v[lane]).value_or(nan);
            ray.descent[lane] = ray.z[lane] <= ray.height[lane] ? 0.0 : nan;
        }
}

/// Whether the ground is less steep than the light wherever rays pass: then they meet it once.
bool FanBatch::isGentle(const Entry& entry) const {
    if (!_grid) return false;
    if (_steepest < entry.tangent) return true;
    glm::dvec2 low(infinite), high(-infinite);
    for (std::size_t r = 0; r < 2 * fanOf(entry).edges; ++r) {
        const KernelRay& ray = rayOf(entry, r);
        const std::size_t i = entry.lane;
        const glm::dvec2 start(ray.u[i], ray.v[i]),
            way = _light.w == 0.0 ? _way * _scale : glm::dvec2(ray.du[i], ray.dv[i]);
        const glm::dvec2 end = ray.descent[i] > 0.0 ? start + ray.descent[i] * way : start;
        low = glm::min(low, glm::min(start, end));
        high = glm::max(high, glm::max(start, end));
    }
    return _grid->isGentle(low, high, entry.tangent);
}

/// Where a ray ends of which the kernel does not know, or not for sure; about the anchor.
std::optional<glm::dvec3> FanBatch::exactEnd(const Entry& entry, const glm::dvec3& point, const KernelRay& ray) const {
    if (ray.descent[entry.lane] == 0.0)
        return glm::dvec3(point.x, point.y, ray.height[entry.lane] - partOf(entry).z[entry.lane]);
    const auto end = shadowOf(entry.anchor + point, *_ground, _light);
    if (!end) return std::nullopt;
    return *end - entry.anchor;
}

/// @return false if a corner's ray meets no ground; an edge's is then not a number.
bool FanBatch::landExactly(const Entry& entry) {
    const std::size_t edges = fanOf(entry).edges;
    for (std::size_t e = 0; e < edges; ++e) {
        KernelEdge& edge = edgeOf(entry, e);
        const glm::dvec3 corner = silhouette(entry, e), middle = 0.5 * (corner + silhouette(entry, e + 1));
        const auto end = exactEnd(entry, corner, rayOf(entry, e));
        if (!end) return false;
        setEnd(entry, e, *end);
        if (edge.along[entry.lane] > 0.0) continue;
        const glm::dvec3 fallen = exactEnd(entry, middle, rayOf(entry, edges + e)).value_or(glm::dvec3(nan));
        edge.middleX[entry.lane] = fallen.x;
        edge.middleY[entry.lane] = fallen.y;
    }
    return true;
}

void FanBatch::findFans() {
    for (std::size_t first = 0; first < _fans.size(); first += together)
        findFans(first, std::min(first + together, _fans.size()));
}

template <class Do>
void FanBatch::eachEntry(std::size_t first, std::size_t end, const Do& what) {
    for (std::size_t i = first; i < end; ++i)
        for (std::size_t lane = 0; lane < _fans[i].parts; ++lane) what(_entries[_members[i * kernelLanes + lane]]);
}

void FanBatch::findFans(std::size_t first, std::size_t end) {
    beginRays(first, end);
    cast(first, end);
    const KernelFans fans = kernelFans(first, end);
    _kernel->land(fans);
    eachEntry(first, end, [&](Entry& entry) {
        if (entry.outcome != TerrainOutcome::fan) return;
        if (partOf(entry).isUnknown[entry.lane] == 0.0 && isGentle(entry)) return;
        if (!landExactly(entry)) entry.outcome = TerrainOutcome::noFan;
    });
    _kernel->measure(fans);
    eachEntry(first, end, [&](Entry& entry) {
        if (entry.outcome == TerrainOutcome::fan) finish(entry);
        _parts[entry.fan].corners[entry.lane] = double(entry.corners);
    });
    _kernel->places(fans);
    addHeights(first, end);
    _kernel->judge(fans);
    eachEntry(first, end, [&](Entry& entry) {
        if (entry.outcome == TerrainOutcome::fan) entry.wrong += partOf(entry).lit[entry.lane];
    });
}

/// Of the ground at the places in triangles.
void FanBatch::addHeights(std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
        const KernelFan& fan = _fans[i];
        KernelPlace* places = _inside.data() + fan.place;
        if (_grid) _kernel->heights(_view, places, fan.edges - 2, fan.parts);
        for (KernelPlace* place = places; place < places + fan.edges - 2 && !_grid; ++place)
            for (std::size_t lane = 0; lane < fan.parts; ++lane)
                place->z[lane] = _ground->height(place->u[lane], place->v[lane]).value_or(nan);
    }
}

} // namespace gnomon
