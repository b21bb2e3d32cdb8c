// SPDX-License-Identifier: MIT
#include "BoxOnGround.h"

#include <gtest/gtest.h>

#include <metrics/Flicker.h>

#include <cmath>

namespace {

using namespace gnomon::metrics;
using namespace gnomon::test;

FlickerFrame frameOf(const BoxOnGround& scene, const Picture& visibility) {
    FlickerFrame frame;
    frame.visibility = visibility;
    frame.truth = scene.truth();
    frame.facing = pixelSets(frame.truth, visibility).facing;
    frame.clipFromPosition = scene.clipFromPosition();
    return frame;
}

/// As a perfect renderer draws it, with smooth or with hard edges.
FlickerFrame trueFrame(const BoxOnGround& scene, bool hard = false) {
    const TruthMaps truth = scene.truth();
    const auto centre = [&](int x, int y) { return double(truth.litCentre.at(x, y)); };
    return frameOf(scene, hard ? picture(BoxOnGround::width, BoxOnGround::height, centre) : truth.lit);
}

TEST(Flicker, OfAStillSequenceIsZero) {
    FlickerMeter meter;
    for (int k = 0; k < 4; ++k) meter.add(trueFrame({}));
    EXPECT_EQ(meter.energy(), 0.0);
    EXPECT_EQ(meter.share(), 0.0);
    EXPECT_EQ(meter.crawl(), 0.0);
}

TEST(Flicker, OfACrawlingEdgeIsItsPixelsEachFrame) {
    const Picture still = perfect(), longer = filled(still, 70, 32, 2, 32, 0.0); // 2 px in, 2 px out, every frame
    FlickerMeter meter;
    for (int k = 0; k < 5; ++k) meter.add(frameOf({}, k % 2 ? longer : still));
    const double facing = static_cast<double>(count(frameOf({}, still).facing));
    EXPECT_NEAR(meter.energy().value(), (0.75 * 32 + 1.0 * 32) / facing, 1e-12);
    EXPECT_NEAR(meter.share().value(), 64 / facing, 1e-12);
    const double offset = measured(longer).boundary.value().signedMean; // in 2 frames of 5; 0 in the others
    EXPECT_NEAR(meter.crawl().value(), offset * std::sqrt(0.4 * 0.6), 1e-12);
    EXPECT_GT(offset, 0.5); // a third of the boundary moves by 1.83 px
}

TEST(Flicker, SmallChangesCountAsEnergyOnly) {
    const Picture still = perfect(), dimmer = filled(still, 90, 10, 10, 10, 0.8);
    FlickerMeter meter;
    meter.add(frameOf({}, still));
    meter.add(frameOf({}, dimmer));
    EXPECT_NEAR(meter.energy().value() * static_cast<double>(count(frameOf({}, still).facing)), 100 * 0.2, 1e-9);
    EXPECT_EQ(meter.share(), 0.0);
    EXPECT_EQ(meter.crawl(), 0.0);
}

TEST(Flicker, TheTruthsOwnMotionIsTakenOff) {
    for (const bool hard : {false, true})
        for (const double step : {0.125, 1.0}) {
            FlickerMeter meter;
            for (int k = 0; k < 9; ++k) meter.add(trueFrame({{}, step * k}, hard));
            EXPECT_EQ(meter.energy(), 0.0) << hard << ' ' << step;
        }
}

TEST(Flicker, AnEdgeBesideTheTruthsThatMovesWithItIsStill) {
    FlickerMeter meter;
    for (int k = 0; k < 5; ++k) meter.add(frameOf({{}, 1.0 * k}, BoxOnGround{{}, 1.0 * k + 1.0}.truth().lit));
    EXPECT_EQ(meter.energy(), 0.0);
}

TEST(Flicker, AShadowThatLagsBehindTheTruthFlickers) {
    FlickerMeter meter;
    for (int k = 0; k < 9; ++k) meter.add(frameOf({{}, 1.0 * k}, trueFrame({{}, k < 8 ? 0.0 : 8.0}).visibility));
    EXPECT_GT(meter.share().value(), 0.0); // it jumps by 8 px when the truth moves by 1
}

TEST(Flicker, AMovingCameraSeesAStillShadow) {
    FlickerMeter whole, part;
    for (int k = 0; k < 5; ++k) {
        whole.add(trueFrame({glm::dvec2(3.0 * k, k)}));
        part.add(trueFrame({glm::dvec2(0.3, 0.2) * double(k)}));
    }
    EXPECT_EQ(whole.energy(), 0.0);
    EXPECT_EQ(whole.share(), 0.0);
    EXPECT_LT(part.share().value(), 1e-12);
    EXPECT_LT(part.crawl().value(), 0.02); // what a shadow's edge may crawl when the camera moves
}

TEST(Flicker, AShadowThatGoesWithTheCameraFlickers) {
    FlickerMeter meter;
    for (int k = 0; k < 5; ++k) meter.add(frameOf({glm::dvec2(3.0 * k, 0.0)}, perfect()));
    EXPECT_GT(meter.share().value(), 0.005);
    EXPECT_GT(meter.crawl().value(), 0.5);
    EXPECT_GT(meter.crawlBeyondRays().value(), 0.1); // less: its two sides crawl in opposite directions
}

/// The camera goes on by eighths of a pixel, over whole pixels.
template <typename FrameOf>
FlickerMeter creeping(FrameOf frameOf) {
    FlickerMeter meter;
    for (int k = 0; k < 16; ++k) meter.add(frameOf(BoxOnGround{glm::dvec2(0.125 * k, 0.0)}));
    return meter;
}

TEST(Flicker, ThePictureOfRaysCrawlsAndNothingOfItIsBeyondRays) {
    const FlickerMeter meter = creeping([](const BoxOnGround& scene) { return trueFrame(scene, true); });
    EXPECT_GT(meter.crawl().value(), 0.02);
    EXPECT_GT(meter.rayCrawl().value(), 0.02);
    EXPECT_EQ(meter.crawlBeyondRays(), 0.0);
}

TEST(Flicker, ASmoothEdgeThatStandsStillHasNoCrawlAtAll) {
    const FlickerMeter meter = creeping([](const BoxOnGround& scene) { return trueFrame(scene); });
    EXPECT_GT(meter.rayCrawl().value(), 0.02);
    EXPECT_LT(meter.crawlBeyondRays().value(), 1e-9); // the truth against itself
}

/// Half a pixel beside the true edge, it turns its pixels in other frames than rays do.
TEST(Flicker, AHardEdgeThatStandsStillBesideTheTrueOneHasNoCrawlBeyondRays) {
    const FlickerMeter meter = creeping([](const BoxOnGround& scene) {
        const FlickerFrame beside = trueFrame({scene.camera, 0.5}, true);
        return frameOf(scene, beside.visibility);
    });
    EXPECT_GT(meter.crawl().value(), 0.02);
    EXPECT_LT(meter.crawlBeyondRays().value(), 0.02);
}

/// The shadow's end, a third of the outline, swims by half a pixel: less than the rays' own crawl hides.
TEST(Flicker, ASmoothEdgeThatSwimsCrawlsBeyondRays) {
    int frame = 0;
    const FlickerMeter meter = creeping([&frame](const BoxOnGround& scene) {
        return frameOf(scene, BoxOnGround{scene.camera, ++frame % 2 ? 0.0 : 0.5}.truth().lit);
    });
    EXPECT_GT(meter.crawlBeyondRays().value(), 0.05); // 0.25 px to either side, a third of that
}

/// As one side gains, the other loses: by a pixel, every other frame.
TEST(Flicker, AShadowThatSwimsSidewaysCrawlsAsFarOnBothSides) {
    int frame = 0;
    const FlickerMeter meter = creeping([&frame](const BoxOnGround& scene) {
        return frameOf(scene, BoxOnGround{scene.camera + glm::dvec2(0.0, ++frame % 2 ? 0.0 : 1.0)}.truth().lit);
    });
    EXPECT_NEAR(meter.crawlBeyondRays().value(), 0.5 * std::sqrt(60.0 / 92.0), 0.05); // the sides are 30 px each of 92
}

TEST(Flicker, KeepsTheTwoFramesBetweenWhichMostChanged) {
    const Picture still = perfect(), little = filled(still, 90, 10, 2, 2, 0.0),
                  much = filled(little, 90, 20, 5, 5, 0.4);
    FlickerMeter meter;
    meter.add(frameOf({}, still));
    EXPECT_TRUE(meter.worst().beyond.empty());
    for (const Picture& each : {little, much, little, still}) meter.add(frameOf({}, each));
    EXPECT_EQ(meter.worst().before.cells, little.cells); // the first of the two that change as much
    EXPECT_EQ(meter.worst().after.cells, much.cells);
    EXPECT_NEAR(meter.worst().beyond.at(92, 22), 0.6, 1e-12);
    EXPECT_EQ(meter.worst().beyond.at(91, 11), 0.0);
}

TEST(Flicker, APixelWhoseCentreIsOnAnEdgeMayBeEitherWay) {
    constexpr int x = 70, y = 40; // the shadow's end, by 0.3 px
    for (const bool undecided : {false, true})
        for (const int wrong : {1, 2}) { // now, and one frame before
            FlickerMeter meter;
            for (int k = 0; k < 3; ++k) {
                FlickerFrame frame = trueFrame({}, true);
                frame.truth.undecided = Mask(BoxOnGround::width, BoxOnGround::height);
                frame.truth.undecided.at(x, y) = undecided && k == wrong; // the next frame has no past there
                if (k == wrong) frame.visibility.at(x, y) = 1.0 - frame.visibility.at(x, y);
                meter.add(frame);
            }
            if (undecided) {
                EXPECT_EQ(meter.energy(), 0.0) << wrong;
            } else {
                EXPECT_GT(meter.energy().value(), 0.0) << wrong;
            }
        }
}

TEST(Flicker, WhatWasAnotherSurfaceOrOutsideTheSetHasNoPast) {
    FlickerFrame last = trueFrame({});
    last.visibility = Picture(BoxOnGround::width, BoxOnGround::height, 0.0);
    for (const bool outside : {false, true}) {
        outside ? last.facing = Mask(128, 96) : last.facing = Mask(128, 96, 1);
        last.truth.receiver = Grid<int>(128, 96, outside ? BoxOnGround::ground : 7);
        FlickerMeter meter;
        meter.add(last);
        meter.add(trueFrame({}));
        EXPECT_FALSE(meter.energy());
    }
}

TEST(Flicker, WhatComesIntoSightHasNoPast) {
    FlickerMeter meter;
    meter.add(trueFrame({}));
    EXPECT_FALSE(meter.energy());
    EXPECT_FALSE(meter.crawl());
    meter.add(trueFrame({glm::dvec2(500.0, 0.0)})); // nothing in common
    EXPECT_FALSE(meter.energy());
    EXPECT_EQ(meter.share(), 0.0);
}

} // namespace
