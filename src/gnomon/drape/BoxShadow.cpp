// SPDX-License-Identifier: MIT
#include <gnomon/drape/BoxShadow.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon {
namespace {

constexpr double twoPi = 6.283185307179586;
constexpr double mostOff = 1e-3; // of the box's size: half a pixel where the caster is 500 pixels large

using Points = std::array<glm::dvec3, 12>;

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

class Method {
public:
    Method(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light, const BoxLifts& lifts)
        : _ground(ground), _caster(caster), _light(light), _lifts(lifts) {}

    bool outline(Points& points) const;
    bool isOutlineOf(const std::vector<glm::dvec3>& points) const;
    bool between(Points& points) const;

private:
    Corners corners() const {
        const glm::dvec2 middle(0.5 * (_caster.low + _caster.high));
        return cornersOf(boxQuadrant(middle * _light.w - glm::dvec2(_light)));
    }
    bool isSide(const glm::dvec2& from, const glm::dvec2& to, bool isTurnedAway,
                const std::vector<glm::dvec3>& points) const;
    bool isUpright(const glm::dvec2& at, const std::vector<glm::dvec3>& points) const;
    double mostOff() const { return gnomon::mostOff * glm::length(_caster.high - _caster.low); }
    glm::dvec2 vertexAt(const glm::bvec2& corner) const {
        return _caster.nearestVertex(
            {corner.x ? _caster.high.x : _caster.low.x, corner.y ? _caster.high.y : _caster.low.y});
    }
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

/// All points on its inner side, and the light where it should be. Counter-clockwise.
bool Method::isSide(const glm::dvec2& from, const glm::dvec2& to, bool isTurnedAway,
                    const std::vector<glm::dvec3>& points) const {
    const glm::dvec2 way = to - from;
    const double length = glm::length(way);
    if (!(length > mostOff())) return false;
    const glm::dvec2 inwards = glm::dvec2(-way.y, way.x) / length;
    const glm::dvec3 towards = glm::dvec3(_light) - _light.w * glm::dvec3(from, _caster.high.z);
    const double behind = glm::dot(inwards, glm::dvec2(towards)), grazing = gnomon::mostOff * glm::length(towards);
    if (isTurnedAway ? behind < -grazing : behind > grazing) return false;
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
        return glm::dot(inwards, glm::dvec2(point) - from) >= -mostOff();
    });
}

/// A corner that goes from the roof into the ground.
bool Method::isUpright(const glm::dvec2& at, const std::vector<glm::dvec3>& points) const {
    glm::dvec3 foot;
    if (!stand(at, 0.0, foot)) return false;
    bool roof = false, stands = false;
    for (const glm::dvec3& point : points) {
        if (glm::length(glm::dvec2(point) - at) > mostOff()) continue;
        roof = roof || point.z >= _caster.high.z - mostOff();
        stands = stands || point.z <= foot.z + mostOff();
    }
    return roof && stands;
}

bool Method::isOutlineOf(const std::vector<glm::dvec3>& points) const {
    const Corners at = corners();
    const std::array<glm::dvec2, 4> all{vertexAt(at.first), vertexAt(at.middle), vertexAt(at.last),
                                        vertexAt(glm::not_(at.middle))};
    for (std::size_t i = 0; i < 4; ++i)
        if (!isSide(all[i], all[(i + 1) % 4], i < 2, points) || !isUpright(all[i], points)) return false;
    return true;
}

} // namespace

int boxQuadrant(const glm::dvec2& away) {
    const double heading = std::atan2(-away.x, away.y);
    const double turned = heading < 0.0 ? heading + twoPi : heading;
    return std::min(static_cast<int>(turned / (twoPi / 4.0)), 3) + 1;
}

std::optional<Drape> boxShadow(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light,
                               const BoxLifts& lifts) {
    const Method method(ground, caster, light, lifts);
    Points points;
    if (!method.outline(points) || !method.between(points)) return std::nullopt;
    constexpr std::size_t triangles[12][3] = {{0, 5, 9},   {5, 10, 9}, {10, 4, 9}, {8, 4, 10}, {5, 1, 10}, {10, 1, 11},
                                              {11, 8, 10}, {11, 3, 8}, {1, 6, 11}, {6, 2, 11}, {2, 7, 11}, {7, 3, 11}};
    Drape result;
    for (const auto& triangle : triangles)
        for (const std::size_t corner : triangle) result.push_back(points[corner]);
    return result;
}

bool isBoxOutline(const Ground& ground, const std::vector<glm::dvec3>& points, const BoxCaster& caster,
                  const glm::dvec4& light) {
    return Method(ground, caster, light, {}).isOutlineOf(points);
}

} // namespace gnomon
