// SPDX-License-Identifier: MIT
// Whether a box can shadow another one, against rays from many of its points.
#include "Compare.h"
#include <gnomon/geometry/ShadowReach.h>

using glm::dvec3;
using glm::dvec4;
using gnomon::AlignedBox;
using gnomon::shadowReaches;
using gnomon::test::Random;

namespace {

constexpr int steps = 8; // of points along an edge

/// Whether the way from a point to the light leads through a box, plane by plane.
bool isBlocked(const dvec3& point, const dvec4& light, const AlignedBox& caster) {
    const dvec3 way = dvec3(light) - light.w * point;
    double from = 0.0, to = light.w > 0.0 ? 1.0 / light.w : 1e9;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (caster.low[axis] - point[axis]) / way[axis],
                     b = (caster.high[axis] - point[axis]) / way[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from <= to;
}

bool isAnyBlocked(const AlignedBox& surface, const dvec4& light, const AlignedBox& caster) {
    for (int x = 0; x <= steps; ++x)
        for (int y = 0; y <= steps; ++y)
            for (int z = 0; z <= steps; ++z) {
                const dvec3 share = dvec3(x, y, z) / double(steps);
                if (isBlocked(surface.low + share * (surface.high - surface.low), light, caster)) return true;
            }
    return false;
}

AlignedBox randomBox(Random& random) {
    const dvec3 low = random.inCube(4.0);
    return {low, low + dvec3(random.between(0.1, 2.0), random.between(0.1, 2.0), random.between(0.1, 2.0))};
}

} // namespace

TEST(ShadowReach, IsThatOfTheRaysOfAllPoints) {
    Random random(31);
    int reached = 0;
    for (int i = 0; i < 2000; ++i) {
        const AlignedBox caster = randomBox(random), surface = randomBox(random);
        const dvec4 light = i % 2 ? dvec4(random.direction(), 0.0) : dvec4(random.inCube(8.0), 1.0);
        const bool reaches = shadowReaches(caster, surface, light);
        reached += reaches;
        if (isAnyBlocked(surface, light, caster)) {
            EXPECT_TRUE(reaches) << i;
        }
        // A point of the surface is half a step from one of those, and its ray no further from that one's.
        const dvec3 halfStep = 0.5 * (surface.high - surface.low) / double(steps);
        if (reaches) {
            EXPECT_TRUE(isAnyBlocked(surface, light, {caster.low - halfStep, caster.high + halfStep})) << i;
        }
    }
    EXPECT_GT(reached, 100);
    EXPECT_LT(reached, 1900);
}

TEST(ShadowReach, EndsAtTheLampAndAtTheSurface) {
    const AlignedBox surface{{-1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}}, above{{-0.5, -0.5, 4.0}, {0.5, 0.5, 5.0}},
        below{{-0.5, -0.5, -2.0}, {0.5, 0.5, -1.0}};
    EXPECT_TRUE(shadowReaches(above, surface, {0.0, 0.0, 6.0, 1.0}));
    EXPECT_FALSE(shadowReaches(above, surface, {0.0, 0.0, 3.0, 1.0})) << "the lamp is lower";
    EXPECT_TRUE(shadowReaches(above, surface, {0.0, 0.0, 1.0, 0.0}));
    EXPECT_FALSE(shadowReaches(below, surface, {0.0, 0.0, 1.0, 0.0})) << "on the far side";
}
