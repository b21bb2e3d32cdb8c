// SPDX-License-Identifier: MIT
// How far fans are off a grid's ground, in closed form.
#include <gnomon/FanGap.h>
#include <gtest/gtest.h>

using gnomon::FanGap;
using gnomon::HeightField;

namespace {

/// Over x from 0 to 20, where the middle of three posts is `middle` high and the others are 0; the same for all y from 0 to 20.
HeightField fold(float middle) {
    return {3, 3, {0.0, 0.0}, {10.0, 10.0}, {0.0f, middle, 0.0f, 0.0f, middle, 0.0f, 0.0f, middle, 0.0f}};
}

/// From x = 4 to 16, level; its corners are on the ground of a fold of 5 or -5.
std::vector<glm::dvec3> level(double height) {
    return {{4.0, 2.0, height}, {16.0, 2.0, height}, {16.0, 8.0, height}, {4.0, 8.0, height}};
}

} // namespace

/// The crest is 3 over the fan's corners.
TEST(FanGap, OfALevelFanAcrossARidgeIsBelowAndAcrossAValleyAbove) {
    const HeightField ridge = fold(5.0f), valley = fold(-5.0f);
    FanGap gap;
    gap.begin(ridge, level(2.0));
    gap.take({10.0, 2.0, 5.0});
    EXPECT_DOUBLE_EQ(gap.below(), 3.0);
    EXPECT_DOUBLE_EQ(gap.above(), 0.0);
    gap.begin(valley, level(-2.0));
    gap.take({10.0, 8.0, -5.0});
    EXPECT_DOUBLE_EQ(gap.below(), 0.0);
    EXPECT_DOUBLE_EQ(gap.above(), 3.0);
}

/// Triangles 0 1 2 in the plane z = x / 2 and 0 2 3 in z = y / 2, over a level ground: at each place its own.
TEST(FanGap, TakesEachPlacesOwnTriangle) {
    const HeightField ground = fold(0.0f);
    FanGap gap;
    const std::vector<glm::dvec3> bent = {{0.0, 0.0, 0.0}, {8.0, 0.0, 4.0}, {8.0, 8.0, 4.0}, {0.0, 8.0, 4.0}};
    gap.begin(ground, bent);
    gap.take({6.0, 2.0, 0.0});
    EXPECT_DOUBLE_EQ(gap.above(), 3.0);
    gap.begin(ground, bent);
    gap.take({1.0, 5.0, 0.0});
    EXPECT_DOUBLE_EQ(gap.above(), 2.5);
}

/// All corners, and all places where edges cross the crest, are on the ground: but the edge within the fan goes from 2 to 2
/// below the crest's 5.
TEST(FanGap, IsSeenWhereTheFansTrianglesMeet) {
    const HeightField ridge = fold(5.0f);
    FanGap gap;
    gap.begin(ridge, {{4.0, 2.0, 2.0}, {10.0, 2.0, 5.0}, {16.0, 8.0, 2.0}, {10.0, 8.0, 5.0}});
    gap.take({10.0, 2.0, 5.0});
    gap.take({10.0, 8.0, 5.0});
    EXPECT_NEAR(gap.below(), 0.0, 1e-12);
    gap.takeInnerEdges();
    EXPECT_NEAR(gap.below(), 3.0, 1e-12);
    EXPECT_NEAR(gap.above(), 0.0, 1e-12);
}

/// A post at (10, 10) of height 4 alone: a cell's diagonal, which rises, goes down from there to 0 at (20, 20).
TEST(FanGap, IsSeenOnDiagonals) {
    for (const gnomon::CellCut cut : {gnomon::CellCut::rising, gnomon::CellCut::falling}) {
        const bool rises = cut == gnomon::CellCut::rising;
        std::vector<float> heights(9, 0.0f);
        heights[rises ? 4 : 5] = 4.0f; // of the cell from (10, 10) to (20, 20), the lower left or right post
        const HeightField ground(3, 3, {0.0, 0.0}, {10.0, 10.0}, heights, 0.0, std::vector<gnomon::CellCut>(4, cut));
        FanGap gap;
        // Its inner edge goes over the middle of the cell, where the diagonal is 2 high, and is 1 there.
        gap.begin(
            ground,
            rises
                ? std::vector<glm::dvec3>{{16.0, 14.0, 1.0}, {16.0, 16.0, 1.0}, {14.0, 16.0, 1.0}, {14.0, 14.0, 1.0}}
                : std::vector<glm::dvec3>{{14.0, 14.0, 1.0}, {16.0, 14.0, 1.0}, {16.0, 16.0, 1.0}, {14.0, 16.0, 1.0}});
        gap.takeInnerEdges();
        EXPECT_NEAR(gap.below(), 1.0, 1e-12);
    }
}

/// Of an arrowhead whose notch is its first corner all corners are seen from there, more than half around.
TEST(FanGap, IsNotKnownOfAFanThatGoesHalfAroundItsFirstCorner) {
    const HeightField ground = fold(0.0f);
    FanGap gap;
    gap.begin(ground, {{5.0, 5.0, 0.0}, {2.0, 2.0, 0.0}, {15.0, 5.0, 0.0}, {2.0, 8.0, 0.0}});
    EXPECT_FALSE(gap.isKnown());
    gap.begin(ground, {{15.0, 5.0, 0.0}, {2.0, 8.0, 0.0}, {5.0, 5.0, 0.0}, {2.0, 2.0, 0.0}});
    EXPECT_TRUE(gap.isKnown());
}
