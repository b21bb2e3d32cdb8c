// SPDX-License-Identifier: MIT
// The bounding-box method as published: its table, its mesh, the mistakes in print that it does not repeat, and how far off
// it is.
#include <support/TerrainTrial.h>

#include <gnomon/ground/BoxMethod.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <random>

using gnomon::BoxCaster;
using gnomon::BoxTriangles;
using gnomon::Ground;
using gnomon::HeightPyramid;
using test::degree;
using test::Prism;
using test::sunAt;

namespace {

HeightPyramid levelGround() {
    return HeightPyramid({{41, 41, {0.0, 0.0}, {10.0, 10.0}}, std::vector<float>(41 * 41, 3.0f)});
}

/// It goes down as far as there is ground.
Prism house(const glm::dvec2& half = {8.0, 5.0}, double turn = 0.0, double roof = 23.0,
            const glm::dvec2& middle = {200.0, 200.0}) {
    return test::boxAt(middle, half, turn, -200.0, roof);
}

/// Of these points, with the bounds of a house on the ground.
BoxCaster boxOf(const std::vector<glm::dvec3>& points, const Prism& house) {
    glm::dvec3 low = house.corners()[0], high = low;
    for (const glm::dvec3& corner : house.corners()) low = glm::min(low, corner), high = glm::max(high, corner);
    low.z = 3.0;
    return gnomon::boxCaster(points, low, high);
}

std::optional<BoxTriangles> shadowOf(const Ground& ground, const Prism& house, const glm::dvec4& light) {
    return gnomon::boxShadow(ground, boxOf(house.corners(), house), light);
}

glm::dvec4 sun(double azimuth, double elevation = 30.0) { return {sunAt(azimuth, elevation), 0.0}; }

/// Of triangles; those that are clockwise count as less than nothing.
double areaInPlan(const BoxTriangles& triangles) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const glm::dvec2 a(triangles[i]), b(triangles[i + 1]), c(triangles[i + 2]);
        sum += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    }
    return sum;
}

TEST(BoxShadow, QuadrantsAreThoseOfTheTableAndEveryAzimuthHasOne) {
    EXPECT_EQ(gnomon::boxQuadrant({-1.0, 1.0}), 1) << "away to the north-west";
    EXPECT_EQ(gnomon::boxQuadrant({-1.0, -1.0}), 2);
    EXPECT_EQ(gnomon::boxQuadrant({1.0, -1.0}), 3);
    EXPECT_EQ(gnomon::boxQuadrant({1.0, 1.0}), 4);
    EXPECT_EQ(gnomon::boxQuadrant({0.0, 1.0}), 1);
    EXPECT_EQ(gnomon::boxQuadrant({0.0, 0.0}), 1) << "straight overhead";
    for (int azimuth = 0; azimuth < 3600; ++azimuth) {
        const int quadrant = gnomon::boxQuadrant(glm::dvec2(sunAt(0.1 * azimuth, 0.0)));
        EXPECT_TRUE(quadrant >= 1 && quadrant <= 4) << azimuth;
    }
}

/// Of an axis-aligned box the pentagon is the shadow without the half of the footprint that is towards the light; a
/// midpoint that did not wrap, or a vertex of the printed table, would change its area.
TEST(BoxShadow, OfAnAxisAlignedHouseHasTheAreaWorkedByHandInEachQuadrant) {
    const HeightPyramid ground = levelGround();
    for (const int azimuth : {30, 120, 210, 300}) {
        const auto mesh = shadowOf(ground, house(), sun(azimuth));
        ASSERT_TRUE(mesh) << azimuth;
        EXPECT_EQ(mesh->size(), 36u);
        const double reach = 20.0 / std::tan(30.0 * degree);
        const double swept =
            reach * (std::abs(std::sin(azimuth * degree)) * 10.0 + std::abs(std::cos(azimuth * degree)) * 16.0);
        EXPECT_NEAR(areaInPlan(*mesh), 80.0 + swept, 1e-9) << azimuth;
    }
}

TEST(BoxShadow, LiftsItsPointsAsPublished) {
    const auto mesh = shadowOf(levelGround(), house({8.0, 5.0}, 0.2), sun(40.0));
    ASSERT_TRUE(mesh);
    int onGround = 0, projected = 0, between = 0;
    for (const glm::dvec3& point : *mesh) {
        onGround += std::abs(point.z - 3.0) < 1e-9;
        projected += std::abs(point.z - 3.05) < 1e-9;
        between += std::abs(point.z - 3.1) < 1e-9;
    }
    EXPECT_EQ(onGround, 3) << "the corners 0 and 4 of twelve triangles";
    EXPECT_EQ(projected, 7) << "1, 2 and 3";
    EXPECT_EQ(onGround + projected + between, 36);
}

TEST(BoxShadow, SaysSoWhereARayOrACornerMeetsNoGround) {
    const HeightPyramid ground = levelGround();
    EXPECT_FALSE(shadowOf(ground, house({8.0, 5.0}, 0.0, 23.0, {20.0, 200.0}), sun(90.0, 20.0)));
    EXPECT_FALSE(shadowOf(ground, house({8.0, 5.0}, 0.0, 23.0, {2.0, 200.0}), sun(270.0, 20.0)));
    EXPECT_FALSE(shadowOf(ground, house(), {0.0, 0.0, -1.0, 0.0})) << "from below";
}

TEST(BoxShadow, OfALampReachesAsFarAsItsRays) {
    const auto mesh = shadowOf(levelGround(), house({5.0, 5.0}, 0.0, 13.0), {180.0, 180.0, 53.0, 1.0});
    ASSERT_TRUE(mesh);
    glm::dvec2 farthest(0.0);
    for (const glm::dvec3& point : *mesh) farthest = glm::max(farthest, glm::dvec2(point));
    // From 50 above the ground past a corner at 10: the way from the lamp grows by 50 / 40.
    EXPECT_NEAR(farthest.x, 180.0 + 25.0 * 50.0 / 40.0, 1e-9);
    EXPECT_NEAR(farthest.y, 180.0 + 25.0 * 50.0 / 40.0, 1e-9);
}

/// Turned houses in all suns: where the outline is said to be the house's, all of its shadow is found and nothing else;
/// elsewhere a part is not.
TEST(BoxShadow, KnowsWhetherItsOutlineIsThatOfATurnedHouse) {
    const HeightPyramid ground = levelGround();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int right = 0, wrong = 0;
    for (int turn = 0; turn < 90; turn += turn == 40 ? 10 : 5) // not 45, where two vertices are as near to a corner
        for (int azimuth = 2; azimuth < 360; azimuth += 15) {
            const Prism turned = house({8.0, 5.0}, turn * degree);
            const auto mesh = shadowOf(ground, turned, sun(azimuth));
            ASSERT_TRUE(mesh);
            int differ = 0;
            for (int k = 0; k < 2000; ++k) {
                const glm::dvec2 p = 200.0 + 50.0 * glm::dvec2(unit(random), unit(random));
                if (turned.isUnder(p)) continue; // the house hides it
                differ += turned.blocks({p, 3.0}, sun(azimuth)) != (test::over(*mesh, p) > 0);
            }
            const bool is = gnomon::isBoxOutline(ground, boxOf(turned.corners(), turned), sun(azimuth));
            EXPECT_EQ(is, differ == 0) << turn << " turned, sun from " << azimuth << ", " << differ;
            ++(is ? right : wrong);
        }
    EXPECT_GT(right, 100);
    EXPECT_GT(wrong, 50);
}

TEST(BoxShadow, KnowsThatItsOutlineIsNotThatOfAnythingButAnUprightBlockInTheGround) {
    const HeightPyramid ground = levelGround();
    const auto isOutline = [&](const std::vector<glm::dvec3>& points, const glm::dvec4& light) {
        return gnomon::isBoxOutline(ground, boxOf(points, house()), light);
    };
    const std::vector<glm::dvec3> block = house().corners();
    EXPECT_TRUE(isOutline(block, sun(30.0)));
    EXPECT_TRUE(isOutline(block, {220.0, 230.0, 60.0, 1.0})) << "a lamp over a corner";
    EXPECT_FALSE(isOutline(block, {200.0, 230.0, 60.0, 1.0})) << "a lamp before one side";
    std::vector<glm::dvec3> gable = block, floating = block, sheet = block, porch = block;
    for (glm::dvec3& corner : gable)
        if (corner.z > 0.0 && corner.x < 200.0) corner.z = 15.0;
    for (glm::dvec3& corner : floating) corner.z = std::max(corner.z, 4.0);
    for (glm::dvec3& corner : sheet) corner.y = 195.0 + (corner.x - 192.0) * 10.0 / 16.0;
    porch.emplace_back(212.0, 200.0, 3.0);
    for (const auto& points : {gable, floating, sheet, porch}) EXPECT_FALSE(isOutline(points, sun(30.0)));
}

/// Shadows of the roof's edges are straight on any plane, and not where it has a kink under them.
TEST(BoxShadow, KnowsThatTheGroundBendsItsOutline) {
    const auto isOutline = [](const auto& heightAt) {
        std::vector<float> heights;
        for (int y = 0; y < 41; ++y)
            for (int x = 0; x < 41; ++x) heights.push_back(float(heightAt(10.0 * x, 10.0 * y)));
        const HeightPyramid ground({{41, 41, {0.0, 0.0}, {10.0, 10.0}}, std::move(heights)});
        return gnomon::isBoxOutline(ground, boxOf(house().corners(), house()), sun(30.0));
    };
    EXPECT_TRUE(isOutline([](double x, double y) { return 3.0 + 0.1 * (x - 200.0) - 0.05 * (y - 200.0); }));
    // The shadow's end goes from x = 175 to 191, its side from y = 165 to 175.
    EXPECT_FALSE(isOutline([](double x, double) { return 3.0 + 0.3 * std::max(0.0, 180.0 - x); }));
    EXPECT_FALSE(isOutline([](double, double y) { return 3.0 + 0.3 * std::max(0.0, 170.0 - y); }));
}

} // namespace
