// SPDX-License-Identifier: MIT
// Ground and shadows draped on it, against rays at boxes in the boxes' own frames, in double.
#include "Houses.h"

#include <gtest/gtest.h>

#include <limits>

using gnomon::Drape;
using gnomon::Ground;
using gnomon::HeightField;
using gnomon::HeightPyramid;
using test::groundOf;
using test::House;
using test::houses;
using test::over;
using test::pitch;
using test::sunAt;

namespace {

constexpr int posts = 130; // no power of two

double hills(double x, double y) {
    return 25.0 * std::sin(x * 0.011) * std::cos(y * 0.013) + 4.0 * std::sin(x * 0.05 + y * 0.03);
}

/// A step of 20 m along x = 600, half a pitch wide.
double cliff(double x, double) { return x < 600.0 ? 20.0 : 0.0; }

double level(double, double) { return 3.0; }

struct Tally {
    int shadowed = 0, wrong = 0, beyond = 0, twice = 0;
    std::size_t triangles = 0;
};

/// @param error  in plan: a wrong place must have the other answer within it, along the azimuth.
Tally tally(const Ground& ground, const House& house, const glm::dvec3& sun, double error) {
    const auto shadow = gnomon::convexShadow(*gnomon::convexHull(house.corners()), glm::dvec4(sun, 0.0));
    const double tangent = sun.z / std::hypot(sun.x, sun.y);
    const Drape drape =
        gnomon::drape(ground, *shadow, gnomon::heightError(error, tangent, ground.steepest(shadow->planes)));
    const glm::dvec2 azimuth = glm::normalize(glm::dvec2(sun));
    const auto dark = [&](const glm::dvec2& p) {
        const auto height = ground.height(p.x, p.y);
        return height && house.blocks({p.x, p.y, *height}, sun);
    };
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-90.0, 90.0);
    Tally result;
    result.triangles = drape.size() / 3;
    for (int i = 0; i < 1500; ++i) {
        const glm::dvec2 p = house.middle + test::drawn(place, random);
        const bool expected = dark(p);
        const int found = over(drape, p);
        result.shadowed += expected;
        result.twice += found > 1;
        if ((found > 0) == expected) continue;
        ++result.wrong;
        bool near = false;
        for (int step = -20; step <= 20; ++step) near = near || dark(p + azimuth * (error * step / 20.0)) != expected;
        result.beyond += !near;
    }
    return result;
}

TEST(HeightField, IsWhatItsPostsSayAndNothingBesideThemOrInHoles) {
    std::vector<float> heights{0, 1, 2, 3, 5, 7, 4, 8, std::numeric_limits<float>::quiet_NaN()};
    const HeightField ground(3, 3, {10.0, 20.0}, {2.0, 4.0}, heights, 100.0);
    EXPECT_DOUBLE_EQ(*ground.height(10.0, 20.0), 100.0);
    EXPECT_DOUBLE_EQ(*ground.height(12.0, 22.0), 103.0);
    EXPECT_DOUBLE_EQ(*ground.height(11.0, 22.0), 102.5) << "on the diagonal";
    EXPECT_DOUBLE_EQ(*ground.height(11.5, 21.0), 100.0 + 0.75 * 1.0 + 0.25 * 4.0) << "right of it";
    EXPECT_DOUBLE_EQ(*ground.height(10.5, 23.0), 100.0 + 0.75 * 3.0 + 0.25 * 2.0) << "left of it";
    EXPECT_FALSE(ground.height(13.0, 26.0)) << "a hole";
    EXPECT_TRUE(ground.height(13.0, 22.0));
    EXPECT_FALSE(ground.height(9.999, 22.0));
    EXPECT_FALSE(ground.height(std::nan(""), 22.0));
    EXPECT_THROW(HeightField(1, 3, {}, {1.0, 1.0}, {1, 2, 3}), std::invalid_argument);
    EXPECT_THROW(HeightField(2, 2, {}, {1.0, 1.0}, {1, 2, 3}), std::invalid_argument);
    EXPECT_THROW(HeightField(2, 2, {}, {1.0, 0.0}, {1, 2, 3, 4}), std::invalid_argument);
}

TEST(HeightPyramid, FindsTheFirstPlaceThatARayMeets) {
    const HeightPyramid ground = groundOf(hills, posts);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(50.0, 1200.0), slope(-0.5, 0.5);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 start(place(random), place(random), 60.0), along(slope(random), slope(random), -0.12);
        const auto hit = ground.hit(start, along);
        // By small steps: the first one below ground.
        double at = 0.0;
        const auto above = [&](double t) {
            const glm::dvec3 p = start + t * along;
            const auto height = ground.height(p.x, p.y);
            return !height || p.z > *height;
        };
        while (at < 3000.0 && above(at)) at += 0.5;
        ASSERT_EQ(bool(hit), at < 3000.0) << i;
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(glm::length(*hit - start) / glm::length(along), at, 0.51) << i;
        EXPECT_NEAR(hit->z, *ground.height(hit->x, hit->y), 1e-9);
    }
    EXPECT_GT(hits, 100);
    EXPECT_FALSE(ground.hit({600.0, 600.0, 60.0}, {0.0, 0.0, 1.0}));
    EXPECT_NEAR(ground.hit({601.0, 602.0, 99.0}, {0.0, 0.0, -2.0})->z, *ground.height(601.0, 602.0), 1e-9);
    const HeightPyramid cell({2, 2, {0.0, 0.0}, {9.0, 9.0}, std::vector<float>(4, 5.0f)});
    for (const glm::dvec3& along : {glm::dvec3(0.0, 0.0, -1.0), {0.5, 0.0, -1.0}, {-0.1, 0.3, -2.0}}) {
        const auto hit = cell.hit({4.0, 4.0, 7.0}, along);
        ASSERT_TRUE(hit) << "a single cell";
        EXPECT_NEAR(hit->z, 5.0, 1e-9);
    }
}

TEST(Drape, IsExactOnHillsCliffsAndLevelGround) {
    for (const auto& height : {hills, cliff, level}) {
        const HeightPyramid ground = groundOf(height, posts);
        int shadowed = 0;
        for (const House& house : houses(40, ground))
            for (const double elevation : {60.0, 30.0, 10.0}) {
                const Tally result = tally(ground, house, sunAt(37.0 * house.roof, elevation), 0.0);
                EXPECT_EQ(result.wrong, 0) << elevation;
                EXPECT_EQ(result.twice, 0) << elevation;
                shadowed += result.shadowed;
            }
        EXPECT_GT(shadowed, 3000);
    }
}

TEST(Drape, WithAnErrorInPlanNeverErrsByMoreAndTakesFewerTriangles) {
    const HeightPyramid ground = groundOf(hills, posts);
    std::size_t coarse = 0, fine = 0, exact = 0;
    int wrong = 0;
    for (const House& house : houses(60, ground))
        for (const double elevation : {60.0, 30.0}) {
            const glm::dvec3 sun = sunAt(37.0 * house.roof, elevation);
            for (const double error : {2.0, 0.1}) {
                const Tally result = tally(ground, house, sun, error);
                EXPECT_EQ(result.beyond, 0) << error << ", " << elevation;
                EXPECT_EQ(result.twice, 0);
                (error > 1.0 ? coarse : fine) += result.triangles;
                wrong += error > 1.0 ? result.wrong : 0;
            }
            exact += tally(ground, house, sun, 0.0).triangles;
        }
    EXPECT_GT(wrong, 0) << "else the bound is not tried";
    EXPECT_LT(double(coarse), 0.8 * double(exact));
    EXPECT_LE(fine, exact);
}

TEST(Drape, OnLevelGroundIsAHandfulOfTrianglesHoweverFineTheGrid) {
    const HeightPyramid ground = groundOf(level, posts);
    const House house{{640.0, 640.0}, {10.0, 6.0}, 0.3, 23.0};
    EXPECT_LE(tally(ground, house, sunAt(250.0, 30.0), 0.0).triangles, 40u);
}

TEST(Drape, EndsAtHolesAndBorders) {
    std::vector<float> heights(posts * posts, 0.0f);
    for (int j = 60; j < 70; ++j) heights[std::size_t(j * posts + 64)] = std::numeric_limits<float>::quiet_NaN();
    const HeightPyramid ground({posts, posts, {0.0, 0.0}, {pitch, pitch}, heights});
    const std::pair<House, double> cases[] = {{{{600.0, 650.0}, {6.0, 5.0}, 0.4, 20.0}, 265.0}, // east, into the hole
                                              {{{8.0, 600.0}, {6.0, 5.0}, 0.4, 20.0}, 85.0}};   // west, over the border
    for (const auto& [house, azimuth] : cases) {
        const Tally result = tally(ground, house, sunAt(azimuth, 20.0), 0.0);
        EXPECT_EQ(result.wrong, 0);
        EXPECT_GT(result.shadowed, 5);
    }
}

TEST(Drape, AHeightMayBeOffByLessTheNearerTheGroundIsToTheLight) {
    EXPECT_DOUBLE_EQ(gnomon::heightError(0.1, 0.5, 0.1), 0.04);
    EXPECT_EQ(gnomon::heightError(0.1, 0.5, 0.5), 0.0);
    EXPECT_EQ(gnomon::heightError(0.1, 0.5, 0.7), 0.0);
}

} // namespace
