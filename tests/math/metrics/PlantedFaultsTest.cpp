// SPDX-License-Identifier: MIT
// Faults planted in a true picture: each must land in its own column, at the size planted, and in no other.
#include "BoxOnGround.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace gnomon::test;
using namespace gnomon::metrics;

constexpr double rounding = 1e-12;

/// The seven numbers of the cause split, in the order of its members.
std::vector<std::size_t> causes(const ShadowMetrics& m) {
    return {m.causes.acne,    m.causes.halo,     m.causes.peterPanning, m.causes.leak,
            m.causes.erosion, m.causes.overDark, m.causes.overBright};
}

using Counts = std::vector<std::size_t>;

/// The five causes are all that is wrong, always.
void expectSum(const ShadowMetrics& m) {
    const CauseSplit& c = m.causes;
    EXPECT_EQ(c.acne + c.halo + c.peterPanning + c.leak + c.erosion, m.headline.falseShadow + m.headline.falseLit);
}

/// A true picture but for rows or columns that are fetched from elsewhere.
Picture shifted(int dx, int dy) {
    const Picture from = perfect();
    return picture(from.width, from.height,
                   [&](int x, int y) { return from.holds(x - dx, y - dy) ? from.at(x - dx, y - dy) : 1.0; });
}

Picture dilated() {
    const Picture from = perfect();
    return picture(from.width, from.height, [&](int x, int y) {
        double least = 1.0;
        for (int i = 0; i < 9; ++i)
            if (from.holds(x + i % 3 - 1, y + i / 3 - 1))
                least = std::min(least, from.at(x + i % 3 - 1, y + i / 3 - 1));
        return least;
    });
}

TEST(PlantedFaults, ATruePictureHasNoneAndEveryErrorIsZero) {
    const ShadowMetrics m = measured(perfect());
    EXPECT_EQ(causes(m), Counts({0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(m.headline.misclassified(), 0.0);
    EXPECT_EQ(m.raw.misclassified(), 0.0);
    EXPECT_EQ(m.headline.balancedError(), 0.0);
    EXPECT_EQ(m.headline.intersectionOverUnion(), 1.0);
    EXPECT_EQ(m.boundary.value().max, 0.0);
    EXPECT_EQ(m.pointSun.all, 0.0);
    EXPECT_FALSE(m.catastrophes.any());
    EXPECT_EQ(m.headline.shadow, BoxOnGround::shadowed);
    EXPECT_EQ(m.facing - m.certain, BoxOnGround::edge);
    EXPECT_EQ(m.causes.peterPanningShare, 0.0);
}

TEST(PlantedFaults, AShiftAlongTheAzimuthIsSeenByTheBoundaryAndTheRawCountAlone) {
    const ShadowMetrics m = measured(shifted(1, 0));
    EXPECT_EQ(causes(m), Counts({0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(m.headline.falseShadow + m.headline.falseLit, 0u); // the edge pixels take it
    EXPECT_EQ(m.raw.falseShadow, BoxOnGround::edge);
    EXPECT_NEAR(m.boundary.value().p95, 1.0, rounding);
    EXPECT_GT(m.boundary->signedMean, 0.3); // a third of the boundary is the far edge
}

TEST(PlantedFaults, AShiftAcrossIsHaloOnOneSideAndErosionOnTheOther) {
    const ShadowMetrics m = measured(shifted(0, 1));
    EXPECT_EQ(causes(m), Counts({0, 30, 6, 0, 23, 0, 0})); // of the lost row 6 of 29 pixels are at contact
    EXPECT_NEAR(m.boundary.value().p95, 1.0, rounding);
    EXPECT_NEAR(m.boundary->signedMean, 0.0, 0.02);
    expectSum(m);
}

TEST(PlantedFaults, DilationByAPixelIsHaloAllRound) {
    const ShadowMetrics m = measured(dilated());
    EXPECT_EQ(causes(m), Counts({0, 62, 0, 0, 0, 0, 0})); // rows 31 and 64, columns 40 to 70
    EXPECT_EQ(m.raw.falseShadow, 62 + BoxOnGround::edge);
    EXPECT_NEAR(m.boundary.value().p95, 1.0, 0.05); // about corners a square dilates by more
    EXPECT_NEAR(m.boundary->signedMean, m.boundary->mean, rounding);
    EXPECT_GT(m.boundary->mean, 0.75); // the far edge moves by 1/3 only: column 71 keeps 0.75
    expectSum(m);
}

TEST(PlantedFaults, DarkenedTwiceIsOverDarkAndNothingElse) {
    const ShadowMetrics m = measured(filled(perfect(), 50, 40, 10, 10, -0.5));
    EXPECT_EQ(causes(m), Counts({0, 0, 0, 0, 0, 100, 0}));
    EXPECT_EQ(m.headline.misclassified(), 0.0);
    EXPECT_EQ(m.boundary.value().max, 0.0);
    EXPECT_NEAR(m.pointSun.all.value(), std::sqrt(100 * 0.25 / static_cast<double>(m.facing)), rounding);
    EXPECT_EQ(measured(filled(perfect(), 90, 40, 5, 5, 1.2)).causes.overBright, 25u);
}

TEST(PlantedFaults, AHoleIsALeak) {
    const ShadowMetrics m = measured(filled(perfect(), 50, 44, 6, 6, 1.0));
    EXPECT_EQ(causes(m), Counts({0, 0, 0, 36, 0, 0, 0}));
    EXPECT_NEAR(m.headline.falseLitShare().value(), 36.0 / 928.0, rounding);
    EXPECT_NEAR(m.headline.intersectionOverUnion(), 892.0 / 928.0, rounding);
    EXPECT_NEAR(m.headline.balancedError().value(), 18.0 / 928.0, rounding);
    EXPECT_NEAR(m.boundary.value().signedMean, -m.boundary->mean, rounding); // inside the shadow all of it
    expectSum(m);
}

TEST(PlantedFaults, SpeckleIsAcne) {
    const ShadowMetrics m = measured(picture(128, 96, [from = perfect()](int x, int y) {
        return x >= 80 && x % 4 == 0 && y % 4 == 0 ? 0.0 : from.at(x, y);
    }));
    EXPECT_EQ(causes(m), Counts({12 * 24, 0, 0, 0, 0, 0, 0}));
    EXPECT_NEAR(m.causes.acneShare.value(), 288.0 / static_cast<double>(m.certain - 928), rounding);
    EXPECT_EQ(m.headline.falseLit, 0u);
    expectSum(m);
}

TEST(PlantedFaults, SpeckleBesideTheBoundaryOrInOnePieceWithItIsHalo) {
    EXPECT_EQ(causes(measured(filled(perfect(), 50, 65, 1, 1, 0.0))), Counts({0, 1, 0, 0, 0, 0, 0})); // 1.5 px away
    EXPECT_EQ(causes(measured(filled(perfect(), 50, 66, 1, 1, 0.0))), Counts({1, 0, 0, 0, 0, 0, 0})); // 2.5 px away
    EXPECT_EQ(causes(measured(filled(perfect(), 50, 64, 1, 9, 0.0))), Counts({0, 9, 0, 0, 0, 0, 0})); // a spike
}

TEST(PlantedFaults, ALiftedBaseIsPeterPanningByItsLengthInMetres) {
    const ShadowMetrics m = measured(filled(perfect(), 40, 32, 6, 32, 1.0)); // column 40 is not in R
    EXPECT_EQ(causes(m), Counts({0, 0, 160, 0, 0, 0, 0}));
    EXPECT_NEAR(m.causes.peterPanningShare.value(), 160.0 / 192.0, rounding);
    EXPECT_NEAR(m.causes.gap.value(), 5 * 0.05, rounding);
    expectSum(m);
}

TEST(PlantedFaults, AMissingCasterIsACatastropheAndHasNoBoundary) {
    const ShadowMetrics m = measured(Picture(128, 96, 1.0));
    EXPECT_EQ(causes(m), Counts({0, 0, 192, 0, 736, 0, 0}));
    EXPECT_EQ(m.headline.intersectionOverUnion(), 0.0);
    EXPECT_EQ(m.headline.falseLitShare(), 1.0);
    EXPECT_FALSE(m.boundary);
    EXPECT_TRUE(m.catastrophes.allLit);
    EXPECT_TRUE(m.catastrophes.lostShadow);
    EXPECT_FALSE(m.catastrophes.allShadowed);
    expectSum(m);
}

TEST(PlantedFaults, AllBlackIsACatastrophe) {
    const ShadowMetrics m = measured(Picture(128, 96, 0.0));
    EXPECT_TRUE(m.catastrophes.allShadowed);
    EXPECT_TRUE(m.catastrophes.lostShadow); // 928 of some 12000
    EXPECT_FALSE(m.catastrophes.allLit);
    EXPECT_EQ(m.headline.falseShadowShare(), 1.0);
    EXPECT_EQ(m.headline.falseLitShare(), 0.0);
    EXPECT_FALSE(m.boundary);
    expectSum(m);
}

TEST(PlantedFaults, HalfAPixelOfCameraErrorIsHalfAPixelOfBoundary) {
    const TruthMaps seen = BoxOnGround{{0.5, 0.5}}.truth();
    TruthMaps truth = BoxOnGround().truth();
    truth.drawn = seen.receiver;
    const ShadowMetrics m = measured(seen.lit, truth);
    EXPECT_NEAR(m.boundary.value().p95, 0.5, 0.01);
    EXPECT_NEAR(m.boundary->mean, (58 * 0.5 + 32 / 3.0) / 90, 0.01); // 4 x 4 rays put the far edge 1/3 px off, not 1/2
    EXPECT_LT(m.headline.misclassified().value(), 0.01);             // the count hardly sees it
    EXPECT_FALSE(m.catastrophes.any());
    EXPECT_TRUE(m.sound);
}

/// Surfaces of 20 x 20 px that are turned away by 60 degrees: a solid's side, and a single sheet, of which a body beyond it shadows
/// the right half. Of these 16 x 16, and twice 6 x 16, lie more than two from an edge.
TEST(PlantedFaults, WhatIsTurnedAwayIsDarkAndASingleSheetsBackIsAsLitAsWhatIsBeyondItLeavesIt) {
    TruthMaps truth = BoxOnGround().truth();
    const auto turnAway = [&truth](int x, int y, int w, double blockerDistance) {
        truth.lit = filled(truth.lit, x, y, w, 20, 0.0);
        truth.facing = filled(truth.facing, x, y, w, 20, -0.5);
        truth.blockerDistance = filled(truth.blockerDistance, x, y, w, 20, blockerDistance);
        for (int v = y; v < y + 20; ++v)
            for (int u = x; u < x + w; ++u) truth.litCentre.at(u, v) = 0;
    };
    turnAway(80, 10, 20, 0.4);
    turnAway(80, 40, 10, 0.0);
    turnAway(90, 40, 10, 0.4);
    const auto wrong = [&truth](const Picture& shown) { return measured(shown, truth).turnedAwayWrong; };
    const Picture right = filled(truth.lit, 80, 40, 10, 20, 1.0);
    EXPECT_EQ(wrong(right), 0u);
    EXPECT_EQ(wrong(filled(right, 80, 10, 20, 20, 1.0)), 16u * 16u);
    EXPECT_EQ(wrong(filled(right, 80, 40, 10, 20, 0.0)), 6u * 16u);
    EXPECT_EQ(wrong(filled(right, 90, 40, 10, 20, 1.0)), 6u * 16u);
    EXPECT_EQ(wrong(filled(right, 88, 40, 3, 20, 0.5)), 0u); // the shadow's edge on the sheet
}

/// A body of 20 x 20 px that its shading lights by a half, its facets turned away from the light: all of it may be bright, and a
/// shadow on 10 x 10 px of it is 100 teeth. Beside it, light that is too faint, or a shadow too faint, makes none.
TEST(PlantedFaults, WhatAConvexBodysOwnShadowDarkensIsTeeth) {
    TruthMaps truth = BoxOnGround().truth();
    EXPECT_EQ(measured(perfect(), truth).teeth, std::nullopt);
    truth.smoothLight = filled(Picture(BoxOnGround::width, BoxOnGround::height), 90, 10, 20, 20, 0.5);
    truth.facing = filled(truth.facing, 90, 10, 20, 20, -0.1);
    truth.lit = filled(truth.lit, 90, 10, 20, 20, 0.0);
    const auto of = [&truth](const Picture& shown) { return measured(shown, truth); };
    EXPECT_EQ(of(perfect()).teeth, 0u);
    EXPECT_EQ(of(perfect()).turnedAwayWrong, 0u);
    EXPECT_EQ(of(filled(perfect(), 95, 15, 10, 10, 0.0)).teeth, 100u);
    EXPECT_EQ(of(filled(perfect(), 95, 15, 10, 10, 1.0 - 2.0 * 7.9 / 255.0)).teeth, 0u);
    EXPECT_EQ(of(filled(perfect(), 95, 15, 10, 10, 1.0 - 2.0 * 8.1 / 255.0)).teeth, 100u);
    EXPECT_EQ(of(filled(perfect(), 60, 10, 10, 10, 0.0)).teeth, 0u); // of the ground
    truth.smoothLight = filled(truth.smoothLight, 90, 10, 20, 20, 0.03);
    EXPECT_EQ(of(filled(perfect(), 95, 15, 10, 10, 0.0)).teeth, 0u);
}

TEST(PlantedFaults, PixelsThatAreNoNumbersAreCountedAndInNoAverage) {
    Picture broken = perfect();
    broken.at(90, 20) = std::nan("");
    broken.at(100, 20) = std::numeric_limits<double>::infinity();
    const ShadowMetrics m = measured(broken), whole = measured(perfect());
    EXPECT_EQ(m.catastrophes.notFinite, 2u);
    EXPECT_TRUE(m.catastrophes.any());
    EXPECT_EQ(m.unmeasured, 2u);
    EXPECT_EQ(m.certain, whole.certain - 2);
    EXPECT_EQ(m.headline.misclassified(), 0.0);
    EXPECT_EQ(m.pointSun.all, 0.0);
    EXPECT_EQ(m.boundary.value().max, 0.0);
}

} // namespace
