// SPDX-License-Identifier: MIT
#include "BoxOnGround.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace gnomon::metrics;
using namespace gnomon::test;

constexpr double rounding = 1e-12;

Confusion of(const Picture& visibility, const Picture& lit) {
    TruthMaps truth;
    truth.litCentre = Mask(lit.width, lit.height);
    for (std::size_t i = 0; i < lit.cells.size(); ++i) truth.litCentre.cells[i] = lit.cells[i] >= 0.5;
    return confusion(visibility, truth, Mask(lit.width, lit.height, 1));
}

Picture checker(int phase) {
    return picture(10, 10, [=](int x, int y) { return double((x + y + phase) % 2); });
}

TEST(Visibility, IsTheShareOfTheWayFromShadowToLight) {
    const Picture a = picture(3, 1, [](int x, int) { return 0.2 + 0.3 * x; }); // 0.2 0.5 0.8
    const Visibility v = visibility(a, Picture(3, 1, 0.8), Picture(3, 1, 0.2));
    EXPECT_NEAR(v.value.at(0, 0), 0.0, rounding);
    EXPECT_NEAR(v.value.at(1, 0), 0.5, rounding);
    EXPECT_NEAR(v.value.at(2, 0), 1.0, rounding);
}

TEST(Visibility, IsNeverClamped) {
    const Picture a = picture(2, 1, [](int x, int) { return x ? 1.5 : -0.5; });
    const Visibility v = visibility(a, Picture(2, 1, 1.0), Picture(2, 1, 0.0));
    EXPECT_EQ(v.value.cells, std::vector<double>({-0.5, 1.5}));
}

TEST(Visibility, IsNotMeasuredWithoutContrastOrNumbers) {
    const Picture lit = picture(4, 1, [](int x, int) {
        return x == 0 ? 7.9 / 255 : x == 1 ? std::nan("") : 8.1 / 255;
    });
    Picture a = lit;
    a.at(2, 0) = std::numeric_limits<double>::infinity();
    const Visibility v = visibility(a, lit, Picture(4, 1, 0.0));
    EXPECT_EQ(v.lowContrast, 1u);
    EXPECT_EQ(v.notFinite, 2u);
    EXPECT_TRUE(std::isnan(v.value.at(0, 0)) && std::isnan(v.value.at(1, 0)) && std::isnan(v.value.at(2, 0)));
    EXPECT_EQ(v.value.at(3, 0), 1.0);
}

TEST(Confusion, OfACheckerAndItsOppositeIsTotal) {
    const Confusion c = of(checker(0), checker(1));
    EXPECT_EQ(c.misclassified(), 1.0);
    EXPECT_EQ(c.balancedError(), 1.0);
    EXPECT_EQ(c.intersectionOverUnion(), 0.0);
    EXPECT_EQ(of(checker(0), checker(0)).intersectionOverUnion(), 1.0);
}

TEST(Confusion, WorkedByHand) {
    const Picture truth = filled(Picture(10, 10, 1.0), 0, 0, 10, 2, 0.0); // 20 shadowed
    const Picture shown = filled(Picture(10, 10, 1.0), 0, 1, 10, 2, 0.0); // 10 right, 10 missed, 10 false
    const Confusion c = of(shown, truth);
    EXPECT_NEAR(c.misclassified().value(), 0.2, rounding);
    EXPECT_NEAR(c.falseShadowShare().value(), 0.125, rounding);
    EXPECT_NEAR(c.falseLitShare().value(), 0.5, rounding);
    EXPECT_NEAR(c.balancedError().value(), 0.3125, rounding);
    EXPECT_NEAR(c.intersectionOverUnion(), 1.0 / 3.0, rounding);
}

TEST(Confusion, OfEmptyAndFull) {
    const Picture lit(4, 4, 1.0), dark(4, 4, 0.0);
    EXPECT_EQ(of(lit, lit).intersectionOverUnion(), 1.0); // nothing there, nothing shown
    EXPECT_EQ(of(dark, dark).intersectionOverUnion(), 1.0);
    EXPECT_EQ(of(dark, lit).intersectionOverUnion(), 0.0);
    EXPECT_EQ(of(lit, dark).intersectionOverUnion(), 0.0);
    EXPECT_FALSE(of(lit, lit).falseLitShare()); // a share of no pixels
    EXPECT_EQ(of(dark, lit).balancedError(), 1.0);
    EXPECT_FALSE(Confusion().misclassified());
    EXPECT_FALSE(Confusion().balancedError());
}

TEST(Confusion, HalfVisibilityCountsAsLit) {
    EXPECT_EQ(of(Picture(1, 1, 0.5), Picture(1, 1, 1.0)).lit, 1u);
    EXPECT_EQ(of(Picture(1, 1, 0.49999), Picture(1, 1, 1.0)).falseShadow, 1u);
}

TEST(PixelSets, LeaveOutSilhouettesAndWrongIds) {
    TruthMaps truth = BoxOnGround().truth();
    const PixelSets sets = pixelSets(truth, truth.lit);
    const std::size_t around = 2 * (20 + 32), inside = 2 * (20 + 32) - 4; // both sides of the roof's edge
    EXPECT_EQ(count(sets.agreeing), 128 * 96 - around - inside);
    EXPECT_NEAR(sets.droppedShare, (around + inside) / (128.0 * 96.0), rounding);
    EXPECT_TRUE(sets.sound());
    truth.drawn = truth.receiver;
    truth.drawn.at(100, 10) = BoxOnGround::roof; // fighting depth
    EXPECT_EQ(count(pixelSets(truth, truth.lit).agreeing), count(sets.agreeing) - 5);
}

TEST(PixelSets, LeaveOutWhatIsDrawnInPlaceOfAnother) {
    TruthMaps truth = BoxOnGround().truth();
    truth.drawn = Grid<int>(128, 96, BoxOnGround::ground); // the roof is not drawn at all
    EXPECT_EQ(count(pixelSets(truth, truth.lit).agreeing), 128 * 96 - 20 * 32 - 2 * (20 + 32));
}

TEST(PixelSets, MoreThanFivePercentDroppedIsNotSound) {
    TruthMaps truth = BoxOnGround().truth();
    truth.drawn = truth.receiver;
    for (int x = 0; x < 128; ++x)
        for (int y = 80; y < 86; ++y) truth.drawn.at(x, y) = 7;
    const PixelSets sets = pixelSets(truth, truth.lit);
    EXPECT_GT(sets.droppedShare, 0.05);
    EXPECT_FALSE(sets.sound());
}

TEST(PixelSets, PartTheTerminatorAndLeaveOutBackFacesAndBackground) {
    TruthMaps truth = BoxOnGround().truth();
    truth.facing = picture(128, 96, [](int x, int) { return x < 32 ? -0.1 : x < 64 ? 0.05 : x < 96 ? 0.0501 : 0.0; });
    truth.receiver = Grid<int>(128, 96, 1);
    const PixelSets sets = pixelSets(truth, truth.lit);
    EXPECT_EQ(count(sets.agreeing), 128u * 96u);
    EXPECT_EQ(count(sets.terminator), 32u * 96u);
    EXPECT_EQ(count(sets.facing), 32u * 96u);
    EXPECT_EQ(count(sets.facing) - count(sets.certain), 32u); // column 70 has its edge
    truth.receiver = Grid<int>(128, 96, 0);
    EXPECT_EQ(count(pixelSets(truth, truth.lit).agreeing), 0u);
    EXPECT_EQ(pixelSets(truth, truth.lit).droppedShare, 0.0);
}

TEST(PixelSets, SelfShadowIsBlockedByItsOwnObjectWithinTwoEdges) {
    TruthMaps truth = BoxOnGround().truth();
    EXPECT_EQ(count(pixelSets(truth, truth.lit).selfShadowed), 0u);
    truth.blocker = Grid<int>(128, 96, BoxOnGround::ground);
    truth.edgeLength = Picture(128, 96, 0.25); // so that contact is within 2 edges
    EXPECT_EQ(count(pixelSets(truth, truth.lit).selfShadowed), BoxOnGround::contact);
    truth.blocker = Grid<int>(128, 96, 9);
    EXPECT_EQ(count(pixelSets(truth, truth.lit).selfShadowed), 0u);
}

TEST(IntensityError, OfAConstantErrorIsThatErrorAndPenumbraIsApart) {
    const Picture lit = picture(10, 1, [](int x, int) { return x < 4 ? 0.0 : x < 6 ? 0.5 : 1.0; });
    const Picture v = picture(10, 1, [&](int x, int) { return lit.at(x, 0) + (x == 4 || x == 5 ? 0.3 : -0.1); });
    const IntensityError e = intensityError(v, lit, Mask(10, 1, 1));
    EXPECT_NEAR(e.penumbra.value(), 0.3, rounding);
    EXPECT_NEAR(e.all.value(), std::sqrt((2 * 0.09 + 8 * 0.01) / 10), rounding);
    EXPECT_FALSE(intensityError(v, lit, Mask(10, 1, 0)).all);
}

TEST(IntensityError, AWideFilterWinsAgainstTheDiscAndLosesAgainstThePoint) {
    TruthMaps truth = BoxOnGround().truth();
    const Picture wide = picture(128, 96, [&](int x, int y) {
        return x > 1 && x < 126 ? (truth.lit.at(x - 2, y) + truth.lit.at(x, y) + truth.lit.at(x + 2, y)) / 3 : 1.0;
    });
    truth.litByDisc = wide;
    const ShadowMetrics m = measured(wide, truth);
    EXPECT_EQ(m.discSun.all, 0.0);
    EXPECT_GT(m.pointSun.all.value(), 0.01);
    EXPECT_FALSE(measured(wide).discSun.all); // without a disc in the truth
}

TEST(ThinIntensityError, APoleAQuarterPixelThinIsRightAtEveryPlaceOfItsPixel) {
    const Picture pole = picture(16, 16, [](int x, int) { return x == 8 ? 0.75 : 1.0; });
    const Picture hard = picture(16, 16, [](int x, int y) { return x == 8 && y % 4 == 0 ? 0.0 : 1.0; }); // by chance
    EXPECT_NEAR(thinIntensityError(hard, pole, Mask(16, 16, 1)).all.value(), 0.0, rounding);
    EXPECT_GT(intensityError(hard, pole, Mask(16, 16, 1)).all.value(), 0.1);
    const double lost = thinIntensityError(Picture(16, 16, 1.0), pole, Mask(16, 16, 1)).all.value();
    EXPECT_NEAR(lost, std::sqrt(4.0 / 13.0) / 16.0,
                rounding); // 4 of 13 columns of boxes hold the pole, each 1/16 of it
}

TEST(ThinIntensityError, LeavesOutBoxesThatAreNotWhollyInTheSetAndSmallPictures) {
    Mask half(16, 16, 1);
    for (int y = 0; y < 16; ++y) half.at(8, y) = 0;
    const Picture spoilt = picture(16, 16, [](int x, int) { return x == 8 ? std::nan("") : 1.0; });
    EXPECT_EQ(thinIntensityError(spoilt, Picture(16, 16, 1.0), half).all, 0.0);
    EXPECT_FALSE(thinIntensityError(Picture(3, 3), Picture(3, 3), Mask(3, 3, 1)).all);
}

TEST(ShadedError, IsOverPixelsAndChannels) {
    const Grid<glm::dvec3> truth(2, 2, glm::dvec3(0.5));
    Grid<glm::dvec3> shown = truth;
    shown.at(0, 0) = {0.8, 0.5, 0.5};
    EXPECT_NEAR(shadedError(shown, truth, Mask(2, 2, 1)).value(), std::sqrt(0.09 / 12), rounding);
    shown.at(1, 0) = glm::dvec3(std::nan(""));
    EXPECT_NEAR(shadedError(shown, truth, Mask(2, 2, 1)).value(), std::sqrt(0.09 / 9), rounding);
}

TEST(ShadowMetrics, ReportsTerminatorAndSelfShadowApart) {
    TruthMaps truth = BoxOnGround().truth();
    for (int x = 100; x < 128; ++x) truth.facing.at(x, 0) = 0.03;
    truth.blocker = Grid<int>(128, 96, BoxOnGround::ground);
    truth.edgeLength = Picture(128, 96, 0.25);
    const ShadowMetrics m = measured(Picture(128, 96, 0.0), truth);
    EXPECT_EQ(m.terminator.pixels(), 28u);
    EXPECT_EQ(m.terminator.falseShadow, 28u);
    EXPECT_EQ(m.selfShadowed.pixels(), BoxOnGround::contact);
    EXPECT_EQ(m.raw.pixels(), m.facing);
}

TEST(ShadowMetrics, AllLitOrAllShadowedAsItShouldBeIsNoCatastrophe) {
    for (const bool lit : {false, true}) {
        TruthMaps truth = BoxOnGround().truth();
        truth.litCentre = Mask(128, 96, lit);
        truth.lit = Picture(128, 96, lit);
        const ShadowMetrics m = measured(truth.lit, truth);
        EXPECT_FALSE(m.catastrophes.any());
        EXPECT_EQ(m.headline.intersectionOverUnion(), 1.0);
        EXPECT_FALSE(m.boundary);
    }
}

TEST(ShadowMetrics, RefusesGridsThatAreMissingOrOfAnotherSize) {
    const Picture v = perfect();
    for (const auto spoil : {+[](TruthMaps& t) { t.lit = {}; }, +[](TruthMaps& t) { t.receiver = {}; },
                             +[](TruthMaps& t) { t.drawn = Grid<int>(3, 3); },
                             +[](TruthMaps& t) { t.position = Grid<glm::dvec3>(96, 128); }}) {
        TruthMaps truth = BoxOnGround().truth();
        spoil(truth);
        EXPECT_THROW(measured(v, truth), std::invalid_argument);
    }
}

} // namespace
