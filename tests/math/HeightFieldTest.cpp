// SPDX-License-Identifier: MIT
// Heights and rays on a regular grid.
#include <support/TerrainTrial.h>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <tuple>

using gnomon::HeightField;
using gnomon::HeightPyramid;
using test::groundOf;
using test::hills;

namespace {

constexpr int posts = 160;

TEST(HeightField, IsWhatItsPostsSayAndNothingBesideThemOrInHoles) {
    std::vector<float> heights{0, 1, 2, 3, 5, 7, 4, 8, std::numeric_limits<float>::quiet_NaN()};
    const HeightField ground({3, 3, {10.0, 20.0}, {2.0, 4.0}, 100.0}, heights);
    EXPECT_DOUBLE_EQ(*ground.height(10.0, 20.0), 100.0);
    EXPECT_DOUBLE_EQ(*ground.height(12.0, 22.0), 103.0);
    EXPECT_DOUBLE_EQ(*ground.height(11.0, 22.0), 102.5) << "on the diagonal";
    EXPECT_DOUBLE_EQ(*ground.height(11.5, 21.0), 100.0 + 0.75 * 1.0 + 0.25 * 4.0) << "right of it";
    EXPECT_DOUBLE_EQ(*ground.height(10.5, 23.0), 100.0 + 0.75 * 3.0 + 0.25 * 2.0) << "left of it";
    EXPECT_FALSE(ground.height(13.0, 26.0)) << "a hole";
    EXPECT_TRUE(ground.height(13.0, 22.0));
    EXPECT_FALSE(ground.height(9.999, 22.0));
    EXPECT_FALSE(ground.height(std::nan(""), 22.0));
    EXPECT_THROW(HeightField({1, 3, {}, {1.0, 1.0}}, {1, 2, 3}), std::invalid_argument);
    EXPECT_THROW(HeightField({2, 2, {}, {1.0, 1.0}}, {1, 2, 3}), std::invalid_argument);
    EXPECT_THROW(HeightField({2, 2, {}, {1.0, 0.0}}, {1, 2, 3, 4}), std::invalid_argument);
}

TEST(HeightPyramid, TellsOfAHoleInAnyRectangleThatHoldsOne) {
    std::vector<float> heights(9 * 9, 1.0f);
    heights[9 * 4 + 4] = std::numeric_limits<float>::quiet_NaN(); // the cells of columns and rows 3 and 4
    const HeightPyramid ground({{9, 9, {0.0, 0.0}, {1.0, 1.0}}, heights});
    for (const auto& [low, high, holds] :
         {std::tuple(0.0, 8.0, true), {2.5, 3.5, true}, {2.5, 5.5, true}, {0.5, 2.5, false}, {5.5, 7.5, false}}) {
        const auto range = ground.range(glm::dvec2(low), glm::dvec2(high));
        ASSERT_TRUE(range) << low;
        EXPECT_EQ(range->holes, holds) << low << " to " << high;
    }
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
    const HeightPyramid cell({{2, 2, {0.0, 0.0}, {9.0, 9.0}}, std::vector<float>(4, 5.0f)});
    for (const glm::dvec3& along : {glm::dvec3(0.0, 0.0, -1.0), {0.5, 0.0, -1.0}, {-0.1, 0.3, -2.0}}) {
        const auto hit = cell.hit({4.0, 4.0, 7.0}, along);
        ASSERT_TRUE(hit) << "a single cell";
        EXPECT_NEAR(hit->z, 5.0, 1e-9);
    }
}

} // namespace
