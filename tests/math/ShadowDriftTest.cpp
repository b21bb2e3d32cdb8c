// SPDX-License-Identifier: MIT
// How far shadows that are kept are known to be off, against where corners fall by hand.
#include "Houses.h"

#include <gnomon/onterrain/ShadowDrift.h>
#include <gtest/gtest.h>

#include <array>

using gnomon::HeightPyramid;
using gnomon::PackedParts;
using gnomon::PackedShadows;
using gnomon::ShadowDrift;
using gnomon::TerrainMethod;

namespace {

constexpr double rounding = 1e-3; // floats of up to 1600 m about the origin
constexpr int posts = 160;

/// Metres in plan a metre of height, towards +x.
glm::dvec4 sunOf(double shift) { return glm::dvec4(-shift, 0.0, 1.0, 0.0); }

/// A house, and three huts far from it, 1 m high.
PackedParts withHuts(const test::Prism& house) {
    std::vector<gnomon::ConvexPart> parts = house.parts();
    for (const double y : {300.0, 320.0, 340.0})
        for (const gnomon::ConvexPart& hut : test::boxAt({200.0, y}, {2.0, 2.0}, 0.0, -5.0, 1.0).parts())
            parts.push_back(hut);
    return PackedParts(parts);
}

/// Of 4 by 4 m on level ground.
PackedParts towersAt(const std::vector<std::pair<glm::dvec2, double>>& placesAndHeights) {
    std::vector<gnomon::ConvexPart> parts;
    for (const auto& [place, height] : placesAndHeights)
        for (const gnomon::ConvexPart& part : test::boxAt(place, {2.0, 2.0}, 0.0, -5.0, height).parts())
            parts.push_back(part);
    return PackedParts(parts);
}

/// A tower of 4 by 4 m about x.
PackedParts towerAt(double x, double base, double height) {
    return withHuts(test::boxAt({x, 700.0}, {2.0, 2.0}, 0.0, base - 5.0, base + height));
}

/// A town's shadows, followed from `shift` on.
struct Followed {
    Followed(const HeightPyramid& on, const PackedParts& of, double shift) : ground(on), parts(of) {
        gnomon::packedShadows(ground, parts, sunOf(shift), TerrainMethod::hull, 0.1, glm::dvec3(0.0), shown);
        followed.begin(ground, parts, shown, sunOf(shift));
    }
    double offBy(double shift) const { return followed.offBy(sunOf(shift)); }
    double seenBy(double shift, double most) { return seenBy(shift, most, most); }
    double seenBy(double shift, double late, double most) {
        const double off = followed.look(ground, parts, shown, sunOf(shift), TerrainMethod::hull, 0.1, late, most);
        EXPECT_EQ(off, offBy(shift));
        return off;
    }
    const HeightPyramid& ground;
    const PackedParts parts;
    PackedShadows shown;
    ShadowDrift followed;
};

/// Level at 0 as far as x = 490, from x = 520 on 109.9 m lower, between them steeper than light at 45 degrees.
double brink(double x, double) { return x < 495.0 ? 0.0 : x < 505.0 ? -9.9 : x < 515.0 ? -59.9 : -109.9; }

/// Level at 0 as far as x = 500, nothing as far as x = 520, level 100 m lower.
double gap(double x, double) { return x < 505.0 ? 0.0 : x < 515.0 ? std::nan("") : -100.0; }

/// Level at 0 as far as x = 500, there 100 m down on two cells, level again.
double crest(double x, double) { return -std::clamp(5.0 * (x - 500.0), 0.0, 100.0); }

} // namespace

/// A corner h over level ground falls h times the shift away.
TEST(ShadowDrift, OnLevelGroundAreOffByWhatTheirHeightMakesThem) {
    const HeightPyramid level = test::groundOf([](double, double) { return 0.0; }, posts);
    Followed town(level, towerAt(400.0, 0.0, 40.0), 1.0);
    EXPECT_EQ(town.offBy(1.0), 0.0);
    EXPECT_NEAR(town.offBy(1.005), 40.0 * 0.005, rounding);
    EXPECT_NEAR(town.seenBy(1.005, 0.1), 40.0 * 0.005, rounding);
    EXPECT_NEAR(town.offBy(1.01), 40.0 * 0.01, rounding) << "what it was off by, and what it moved by since";
    EXPECT_NEAR(town.offBy(1.0), 40.0 * 0.01, rounding) << "which way it moved nobody knows";
}

/// Under the sun that it was found with a shadow is right, as a look would say; without one it is not known which way it went.
TEST(ShadowDrift, OfWhichOneIsLateAreLookedAtNoMoreUntilThatMayBeTooMuch) {
    const HeightPyramid level = test::groundOf([](double, double) { return 0.0; }, posts);
    Followed town(level, towerAt(400.0, 0.0, 40.0), 1.0);
    EXPECT_NEAR(town.seenBy(1.005, 0.1, 1.0), 40.0 * 0.005, rounding);
    EXPECT_NEAR(town.seenBy(1.0, 0.1, 1.0), 2.0 * 40.0 * 0.005, rounding);
    EXPECT_NEAR(town.seenBy(1.0, 0.1, 0.3), 0.0, rounding) << "which it may be now";
}

/// Two towers before the crest have no bound, two that are higher have one.
TEST(ShadowDrift, AreOffByNoLessThanThoseThatAreNotLookedAt) {
    const HeightPyramid ground = test::groundOf(crest, posts);
    Followed town(
        ground,
        towersAt({{{200.0, 300.0}, 50.0}, {{453.0, 700.0}, 40.0}, {{453.0, 800.0}, 40.0}, {{200.0, 320.0}, 50.0}}),
        1.0);
    EXPECT_GT(town.offBy(1.001), 1e9);
    EXPECT_NEAR(town.seenBy(1.001, 0.1), 50.0 * 0.001, rounding);
}

/// Had any been looked at, it would not be known which way it went.
TEST(ShadowDrift, AreNotLookedAtWhereOfTheOthersTooLittleIsKnown) {
    const HeightPyramid level = test::groundOf([](double, double) { return 0.0; }, posts);
    Followed town(level, towersAt({{{400.0, 300.0}, 40.0}, {{400.0, 500.0}, 40.0}, {{400.0, 700.0}, 40.0}}), 1.0);
    EXPECT_NEAR(town.seenBy(1.005, 0.1), 40.0 * 0.005, rounding);
    EXPECT_EQ(town.offBy(1.0), 0.0);
}

/// Before a crest, from where on the ground falls as steeply as light; the tip stays 5 m before it.
TEST(ShadowDrift, BesideGroundThatIsAsSteepAsTheLightAreOffByLittleOnceTheyWereLookedAt) {
    const HeightPyramid ground = test::groundOf(crest, posts);
    Followed town(ground, towerAt(453.0, 0.0, 40.0), 1.0);
    EXPECT_GT(town.offBy(1.0001), 1e9);
    EXPECT_NEAR(town.seenBy(1.0001, 0.1), 40.0 * 0.0001, rounding);
    EXPECT_NEAR(town.seenBy(1.001, 0.1), 40.0 * 0.001, rounding) << "from where it is shown";
    EXPECT_GT(town.offBy(1.002), 1e9);
}

/// Over the crest the tip falls on from there, 100 m down, and at least 80 m on.
TEST(ShadowDrift, ThatLeapOverACrestAreOffByMoreThanTheLeap) {
    const HeightPyramid ground = test::groundOf(crest, posts);
    Followed town(ground, towerAt(458.0, 0.0, 39.95), 1.0);
    EXPECT_GT(town.seenBy(1.01, 0.1), 80.0);
}

TEST(ShadowDrift, AreNotLookedAtWhereMostWouldHaveToBe) {
    const HeightPyramid level = test::groundOf([](double, double) { return 0.0; }, posts);
    Followed town(level, towerAt(400.0, 0.0, 40.0), 1.0);
    EXPECT_GT(town.seenBy(2.0, 0.1), 1e9);
}

/// A plate's ray clears the brink by 1 cm and lands 100 m beyond; soon it meets the brink, of which its shadow tells nothing.
TEST(ShadowDrift, OfWhatFloatsHaveABoundByAllTheGroundThatItsRaysPass) {
    const HeightPyramid ground = test::groundOf(brink, posts);
    const Followed town(ground, withHuts(test::boxAt({445.0, 700.0}, {5.0, 5.0}, 0.0, 50.11, 51.0)), 1.0);
    ASSERT_GT(town.shown[0].cornerCount, 0u);
    EXPECT_GT(town.offBy(0.9996), 1e9);
    EXPECT_GT(gnomon::movedAtMost(town.shown, sunOf(1.0), sunOf(0.9996)), 1e9);
}

/// The same plate, held up from where its shadow lies.
TEST(ShadowDrift, OfWhatLeansHaveABoundByAllTheGroundThatItsRaysPass) {
    const HeightPyramid ground = test::groundOf(brink, posts);
    std::vector<glm::dvec3> corners;
    for (const auto& [x, half, base, top] : {std::array{445.0, 5.0, 50.11, 51.0}, {625.0, 2.0, -115.0, -109.0}})
        for (int k = 0; k < 8; ++k)
            corners.emplace_back(k & 1 ? x + half : x - half, k & 2 ? 700.0 + half : 700.0 - half, k & 4 ? top : base);
    const Followed town(ground, PackedParts({{*gnomon::convexHull(corners), std::nullopt}}), 1.0);
    ASSERT_GT(town.shown[0].cornerCount, 0u);
    EXPECT_GT(town.offBy(0.9996), 1e9);
    EXPECT_GT(gnomon::movedAtMost(town.shown, sunOf(1.0), sunOf(0.9996)), 1e9);
}

/// The tip is 3 cm before the hole.
TEST(ShadowDrift, BesideAHoleHaveNoBound) {
    const HeightPyramid ground = test::groundOf(gap, posts);
    const Followed town(ground, towerAt(487.97, 0.0, 10.0), 1.0);
    ASSERT_GT(town.shown[0].cornerCount, 0u);
    EXPECT_GT(town.offBy(1.005), 1e9);
}
