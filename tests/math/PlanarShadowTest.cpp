// SPDX-License-Identifier: MIT
#include "Compare.h"
#include <gnomon/PlanarShadow.h>

using glm::dvec3;
using glm::dvec4;
using gnomon::test::flattened;
using gnomon::test::infinite;
using gnomon::test::near;
using gnomon::test::notANumber;
using gnomon::test::Random;

namespace {

constexpr double ulps = 1e-15; // a few roundings of numbers near 1
const dvec4 ground(0, 0, 1, 0);

double height(const dvec4& plane, const dvec3& point) { return glm::dot(dvec3(plane), point) + plane.w; }

/// A plane, a light at least `above` over it (sine, or metres), and a caster between them, in a scene of a few metres.
struct Scene {
    dvec4 plane, light;
    dvec3 caster;
};

Scene randomScene(Random& random) {
    const dvec3 normal = random.direction();
    const dvec4 plane(normal, random.between(-3.0, 3.0));
    const dvec3 foot = -normal * plane.w;
    dvec3 towards = random.direction();
    if (glm::dot(towards, normal) < 0.0) towards = -towards;
    towards = glm::normalize(towards + 0.2 * normal); // no lower than 9 degrees, so that shadows stay within the scene
    const bool lamp = random.between(0.0, 1.0) < 0.5;
    const double share = random.between(0.1, 0.9);
    const dvec3 lampAt = foot + random.between(2.0, 5.0) * towards;
    const dvec3 sideways = glm::cross(normal, random.direction());
    return {plane, lamp ? dvec4(lampAt, 1.0) : dvec4(towards, 0.0), foot + share * (lampAt - foot) + sideways};
}

/// The shadow by a ray from the caster away from the light, without the matrix.
dvec3 byRay(const Scene& scene) {
    const dvec3 ray = scene.light.w == 0.0 ? -dvec3(scene.light) : scene.caster - dvec3(scene.light);
    return scene.caster - ray * (height(scene.plane, scene.caster) / glm::dot(dvec3(scene.plane), ray));
}

} // namespace

TEST(PlanarShadowMatrix, IsAsWorkedByHand) {
    const struct {
        dvec4 plane, light;
        dvec3 caster, shadow;
    } cases[] = {
        {ground, {1, 0, 1, 0}, {0, 5, 3}, {-3, 5, 0}},  // a sun at 45 degrees shifts by the height
        {ground, {0, 0, 2, 1}, {1, -3, 1}, {2, -6, 0}}, // similar triangles
        // A sun along the normal drops the perpendicular: (10, 1, 10) is 6 + 8 - 5 = 9 over the plane.
        {{0.6, 0, 0.8, -5}, {0.6, 0, 0.8, 0}, {10, 1, 10}, {4.6, 1, 2.8}},
    };
    for (const auto& [plane, light, caster, shadow] : cases)
        EXPECT_TRUE(near(flattened(gnomon::planarShadowMatrix(plane, light).value(), caster), shadow, 32.0 * ulps));
}

TEST(PlanarShadowMatrix, IsTheOneMatrixEntryByEntry) {
    // P = (0, 0, 1, -1), L = (2, 3, 6, 0) of length 7: P·L = 6, so 7 M = 6 I - L Pᵀ.
    const auto matrix = gnomon::planarShadowMatrix({0, 0, 1, -1}, {2, 3, 6, 0});
    ASSERT_TRUE(matrix);
    // clang-format off
    const glm::dmat4 sevenM(6,  0,  0, 0,
                            0,  6,  0, 0,
                           -2, -3,  0, 0,
                            2,  3,  6, 6); // columns
    // clang-format on
    EXPECT_TRUE(near(7.0 * *matrix, sevenM, 8.0 * ulps));
}

TEST(PlanarShadowMatrix, AgreesWithTheRayThroughTheCasterAndLeavesPointsOfThePlane) {
    Random random(14);
    for (int i = 0; i < 1000; ++i) {
        const Scene scene = randomScene(random);
        const glm::dmat4 m = gnomon::planarShadowMatrix(scene.plane, scene.light).value();
        EXPECT_TRUE(near(flattened(m, scene.caster), byRay(scene), 1e-12)); // coordinates up to 50, w down to 0.02
        EXPECT_GT((m * dvec4(scene.caster, 1.0)).w, 0.0);
        const dvec3 any = random.inCube(3.0);
        const dvec4 on(any - dvec3(scene.plane) * height(scene.plane, any), 1.0);
        const double scale = glm::dot(scene.plane, scene.light) / glm::length(scene.light);
        EXPECT_TRUE(near(m * on, scale * on, 64.0 * ulps)); // terms up to 10
    }
}

TEST(PlanarShadowMatrix, TheLengthOfLDoesNotMatter) {
    const dvec4 plane(0.6, 0, 0.8, -5);
    for (const dvec4& light : {dvec4(3, 2, 9, 0), dvec4(3, 2, 9, 1)}) {
        const glm::dmat4 expected = gnomon::planarShadowMatrix(plane, light).value();
        for (const double length : {1e-300, 1e-150, 1e-3, 1e3, 1e150, 1e300}) {
            const auto matrix = gnomon::planarShadowMatrix(plane, light * length);
            ASSERT_TRUE(matrix) << length;
            EXPECT_TRUE(near(*matrix, expected, 4.0 * ulps)) << length;
        }
    }
}

TEST(PlanarShadowMatrix, NegativeWIsTheSameLamp) {
    const dvec4 plane(0, 0, 1, -1);
    const auto matrix = gnomon::planarShadowMatrix(plane, {-2, -4, -6, -2});
    ASSERT_TRUE(matrix);
    EXPECT_EQ(*matrix, gnomon::planarShadowMatrix(plane, {1, 2, 3, 1}).value()); // twice, exactly
    EXPECT_GT((*matrix * dvec4(0, 0, 2, 1)).w, 0.0);
    EXPECT_FALSE(gnomon::planarShadowMatrix(plane, {2, 4, 6, -2})); // (-1, -2, -3): under the plane
}

TEST(PlanarShadowMatrix, ThereIsNoShadowWithoutALightOnTheLitSide) {
    EXPECT_TRUE(gnomon::planarShadowMatrix(ground, {1, 2, 3, 0}));
    for (const dvec4& light : {dvec4(-1, -2, -3, 0), dvec4(-1, -2, -3, -0.0), // a sun's opposite is another light
                               dvec4(1, 0, 0, 0),                             // on the horizon
                               dvec4(1, 0, -1, 0), dvec4(1, 0, 0, 1),         // a lamp that lies on the ground
                               dvec4(1, 0, -1, 1), dvec4(0, 0, 0, 1), dvec4(0)})
        EXPECT_FALSE(gnomon::planarShadowMatrix(ground, light)) << light.x << " " << light.z << " " << light.w;
}

TEST(PlanarShadowMatrix, WhatIsNotFiniteGivesNoShadow) {
    for (const double bad : {notANumber, infinite, -infinite})
        for (int i = 0; i < 4; ++i) {
            dvec4 light(1, 2, 3, 1), plane(0.6, 0, 0.8, -1);
            light[i] = bad;
            EXPECT_FALSE(gnomon::planarShadowMatrix(plane, light)) << i << ' ' << bad;
            plane[i] = bad;
            EXPECT_FALSE(gnomon::planarShadowMatrix(plane, {1, 2, 3, 1})) << i << ' ' << bad;
        }
}

TEST(PlanarShadowMatrix, ASunLowerThanATenThousandthHasNoShadow) {
    for (const double length : {1e-100, 1.0, 1e100}) {
        EXPECT_TRUE(gnomon::planarShadowMatrix(ground, dvec4(1, 0, 1.01e-4, 0) * length)) << length;
        EXPECT_FALSE(gnomon::planarShadowMatrix(ground, dvec4(1, 0, 0.99e-4, 0) * length)) << length;
        EXPECT_TRUE(gnomon::planarShadowMatrix({0, 0, 1, 1e7}, dvec4(1, 0, 1.01e-4, 0) * length)) << length;
    }
}

TEST(PlanarShadowMatrix, ALampAMillimetreUpHasAShadowWhereverTheOriginIs) {
    Random random(15);
    for (const double away : {0.0, 1.0, 1e3, 6.4e6})
        for (const double unit : {1e-3, 1.0, 1e3}) {
            const dvec3 normal = random.direction(), foot = away * random.direction();
            const dvec4 plane(normal, -glm::dot(normal, foot) * unit);
            EXPECT_TRUE(gnomon::planarShadowMatrix(plane, dvec4((foot + 1e-3 * normal) * unit, 1.0))) << away;
            EXPECT_FALSE(gnomon::planarShadowMatrix(plane, dvec4((foot - 1e-3 * normal) * unit, 1.0))) << away;
        }
}

TEST(PlanarShadowMatrix, ALampOnThePlaneButForRoundingHasNone) {
    Random random(16);
    for (int i = 0; i < 2000; ++i) {
        const dvec3 normal = random.direction(), foot = 6.4e6 * random.direction();
        const dvec4 plane(normal, -glm::dot(normal, foot));
        const dvec3 lamp = foot + glm::cross(normal, random.inCube(1e3));
        EXPECT_FALSE(gnomon::planarShadowMatrix(plane, dvec4(lamp, 1.0)));
    }
}

TEST(PlanarShadowMatrix, ARecedingLampBecomesTheSun) {
    const dvec4 plane(0.6, 0, 0.8, -1), sun(dvec3(2, 3, 6) / 7.0, 0.0);
    const glm::dmat4 limit = gnomon::planarShadowMatrix(plane, sun).value();
    for (double w = 1e-2; w > 1e-320; w *= 1e-3) {
        const auto matrix = gnomon::planarShadowMatrix(plane, sun + dvec4(0, 0, 0, w));
        ASSERT_TRUE(matrix) << w;
        EXPECT_TRUE(near(*matrix, limit, 3.0 * w + ulps)) << w; // P·L and L change by no more than w each
    }
}

TEST(PlanarShadowMatrix, TheUnitOfLengthDoesNotMatter) {
    Random random(17);
    for (int i = 0; i < 300; ++i) {
        const Scene scene = randomScene(random);
        const dvec3 metres = flattened(gnomon::planarShadowMatrix(scene.plane, scene.light).value(), scene.caster);
        for (const double unit : {1e-6, 1e3, 1e6}) {
            const double lightUnit = scene.light.w == 0.0 ? 1.0 : unit;
            const dvec4 light(dvec3(scene.light) * lightUnit, scene.light.w);
            const dvec4 plane(dvec3(scene.plane), scene.plane.w * unit);
            const auto matrix = gnomon::planarShadowMatrix(plane, light);
            ASSERT_TRUE(matrix) << unit;
            EXPECT_TRUE(near(flattened(*matrix, scene.caster * unit) / unit, metres, 1e-12)); // as above
        }
    }
}

TEST(PlanarClipPlanes, TheSecondCutsAThousandthBelowTheLamp) {
    for (const double w : {1.0, 5.0, -1.0, 1e-100}) {
        const dvec4 cut = gnomon::planarClipPlanes({0, 0, 1, -2}, dvec4(30, 40, 12, 1) * w).belowLight; // height 10
        EXPECT_GT(glm::dot(cut, dvec4(-7, 9, 11.989, 1)), 0.0) << w;
        EXPECT_LT(glm::dot(cut, dvec4(-7, 9, 11.991, 1)), 0.0) << w;
        EXPECT_LT(glm::dot(cut, dvec4(-7, 9, 13, 1)), 0.0) << w;
    }
}

TEST(PlanarClipPlanes, TheFirstIsThePlaneItselfAndASunCutsNothing) {
    const dvec4 plane(0.6, 0, 0.8, -1);
    EXPECT_EQ(gnomon::planarClipPlanes(plane, {1, 2, 3, 1}).abovePlane, plane);
    const auto ofSun = gnomon::planarClipPlanes(plane, {1, 2, 3, 0});
    EXPECT_EQ(ofSun.abovePlane, plane);
    EXPECT_EQ(dvec3(ofSun.belowLight), dvec3(0));
    EXPECT_GT(ofSun.belowLight.w, 0.0);
}

TEST(PlanarClipPlanes, WhatTheyKeepIsInFrontOfTheLight) {
    Random random(18);
    int kept = 0, cut = 0;
    for (int i = 0; i < 5000; ++i) {
        const Scene scene = randomScene(random);
        const auto clip = gnomon::planarClipPlanes(scene.plane, scene.light);
        const glm::dmat4 m = gnomon::planarShadowMatrix(scene.plane, scene.light).value();
        const dvec4 point(random.inCube(10.0), 1.0);
        const bool keep = glm::dot(clip.abovePlane, point) >= 0.0 && glm::dot(clip.belowLight, point) >= 0.0;
        const double lampHeight = height(scene.plane, dvec3(scene.light));
        const double pointHeight = height(scene.plane, dvec3(point));
        const bool between = pointHeight >= 0.0 && (scene.light.w == 0.0 || pointHeight <= 0.999 * lampHeight);
        EXPECT_EQ(keep, between); // no random point comes within a rounding of either plane
        EXPECT_TRUE(!keep || (m * point).w > 0.0);
        ++(keep ? kept : cut);
    }
    EXPECT_GT(kept, 1000);
    EXPECT_GT(cut, 1000);
}
