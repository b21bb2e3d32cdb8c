// SPDX-License-Identifier: MIT
#include <gnomon/ground/BoxMethod.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gnomon {
namespace {

constexpr double twoPi = 6.283185307179586;
constexpr double mostOff = 1e-3; // of the box's size: half a pixel where the caster is 500 pixels large

using Points = std::array<glm::dvec3, 12>;

constexpr std::size_t triangles[12][3] = {{0, 5, 9},   {5, 10, 9}, {10, 4, 9}, {8, 4, 10}, {5, 1, 10}, {10, 1, 11},
                                          {11, 8, 10}, {11, 3, 8}, {1, 6, 11}, {6, 2, 11}, {2, 7, 11}, {7, 3, 11}};

/// Corners of the box where the pentagon's first, third and fifth point stand, by quadrant: 1 takes the greater
/// coordinate. The second and fourth stand over the first and fifth.
struct Corners {
    glm::bvec2 first, middle, last;
};

Corners cornersOf(int quadrant) {
    switch (quadrant) {
    case 1:
        return {{true, true}, {false, true}, {false, false}};
    case 2:
        return {{false, true}, {false, false}, {true, false}};
    case 3:
        return {{false, false}, {true, false}, {true, true}};
    default:
        return {{true, false}, {true, true}, {false, true}};
    }
}

double mostOffOf(const BoxCaster& caster) { return mostOff * glm::length(caster.high - caster.low); }

/// The way across a side to the inner side, of length 1, if vertices are counter-clockwise; nullopt if it has no length.
std::optional<glm::dvec2> inwardsOf(const BoxCaster& caster, std::size_t side) {
    const glm::dvec2 way = caster.vertices[(side + 1) % 4] - caster.vertices[side];
    const double length = glm::length(way);
    if (!(length > mostOffOf(caster))) return std::nullopt;
    return glm::dvec2(-way.y, way.x) / length;
}

bool isWall(const BoxCaster& caster, std::size_t side, const std::vector<glm::dvec3>& points) {
    const auto inwards = inwardsOf(caster, side);
    const auto isInside = [&](const glm::dvec3& point) {
        return glm::dot(*inwards, glm::dvec2(point) - caster.vertices[side]) >= -mostOffOf(caster);
    };
    return inwards && std::all_of(points.begin(), points.end(), isInside);
}

/// Lowest and highest of what is over a vertex.
std::pair<double, double> reachAt(const BoxCaster& caster, std::size_t vertex, const std::vector<glm::dvec3>& points) {
    std::pair<double, double> reach{caster.high.z, caster.low.z};
    for (const glm::dvec3& point : points) {
        if (glm::length(glm::dvec2(point) - caster.vertices[vertex]) > mostOffOf(caster)) continue;
        reach = {std::min(reach.first, point.z), std::max(reach.second, point.z)};
    }
    return reach;
}

glm::dvec2 nearestInPlan(const std::vector<glm::dvec3>& points, const glm::dvec2& to) {
    const auto distance = [&](const glm::dvec3& p) {
        const glm::dvec2 way = glm::dvec2(p) - to;
        return glm::dot(way, way);
    };
    return glm::dvec2(*std::min_element(points.begin(), points.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
        return distance(a) < distance(b);
    }));
}

class Method {
public:
    Method(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light, const BoxLifts& lifts)
        : _ground(ground), _caster(caster), _light(light), _lifts(lifts) {}

    bool outline(Points& points) const;
    bool isOutline() const;
    bool between(Points& points) const;

private:
    Corners corners() const {
        const glm::dvec2 middle(0.5 * (_caster.low + _caster.high));
        return cornersOf(boxQuadrant(middle * _light.w - glm::dvec2(_light)));
    }
    static std::size_t indexOf(const glm::bvec2& corner) {
        return corner.y ? (corner.x ? 2u : 3u) : (corner.x ? 1u : 0u);
    }
    glm::dvec2 vertexAt(const glm::bvec2& corner) const { return _caster.vertices[indexOf(corner)]; }
    bool isSide(std::size_t side, bool isTurnedAway) const;
    bool stand(const glm::dvec2& at, double lift, glm::dvec3& point) const {
        const auto height = _ground.height(at.x, at.y);
        if (height) point = {at.x, at.y, *height + lift};
        return height.has_value();
    }
    bool project(const glm::dvec2& at, glm::dvec3& point) const {
        const glm::dvec3 top(at.x, at.y, _caster.high.z);
        const auto hit = _ground.hit(top, _light.w * top - glm::dvec3(_light));
        if (hit) point = *hit + glm::dvec3(0.0, 0.0, _lifts.projected);
        return hit.has_value();
    }
    bool isStraight(const glm::dvec2& from, const glm::dvec2& to) const;

    const Ground& _ground;
    const BoxCaster& _caster;
    const glm::dvec4 _light;
    const BoxLifts _lifts;
};

/// Points 0 to 4.
bool Method::outline(Points& points) const {
    const Corners at = corners();
    const glm::dvec2 first = vertexAt(at.first), third = vertexAt(at.middle), last = vertexAt(at.last);
    return stand(first, 0.0, points[0]) && project(first, points[1]) && project(third, points[2]) &&
           project(last, points[3]) && stand(last, 0.0, points[4]);
}

/// Points 5 to 9 in the middle of the edges, the last of them between 4 and 0; 10 and 11 inside.
bool Method::between(Points& points) const {
    const auto half = [&](std::size_t a, std::size_t b, std::size_t into) {
        return stand(glm::dvec2(0.5 * (points[a] + points[b])), _lifts.between, points[into]);
    };
    for (std::size_t i = 0; i < 5; ++i)
        if (!half(i, (i + 1) % 5, 5 + i)) return false;
    return half(8, 5, 10) && half(3, 1, 11);
}

/// The light where it should be.
bool Method::isSide(std::size_t side, bool isTurnedAway) const {
    const glm::dvec3 towards = glm::dvec3(_light) - _light.w * glm::dvec3(_caster.vertices[side], _caster.high.z);
    const double behind = glm::dot(*inwardsOf(_caster, side), glm::dvec2(towards));
    const double grazing = mostOff * glm::length(towards);
    return isTurnedAway ? behind >= -grazing : behind <= grazing;
}

/// Whether the shadow of an edge of the roof runs straight in plan, at a quarter, a half and three quarters of its way.
/// That of an upright edge always does.
bool Method::isStraight(const glm::dvec2& from, const glm::dvec2& to) const {
    glm::dvec3 a, b, between;
    if (!project(from, a) || !project(to, b)) return false;
    const glm::dvec2 way(b - a);
    for (const double share : {0.25, 0.5, 0.75}) {
        if (!project(glm::mix(from, to, share), between)) return false;
        const double off = way.x * (between.y - a.y) - way.y * (between.x - a.x);
        if (std::abs(off) > mostOffOf(_caster) * glm::length(way)) return false;
    }
    return true;
}

bool Method::isOutline() const {
    if (!_caster.isBlock) return false;
    const Corners at = corners();
    const std::size_t first = indexOf(at.first);
    for (std::size_t i = 0; i < 4; ++i)
        if (!isSide((first + i) % 4, i < 2)) return false;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto ground = _ground.height(_caster.vertices[i].x, _caster.vertices[i].y);
        if (!ground || !(_caster.feet[i] <= *ground + mostOffOf(_caster))) return false;
    }
    const glm::dvec2 middle = vertexAt(at.middle);
    return isStraight(vertexAt(at.first), middle) && isStraight(middle, vertexAt(at.last));
}

} // namespace

BoxCaster boxCaster(const std::vector<glm::dvec3>& points) {
    glm::dvec3 low = points.front(), high = low;
    for (const glm::dvec3& point : points) low = glm::min(low, point), high = glm::max(high, point);
    return boxCaster(points, low, high);
}

BoxCaster boxCaster(const std::vector<glm::dvec3>& points, const glm::dvec3& low, const glm::dvec3& high) {
    BoxCaster caster{low, high};
    const glm::dvec2 corners[] = {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}};
    for (std::size_t i = 0; i < 4; ++i) caster.vertices[i] = nearestInPlan(points, corners[i]);
    caster.isBlock = true;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto [foot, roof] = reachAt(caster, i, points);
        caster.feet[i] = foot;
        caster.isBlock = caster.isBlock && roof >= high.z - mostOffOf(caster) && isWall(caster, i, points);
    }
    return caster;
}

int boxQuadrant(const glm::dvec2& away) {
    const double heading = std::atan2(-away.x, away.y);
    const double turned = heading < 0.0 ? heading + twoPi : heading;
    return std::min(static_cast<int>(turned / (twoPi / 4.0)), 3) + 1;
}

std::optional<BoxTriangles> boxShadow(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light,
                                      const BoxLifts& lifts) {
    const Method method(ground, caster, light, lifts);
    Points points;
    if (!method.outline(points) || !method.between(points)) return std::nullopt;
    BoxTriangles result;
    for (const auto& triangle : triangles)
        for (const std::size_t corner : triangle) result.push_back(points[corner]);
    return result;
}

std::array<glm::dvec2, 5> boxPentagon(const BoxTriangles& shadow) {
    std::array<glm::dvec2, 5> result;
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (triangles[i][k] < 5) result[triangles[i][k]] = glm::dvec2(shadow[3 * i + k]);
    return result;
}

bool isBoxOutline(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light) {
    return Method(ground, caster, light, {}).isOutline();
}

} // namespace gnomon
