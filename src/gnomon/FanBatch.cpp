// SPDX-License-Identifier: MIT
#include <gnomon/FanBatch.h>

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

/// Room for `count` and what vectors take beyond.
void grow(std::initializer_list<std::vector<double>*> lanes, std::size_t count) {
    for (std::vector<double>* lane : lanes)
        if (lane->size() < count + kernelPad) lane->resize(2 * count + kernelPad);
}

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

void FanBatch::begin(const Ground& ground, const glm::dvec4& light) {
    _entries.clear();
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
        _view = {field.heights(), field.cuts(), field.columns(), field.rows()};
    }
}

void FanBatch::take(const PackedParts& parts, std::size_t first, std::size_t end) {
    _entries.assign(end - first, {});
    _fans.clear();
    _edges = _faces = _queries = 0;
    _taken.assign(end - first, false);
    for (std::size_t i = 0; i < size(); ++i) {
        if (_taken[i]) continue;
        _same.clear();
        for (std::size_t k = i; k < size(); ++k) {
            if (&parts.topology(first + k) != &parts.topology(first + i)) continue;
            _same.push_back(k);
            _taken[k] = true;
        }
        takeKind(parts, first, _same);
    }
    makeRoom();
    shadowKernel().edges(kernelFans());
}

/// Parts of one topology, side by side.
void FanBatch::takeKind(const PackedParts& parts, std::size_t first, const std::vector<std::size_t>& same) {
    const HullTopology& topology = parts.topology(first + same.front());
    askFaces(parts, first, same);
    grow({&_fx, &_fy, &_fz, &_fw}, _faces + same.size() * topology.faces.size());
    grow({&_sx, &_sy, &_sz}, _edges + same.size() * (topology.corners + 1));
    for (std::size_t lane = 0; lane < same.size(); ++lane) {
        Entry& entry = _entries[same[lane]];
        entry.size = std::sqrt(_sizes[lane]);
        entry.low = _lows[lane];
        entry.high = _highs[lane];
        const std::size_t face = _faces;
        const bool isThere = _isLight && addFaces(topology, lane) && addSilhouette(topology, lane);
        const bool isInside = entry.light.w > 0.0 && !topology.isPlate();
        entry.outcome = isThere ? TerrainOutcome::fan : isInside ? TerrainOutcome::lightInside : TerrainOutcome::edgeOn;
        if (topology.front >= 0 && !(_isLight && _lit[std::size_t(topology.front)]))
            entry.outcome = TerrainOutcome::turnedAway;
        entry.fan = none;
        if (isThere) addFan(entry, face);
    }
}

void FanBatch::askFaces(const PackedParts& parts, std::size_t first, const std::vector<std::size_t>& same) {
    const HullTopology& topology = parts.topology(first + same.front());
    const std::size_t faces = topology.faces.size(), numbers = 3 * std::size_t(topology.corners);
    _stride = same.size() + kernelPad;
    _places.resize(numbers * _stride + kernelPad);
    grow({&_lightX, &_lightY, &_lightZ, &_sizes, &_lows, &_highs}, _stride);
    grow({&_facePlanes}, 4 * faces * _stride);
    grow({&_facing}, faces * _stride);
    for (std::size_t lane = 0; lane < same.size(); ++lane) {
        Entry& entry = _entries[same[lane]];
        entry.anchor = parts.anchor(first + same[lane]);
        entry.light = glm::dvec4(glm::dvec3(_light) - _light.w * entry.anchor, _light.w);
        _lightX[lane] = entry.light.x;
        _lightY[lane] = entry.light.y;
        _lightZ[lane] = entry.light.z;
        const float* others = &parts.others(first + same[lane])->x;
        float* to = _places.data() + lane;
        for (std::size_t k = 0; k < 3; ++k) to[k * _stride] = 0.0f;
        for (std::size_t k = 3; k < numbers; ++k) to[k * _stride] = others[k - 3];
    }
    shadowKernel().face({same.size(), _stride, topology.corners, faces, _places.data(), topology.faces.data(),
                         _lightX.data(), _lightY.data(), _lightZ.data(), _light.w, _facePlanes.data(), _facing.data(),
                         _sizes.data(), _lows.data(), _highs.data()});
}

/// @return whether the light meets any.
bool FanBatch::addFaces(const HullTopology& topology, std::size_t lane) {
    const std::size_t first = _faces;
    _lit.assign(topology.faces.size() + 1, 0);
    for (std::size_t f = 0; f < topology.faces.size(); ++f) {
        if (!(_facing[f * _stride + lane] > 0.0)) continue;
        const double* plane = _facePlanes.data() + 4 * f * _stride + lane;
        _lit[f] = 1;
        _fx[_faces] = plane[0];
        _fy[_faces] = plane[_stride];
        _fz[_faces] = plane[2 * _stride];
        _fw[_faces++] = plane[3 * _stride];
    }
    return _faces > first;
}

/// With its first corner once more at the end.
bool FanBatch::addSilhouette(const HullTopology& topology, std::size_t lane) {
    if (topology.isTabled()) {
        unsigned bits = 0;
        for (std::size_t f = 0; f < topology.faces.size(); ++f) bits |= unsigned(_lit[f]) << f;
        const HullTopology::Loop loop = topology.silhouette(bits);
        _loop.assign(loop.begin, loop.end);
    } else {
        topology.silhouette(_lit.data(), _loop);
    }
    if (_loop.empty()) return false;
    _loop.push_back(_loop.front());
    for (std::size_t i = 0; i < _loop.size(); ++i) {
        const float* corner = _places.data() + 3 * _loop[i] * _stride + lane;
        _sx[_edges + i] = double(corner[0]);
        _sy[_edges + i] = double(corner[_stride]);
        _sz[_edges + i] = double(corner[2 * _stride]);
    }
    return true;
}

void FanBatch::addFan(Entry& entry, std::size_t face) {
    const std::size_t edges = _loop.size() - 1;
    KernelFan fan{};
    fan.edge = _edges;
    fan.edges = fan.corners = edges;
    fan.face = face;
    fan.faces = _faces - face;
    fan.query = _queries;
    for (int k = 0; k < 4; ++k) fan.light[k] = entry.light[k];
    fan.u = (entry.anchor.x - _origin.x) * _scale.x;
    fan.v = (entry.anchor.y - _origin.y) * _scale.y;
    fan.z = entry.anchor.z - _base;
    fan.margin = inGround * entry.size;
    entry.fan = _fans.size();
    entry.tangent = _light.w == 0.0 ? _tangent : leastTangent(entry, _edges, edges);
    _fans.push_back(fan);
    _edges += edges + 1;
    _queries += 2 * edges;
}

/// Tangent of the light's least elevation as seen from where the shadow falls.
///
/// It is the same all along a ray, and all points from which it is at least so much are convex: so it is least at a
/// corner of the silhouette.
double FanBatch::leastTangent(const Entry& entry, std::size_t edge, std::size_t edges) const {
    double least = infinite;
    for (std::size_t e = edge; e < edge + edges; ++e) {
        const glm::dvec3 towards = glm::dvec3(entry.light) - entry.light.w * silhouette(e);
        least = std::min(least, towards.z / std::hypot(towards.x, towards.y));
    }
    return least;
}

glm::dvec3 FanBatch::top(std::size_t i) const {
    const KernelFan& fan = _fans[_entries[i].fan];
    glm::dvec3 highest = silhouette(fan.edge);
    for (std::size_t e = fan.edge + 1; e < fan.edge + fan.edges; ++e)
        if (_sz[e] > highest.z) highest = silhouette(e);
    return highest;
}

void FanBatch::makeRoom() {
    grow({&_sx, &_sy, &_sz, &_ex, &_ey, &_ez, &_ew, &_along, &_cx, &_cy, &_cz, &_mx, &_my}, _edges + 1);
    grow({&_u, &_v, &_z, &_du, &_dv, &_descent, &_height}, _queries);
    grow({&_px, &_py, &_pu, &_pv, &_pz}, _edges);
    grow({&_work}, 6 * (_queries + kernelPad));
    if (_order.size() < _queries + kernelPad) _order.resize(2 * _queries + kernelPad);
}

KernelFans FanBatch::kernelFans() {
    const KernelRays rays{_queries,   _u.data(),       _v.data(),      _z.data(),    _du.data(),
                          _dv.data(), _descent.data(), _height.data(), _work.data(), _order.data()};
    return {_fans.size(), _fans.data(), _sx.data(),    _sy.data(), _sz.data(), _ex.data(), _ey.data(),
            _ez.data(),   _ew.data(),   _along.data(), _fx.data(), _fy.data(), _fz.data(), _fw.data(),
            _scale.x,     _scale.y,     _way.x,        _way.y,     rays,       _u.data(),  _v.data(),
            _z.data(),    _du.data(),   _dv.data(),    _cx.data(), _cy.data(), _cz.data(), _mx.data(),
            _my.data(),   _px.data(),   _py.data(),    _pu.data(), _pv.data(), _pz.data()};
}

Drape FanBatch::triangles(std::size_t i) const {
    Drape result;
    const auto at = [&](std::size_t k) { return _entries[i].anchor + corner(i, k); };
    for (std::size_t k = 2; k < cornerCount(i); ++k) result.insert(result.end(), {at(0), at(k - 1), at(k)});
    return result;
}

ConvexShadow FanBatch::shadow(std::size_t i) const {
    const Entry& entry = _entries[i];
    const KernelFan& fan = _fans[entry.fan];
    ConvexShadow shadow;
    const auto add = [&](const glm::dvec3& normal, double w) {
        const double size = glm::length(normal);
        if (size > 0.0) shadow.planes.emplace_back(normal / size, (w - glm::dot(normal, entry.anchor)) / size);
    };
    for (std::size_t f = fan.face; f < fan.face + fan.faces; ++f) add({_fx[f], _fy[f], _fz[f]}, _fw[f]);
    for (std::size_t e = fan.edge; e < fan.edge + fan.edges; ++e) {
        add({_ex[e], _ey[e], _ez[e]}, _ew[e]);
        shadow.silhouette.push_back(entry.anchor + silhouette(e));
    }
    return shadow;
}

glm::dvec2 FanBatch::wayOf(const Entry& entry, const glm::dvec3& point) const {
    if (entry.light.w == 0.0) return _way;
    const glm::dvec3 towards = glm::dvec3(entry.light) - entry.light.w * point;
    return towards.z > 0.0 ? -glm::dvec2(towards) / towards.z : glm::dvec2(nan);
}

void FanBatch::cast() {
    if (_grid) {
        shadowKernel().cast(_view, kernelFans().rays);
        return;
    }
    for (std::size_t i = 0; i < _queries; ++i) {
        _height[i] = _ground->height(_u[i], _v[i]).value_or(nan);
        _descent[i] = _z[i] <= _height[i] ? 0.0 : nan;
    }
}

/// Whether the ground is less steep than the light wherever rays pass: then they meet it once.
bool FanBatch::isGentle(const Entry& entry) const {
    if (!_grid) return false;
    if (_steepest < entry.tangent) return true;
    const KernelFan& fan = _fans[entry.fan];
    glm::dvec2 low(infinite), high(-infinite);
    for (std::size_t i = fan.query; i < fan.query + 2 * fan.edges; ++i) {
        const glm::dvec2 start(_u[i], _v[i]), way(_du[i], _dv[i]);
        const glm::dvec2 end = _descent[i] > 0.0 ? start + _descent[i] * way : start;
        low = glm::min(low, glm::min(start, end));
        high = glm::max(high, glm::max(start, end));
    }
    return _grid->isGentle(low, high, entry.tangent);
}

/// Where a ray ends of which the kernel does not know, or not for sure; about the anchor.
std::optional<glm::dvec3> FanBatch::exactEnd(const Entry& entry, const glm::dvec3& point, std::size_t query) const {
    if (_descent[query] == 0.0) return glm::dvec3(point.x, point.y, _height[query] - _fans[entry.fan].z);
    const auto end = shadowOf(entry.anchor + point, *_ground, _light);
    if (!end) return std::nullopt;
    return *end - entry.anchor;
}

/// @return false if a corner's ray meets no ground; an edge's is then not a number.
bool FanBatch::landExactly(const Entry& entry) {
    const KernelFan& fan = _fans[entry.fan];
    for (std::size_t i = 0; i < fan.edges; ++i) {
        const std::size_t e = fan.edge + i;
        const auto end = exactEnd(entry, silhouette(e), fan.query + i);
        if (!end) return false;
        _cx[e] = end->x;
        _cy[e] = end->y;
        _cz[e] = end->z;
        if (_along[e] > 0.0) continue;
        const glm::dvec3 middle = exactEnd(entry, this->middle(e), fan.query + fan.edges + i).value_or(glm::dvec3(nan));
        _mx[e] = middle.x;
        _my[e] = middle.y;
    }
    return true;
}

void FanBatch::findFans() {
    cast();
    shadowKernel().land(kernelFans());
    for (Entry& entry : _entries) {
        if (entry.outcome != TerrainOutcome::fan || (_fans[entry.fan].isKnown && isGentle(entry))) continue;
        if (!landExactly(entry)) entry.outcome = TerrainOutcome::noFan;
    }
    shadowKernel().measure(kernelFans());
    for (Entry& entry : _entries) {
        if (entry.outcome == TerrainOutcome::fan) finish(entry);
        if (entry.fan != none && entry.outcome != TerrainOutcome::fan) _fans[entry.fan].corners = 2;
    }
    std::size_t places = 0;
    for (KernelFan& fan : _fans) { // in their order: vectors end in the next one's
        fan.place = places;
        places += fan.corners - 2;
    }
    judge(places);
}

void FanBatch::judge(std::size_t places) {
    const KernelFans fans = kernelFans();
    shadowKernel().places(fans);
    if (_grid)
        shadowKernel().heights(_view, fans.pu, fans.pv, fans.pz, places);
    else
        for (std::size_t i = 0; i < places; ++i) _pz[i] = _ground->height(_pu[i], _pv[i]).value_or(nan);
    shadowKernel().judge(fans);
    for (Entry& entry : _entries)
        if (entry.outcome == TerrainOutcome::fan) entry.wrong += _fans[entry.fan].lit;
}

} // namespace gnomon
