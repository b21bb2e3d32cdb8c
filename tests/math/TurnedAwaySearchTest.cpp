// SPDX-License-Identifier: MIT
// Whether ground is turned away from a light, and for how long: against the plane of each triangle.
#include "Compare.h"
#include "GroundTriangles.h"
#include <support/TerrainTrial.h>

#include <gnomon/ground/GroundSearch.h>

#include <algorithm>

using gnomon::GroundTriangle;
using gnomon::HeightPyramid;
using gnomon::TriangleGround;
using gnomon::TurnedAway;
using gnomon::test::Random;
using test::sunAt;

namespace {

constexpr int posts = 70;

/// How far a light is above the plane of the triangle that it is least above.
double leastAbove(const std::vector<GroundTriangle>& triangles, const glm::dvec4& light) {
    double least = std::numeric_limits<double>::infinity();
    for (const GroundTriangle& t : triangles) {
        glm::dvec3 up = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
        if (up.z < 0.0) up = -up;
        least = std::min(least, glm::dot(up, glm::dvec3(light) - light.w * t[0]));
    }
    return least;
}

glm::dvec3 anyDirection(Random& random) {
    return glm::normalize(glm::dvec3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)) +
                          1e-3);
}

/// A light as far away as it may be.
glm::dvec4 moved(const glm::dvec4& light, double by, Random& random) {
    const glm::dvec3 from(light);
    if (light.w > 0.0) return {from + by * anyDirection(random), 1.0};
    const glm::dvec3 beside = glm::normalize(glm::cross(from, anyDirection(random)));
    const double angle = 2.0 * std::asin(std::min(0.5 * by, 1.0)); // of a chord of this length
    return {std::cos(angle) * from + std::sin(angle) * beside, 0.0};
}

TEST(TurnedAwaySearch, KnowsHowFarALightMayMove) {
    const HeightPyramid field = test::groundOf(test::steepHills, posts, 300.0);
    const std::vector<GroundTriangle> triangles = test::trianglesOf(field.field());
    const TriangleGround loose = test::LooseTriangles(triangles).ground();
    Random random(7);
    int away = 0, notAway = 0;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec4 light = i % 2 ? glm::dvec4(sunAt(random.between(0.0, 360.0), random.between(5.0, 60.0)), 0.0)
                                       : glm::dvec4(random.between(0.0, 700.0), random.between(0.0, 700.0),
                                                    300.0 + random.between(40.0, 900.0), 1.0);
        const double least = leastAbove(triangles, light);
        for (const gnomon::Ground* ground :
             {static_cast<const gnomon::Ground*>(&field), static_cast<const gnomon::Ground*>(&loose)}) {
            const TurnedAway found = ground->turnedAway(light);
            ASSERT_EQ(found.is, least < 0.0);
            for (int k = 0; k < 6; ++k)
                EXPECT_EQ(leastAbove(triangles, moved(light, 0.999 * found.until, random)) < 0.0, found.is);
            if (light.w == 0.0 && !found.is)
                EXPECT_GE(found.until, 0.999 * std::min(least, 0.05)) << "so near it is looked at exactly";
        }
        ++(least < 0.0 ? away : notAway);
    }
    EXPECT_GT(away, 10);
    EXPECT_GT(notAway, 10);
}

TEST(TurnedAwaySearch, IsDoneAFewTimesADay) {
    const HeightPyramid field = test::groundOf(test::steepHills, posts, 300.0);
    const std::vector<GroundTriangle> triangles = test::trianglesOf(field.field());
    gnomon::FollowedTurn followed;
    int away = 0;
    constexpr int frames = 2000;
    for (int i = 1; i < frames; ++i) {
        const double share = double(i) / frames;
        const glm::dvec4 sun(sunAt(90.0 + 180.0 * share, 60.0 * std::sin(share * 180.0 * test::degree)), 0.0);
        const bool is = leastAbove(triangles, sun) < 0.0;
        ASSERT_EQ(followed.isTurnedAway(field, 3.0 * sun), is) << i;
        away += is;
    }
    EXPECT_GT(away, frames / 10);
    EXPECT_LT(away, frames * 9 / 10);
    EXPECT_LT(followed.searches(), 200u) << "each is a look at all that is steep";
}

TEST(TurnedAwaySearch, IsDoneAnewForAnotherGroundAndAnotherKindOfLight) {
    const HeightPyramid field = test::groundOf(test::steepHills, posts),
                        level = test::groundOf([](double, double) { return 0.0; }, 9);
    gnomon::FollowedTurn followed;
    const glm::dvec4 low(sunAt(90.0, 5.0), 0.0);
    EXPECT_TRUE(followed.isTurnedAway(field, low));
    EXPECT_FALSE(followed.isTurnedAway(field, {350.0, 350.0, 9000.0, 1.0})) << "a lamp high above";
    EXPECT_TRUE(followed.isTurnedAway(field, low));
    followed.groundChanged();
    EXPECT_FALSE(followed.isTurnedAway(level, low));
}

} // namespace
