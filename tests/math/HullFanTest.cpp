// SPDX-License-Identifier: MIT
// The hull's shadow as one polygon, in plan against rays at boxes in double.
#include "Houses.h"

#include <gnomon/onterrain/HullFan.h>
#include <gtest/gtest.h>

#include <iostream>
#include <limits>

using gnomon::Drape;
using gnomon::Ground;
using gnomon::HeightPyramid;
using test::degree;
using test::groundOf;
using test::hills;
using test::House;
using test::sunAt;

namespace {

constexpr int posts = 160;

double level(double, double) { return 3.0; }

std::optional<Drape> fanOf(const Ground& ground, const House& house, const glm::dvec3& sun) {
    const auto fan = gnomon::hullFan(ground, *gnomon::convexHull(house.corners()), glm::dvec4(sun, 0.0));
    return fan ? std::optional(fan->triangles) : std::nullopt;
}

/// Intersection and union in plan, in points of a grid of 0.5 m over where the shadow may be.
struct Overlap {
    double both = 0.0, either = 0.0;
    double share() const { return either > 0.0 ? both / either : 1.0; }
};

Overlap overlap(const Ground& ground, const House& house, const glm::dvec3& sun, const Drape& fan) {
    const double reach = 40.0 + 45.0 * std::hypot(sun.x, sun.y) / sun.z;
    Overlap result;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const glm::dvec2 away = -glm::normalize(glm::dvec2(sun)), across(-away.y, away.x);
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec2 p =
            house.middle + away * (0.5 * reach * (1.0 + unit(random)) - 20.0) + across * (20.0 * unit(random));
        const auto height = ground.height(p.x, p.y);
        const bool expected = height && house.blocks({p.x, p.y, *height}, sun), found = test::over(fan, p) > 0;
        result.both += expected && found;
        result.either += expected || found;
    }
    return result;
}

TEST(HullFan, KeepsToTheTruthOnHillsWithFewerTrianglesThanTheBoxMethod) {
    const HeightPyramid ground = groundOf(hills, posts);
    const struct {
        double elevation, pooled, fifth;
    } wanted[] = {{60.0, 0.995, 0.98}, {30.0, 0.995, 0.98}, {10.0, 0.985, 0.97}};
    for (const auto& [elevation, pooled, fifth] : wanted) {
        std::vector<double> shares;
        Overlap all;
        std::size_t triangles = 0, most = 0;
        for (const House& house : test::houses(120, ground)) {
            const glm::dvec3 sun = sunAt(41.0 * house.roof, elevation);
            const auto fan = fanOf(ground, house, sun);
            ASSERT_TRUE(fan);
            const Overlap one = overlap(ground, house, sun, *fan);
            all.both += one.both;
            all.either += one.either;
            shares.push_back(one.share());
            triangles += fan->size() / 3;
            most = std::max(most, fan->size() / 3);
        }
        std::sort(shares.begin(), shares.end());
        std::cout << "sun " << elevation << ": IoU " << all.share() << ", 5th percentile " << shares[shares.size() / 20]
                  << ", " << double(triangles) / double(shares.size()) << " triangles\n";
        EXPECT_GE(all.share(), pooled) << elevation;
        EXPECT_GE(shares[shares.size() / 20], fifth) << elevation;
        EXPECT_LE(most, 12u) << "the published mesh";
    }
}

/// Low and wide: they stand on ten times as much as they shade.
TEST(HullFan, KnowsHowMuchOfWhatIsSeenIsWrong) {
    const HeightPyramid ground = groundOf(hills, posts);
    double off = 0.0, wrong = 0.0;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec2 middle(400.0 + 13.0 * i, 1100.0 - 11.0 * i);
        const double height = *ground.height(middle.x, middle.y);
        const test::Prism hall = test::boxAt(middle, {20.0, 15.0}, i, height - 40.0, height + 8.0);
        const glm::dvec4 sun(sunAt(137.5 * i, 60.0), 0.0);
        const auto fan = gnomon::hullFan(ground, hall.parts()[0].hull, sun);
        ASSERT_TRUE(fan);
        const test::Contestant given{"fan", [&](const auto&, const auto&, const auto&) { return fan->triangles; }};
        off += fan->off;
        wrong += 1.0 - judge(ground, hall, sun, {given}, 3000)[0].overlap();
    }
    std::cout << "said to be wrong: " << off / 60.0 << ", wrong: " << wrong / 60.0 << "\n";
    EXPECT_GT(off, 0.5 * wrong);
    EXPECT_LT(off, 2.0 * wrong);
}

TEST(HullFan, OfATankInALowSunTakesTwelveTrianglesAndHardlyLosesAnything) {
    const HeightPyramid ground = groundOf(level, posts);
    const auto prisms = test::prismsOn(ground, glm::dvec2(500.0), glm::dvec2(900.0), 40, 6);
    for (const test::Prism& tank : prisms)
        for (const double elevation : {10.0, 60.0}) {
            if (tank.kind != "tank") continue;
            const glm::dvec4 sun(sunAt(30.0 * elevation, elevation), 0.0);
            const auto fan = gnomon::hullFan(ground, tank.parts()[0].hull, sun);
            ASSERT_TRUE(fan);
            EXPECT_LE(fan->triangles.size(), elevation < 20.0 && tank.roof > 15.0 ? 36u : 60u);
            const test::Contestant given{"fan", [&](const auto&, const auto&, const auto&) { return fan->triangles; }};
            const double lost = 1.0 - judge(ground, tank, sun, {given}, 10000)[0].overlap();
            EXPECT_LT(lost, 0.012) << "and points";
            EXPECT_LE(fan->off, 0.01);
            EXPECT_GE(fan->off, 0.5 * lost) << "half of it may be under the tank";
        }
}

TEST(HullFan, OnLevelGroundIsExactAtEveryAzimuthAndTurn) {
    const HeightPyramid ground = groundOf(level, posts);
    double last = 0.0, jump = 0.0;
    for (int azimuth = 0; azimuth <= 360; ++azimuth) {
        const House house{{800.0, 800.0}, {8.0, 5.0}, (azimuth % 90) * degree, 23.0};
        const glm::dvec3 sun = sunAt(azimuth, 30.0);
        const auto fan = fanOf(ground, house, sun);
        ASSERT_TRUE(fan) << azimuth;
        const double share = overlap(ground, house, sun, *fan).share();
        EXPECT_GT(share, 0.999) << azimuth << ": points on the rim";
        if (azimuth > 0) jump = std::max(jump, std::abs(share - last));
        last = share;
    }
    EXPECT_LT(jump, 0.02);
}

TEST(HullFan, IsTheFootprintUnderASunStraightOverhead) {
    const HeightPyramid ground = groundOf(level, posts);
    const House house{{800.0, 800.0}, {8.0, 5.0}, 0.3, 23.0};
    for (const double off : {0.0, 1e-12, 1e-6}) {
        const auto fan = fanOf(ground, house, {off, 0.0, 1.0});
        ASSERT_TRUE(fan) << off;
        double area = 0.0;
        for (std::size_t i = 0; i < fan->size(); i += 3)
            area += 0.5 * ((*fan)[i + 1].x - (*fan)[i].x) * ((*fan)[i + 2].y - (*fan)[i].y) -
                    0.5 * ((*fan)[i + 1].y - (*fan)[i].y) * ((*fan)[i + 2].x - (*fan)[i].x);
        EXPECT_NEAR(area, 160.0, 1e-3) << off;
    }
}

TEST(HullFan, SaysSoWhereARayMeetsNoGround) {
    const HeightPyramid ground = groundOf(level, posts);
    EXPECT_FALSE(fanOf(ground, {{15.0, 800.0}, {8.0, 5.0}, 0.0, 23.0}, sunAt(90.0, 20.0))) << "over the border";
    EXPECT_TRUE(fanOf(ground, {{15.0, 800.0}, {8.0, 5.0}, 0.0, 23.0}, sunAt(270.0, 20.0)));
}

} // namespace
