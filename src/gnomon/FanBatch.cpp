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
constexpr double inGround = 1e-6; // of a part's size: what single precision leaves of a height, and some more

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
    clear();
    _ground = &ground;
    _light = light;
    _isLight = isUsable(light);
    _way = -glm::dvec2(light) / light.z;
    _grid = dynamic_cast<const HeightPyramid*>(&ground);
    _origin = _grid ? _grid->field().origin() : glm::dvec2(0.0);
    _scale = _grid ? 1.0 / _grid->field().step() : glm::dvec2(1.0);
    _base = _grid ? _grid->field().base() : 0.0;
    if (_grid) {
        const HeightField& field = _grid->field();
        _view = {field.heights(), field.cuts(), field.columns(), field.rows()};
    }
}

void FanBatch::clear() {
    _entries.clear();
    _fans.clear();
    _asked.clear();
    _edges = _faces = _outlined = 0;
    _upper.count = _lower.count = 0;
}

bool FanBatch::add(const PackedParts& parts, std::size_t part) {
    Entry& entry = _entries.emplace_back();
    decode(parts, part, entry);
    const HullTopology& topology = parts.topology(part);
    const std::size_t face = _faces;
    const bool isThere = _isLight && addFaces(topology, entry) && addSilhouette(topology);
    const bool isInside = entry.light.w > 0.0 && !topology.isPlate();
    entry.outcome = isThere ? TerrainOutcome::fan : isInside ? TerrainOutcome::lightInside : TerrainOutcome::edgeOn;
    if (topology.front >= 0 && !(_isLight && _lit[std::size_t(topology.front)]))
        entry.outcome = TerrainOutcome::turnedAway;
    if (isThere) {
        entry.fan = _fans.size();
        entry.tangent = leastTangent(entry);
        const glm::dvec4& l = entry.light;
        const glm::dvec2 at = (glm::dvec2(entry.anchor) - _origin) * _scale;
        _fans.push_back({_edges,
                         _loop.size(),
                         face,
                         _faces - face,
                         0,
                         2,
                         0,
                         {l.x, l.y, l.z, l.w},
                         at.x,
                         at.y,
                         entry.anchor.z - _base});
        _edges += _loop.size() + 1;
    }
    return isThere;
}

void FanBatch::decode(const PackedParts& parts, std::size_t part, Entry& entry) {
    entry.anchor = parts.anchor(part);
    entry.light = glm::dvec4(glm::dvec3(_light) - _light.w * entry.anchor, _light.w);
    _corners.assign(1, glm::dvec3(0.0));
    const unsigned count = parts.topology(part).corners;
    const glm::vec3* others = parts.others(part);
    double square = 0.0;
    for (unsigned i = 0; i + 1 < count; ++i) {
        const glm::dvec3 corner(others[i]);
        _corners.push_back(corner);
        square = std::max(square, glm::dot(corner, corner));
        entry.low = std::min(entry.low, corner.z);
        if (corner.z > entry.top.z) entry.top = corner;
    }
    entry.size = std::sqrt(square);
}

/// @return whether the light meets any.
bool FanBatch::addFaces(const HullTopology& topology, const Entry& entry) {
    const std::size_t first = _faces;
    grow({&_fx, &_fy, &_fz, &_fw}, _faces + topology.faces.size());
    _lit.assign(topology.faces.size() + 1, 0);
    for (std::size_t f = 0; f < topology.faces.size(); ++f) {
        const auto& [i, j, k] = topology.faces[f];
        const glm::dvec3& a = _corners[i];
        const glm::dvec3 normal = glm::cross(_corners[j] - a, _corners[k] - a);
        if (!(glm::dot(normal, glm::dvec3(entry.light) - entry.light.w * a) > 0.0)) continue;
        _lit[f] = 1;
        _fx[_faces] = -normal.x;
        _fy[_faces] = -normal.y;
        _fz[_faces] = -normal.z;
        _fw[_faces++] = glm::dot(normal, a);
    }
    return _faces > first;
}

bool FanBatch::addSilhouette(const HullTopology& topology) {
    if (topology.isTabled()) {
        unsigned bits = 0;
        for (std::size_t f = 0; f < topology.faces.size(); ++f) bits |= unsigned(_lit[f]) << f;
        const HullTopology::Loop loop = topology.silhouette(bits);
        _loop.assign(loop.begin, loop.end);
    } else {
        topology.silhouette(_lit.data(), _loop);
    }
    if (_loop.empty()) return false;
    grow({&_sx, &_sy, &_sz, &_ex, &_ey, &_ez, &_ew, &_along}, _edges + _loop.size() + 1);
    for (std::size_t i = 0; i <= _loop.size(); ++i) {
        const glm::dvec3& corner = _corners[_loop[i < _loop.size() ? i : 0]];
        _sx[_edges + i] = corner.x;
        _sy[_edges + i] = corner.y;
        _sz[_edges + i] = corner.z;
    }
    return true;
}

/// Tangent of the light's least elevation as seen from where the shadow falls.
///
/// It is the same all along a ray, and all points from which it is at least so much are convex: so it is least at a
/// corner of the hull.
double FanBatch::leastTangent(const Entry& entry) const {
    double least = infinite;
    for (const glm::dvec3& corner : _corners) {
        const glm::dvec3 towards = glm::dvec3(entry.light) - entry.light.w * corner;
        least = std::min(least, towards.z / std::hypot(towards.x, towards.y));
        if (entry.light.w == 0.0) break;
    }
    return least;
}

KernelFans FanBatch::kernelFans() {
    return {_fans.size(), _fans.data(),  _sx.data(), _sy.data(), _sz.data(), _ex.data(), _ey.data(), _ez.data(),
            _ew.data(),   _along.data(), _fx.data(), _fy.data(), _fz.data(), _fw.data(), _cx.data(), _cy.data(),
            _scale.x,     _scale.y,      _px.data(), _py.data(), _pu.data(), _pv.data(), _pz.data(), _lightened.data()};
}

void FanBatch::findEdges() { shadowKernel().edges(kernelFans()); }

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

unsigned FanBatch::ask(const Entry& entry, const glm::dvec3& point) {
    const bool isLow = point.z <= 0.5 * (entry.low + entry.top.z);
    Queries& to = isLow ? _lower : _upper;
    const KernelFan& fan = _fans[entry.fan];
    const glm::dvec2 way = wayOf(entry, point);
    const std::size_t at = to.count++;
    to.u[at] = fan.u + point.x * _scale.x;
    to.v[at] = fan.v + point.y * _scale.y;
    to.z[at] = fan.z + point.z;
    to.du[at] = way.x * _scale.x;
    to.dv[at] = way.y * _scale.y;
    return unsigned(2 * at + isLow);
}

/// Where do the corners and the middles of the edges fall?
void FanBatch::ask(Entry& entry) {
    const KernelFan& fan = _fans[entry.fan];
    for (Queries* to : {&_upper, &_lower})
        grow({&to->u, &to->v, &to->z, &to->du, &to->dv, &to->descent, &to->height}, to->count + 2 * fan.edges);
    entry.query = _asked.size();
    for (std::size_t e = fan.edge; e < fan.edge + fan.edges; ++e) _asked.push_back(ask(entry, silhouette(e)));
    for (std::size_t e = fan.edge; e < fan.edge + fan.edges; ++e)
        _asked.push_back(_along[e] > 0.0 ? none : ask(entry, middle(e)));
}

void FanBatch::cast(Queries& queries) const {
    if (_grid) {
        shadowKernel().cast(_view,
                            {queries.count, queries.u.data(), queries.v.data(), queries.z.data(), queries.du.data(),
                             queries.dv.data(), queries.descent.data(), queries.height.data()});
        return;
    }
    for (std::size_t i = 0; i < queries.count; ++i) {
        queries.height[i] = _ground->height(queries.u[i], queries.v[i]).value_or(nan);
        queries.descent[i] = queries.z[i] <= queries.height[i] ? 0.0 : nan;
    }
}

/// Of a place of a part that has been asked for; about the anchor.
std::optional<glm::dvec3> FanBatch::placeOf(const Entry& entry, const glm::dvec3& point, unsigned query,
                                            bool exactly) const {
    const double down = descent(query);
    if (down == 0.0) return glm::dvec3(point.x, point.y, height(query) - _fans[entry.fan].z);
    if (down > 0.0 && !exactly) return point + down * glm::dvec3(wayOf(entry, point), -1.0);
    const auto place = shadowOf(entry.anchor + point, *_ground, _light);
    if (!place) return std::nullopt;
    return *place - entry.anchor;
}

bool FanBatch::isOut(const Entry& entry) const {
    const KernelFan& fan = _fans[entry.fan];
    for (std::size_t i = 0; i < fan.edges; ++i)
        if (!(fan.z + _sz[fan.edge + i] <= height(_asked[entry.query + i]) + inGround * entry.size)) return true;
    return false;
}

/// Whether the ground is less steep than the light wherever rays pass: then they meet it once.
bool FanBatch::isGentle(const Entry& entry) const {
    if (!_grid) return false;
    if (_grid->steepest() < entry.tangent) return true;
    glm::dvec2 low(infinite), high(-infinite);
    for (std::size_t i = entry.query; i < entry.query + 2 * _fans[entry.fan].edges; ++i) {
        if (_asked[i] == none) continue;
        const Queries& from = _asked[i] % 2 ? _lower : _upper;
        const std::size_t at = _asked[i] / 2;
        const glm::dvec2 start(from.u[at], from.v[at]);
        const glm::dvec2 end =
            from.descent[at] > 0.0 ? start + from.descent[at] * glm::dvec2(from.du[at], from.dv[at]) : start;
        low = glm::min(low, glm::min(start, end));
        high = glm::max(high, glm::max(start, end));
    }
    return _grid->isGentle(low, high, entry.tangent);
}

void FanBatch::findFans() {
    for (Entry& entry : _entries)
        if (entry.outcome == TerrainOutcome::fan) ask(entry);
    cast(_upper);
    cast(_lower);
    std::size_t places = 0;
    for (Entry& entry : _entries) {
        if (entry.outcome != TerrainOutcome::fan) continue;
        entry.isOut = isOut(entry);
        if (!outline(entry)) entry.outcome = TerrainOutcome::noFan;
        KernelFan& fan = _fans[entry.fan];
        if (entry.outcome != TerrainOutcome::fan) fan.corners = 2;
        fan.place = places;
        places += fan.corners - 2;
    }
    grow({&_px, &_py, &_pu, &_pv, &_pz}, places);
    grow({&_lightened}, _fans.size());
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
        if (entry.outcome == TerrainOutcome::fan) entry.wrong += _lightened[entry.fan];
}

} // namespace gnomon
