// SPDX-License-Identifier: MIT
#include "LabelPlacement.h"
#include "LogAxis.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace {

using namespace gnomon::examples;

const PageBox page{{0, 0}, {400, 300}};

PageBox markerAt(double x, double y) { return {{x - 5, y - 5}, {x + 5, y + 5}}; }

TEST(LabelPlacement, TextsOfOnePlaceDoNotOverlap) {
    std::vector<LabelWish> wishes(9, {{60, 12}, {{200, 150}}});
    const auto placed = placeLabels(wishes, page, {markerAt(200, 150)}, {});
    for (std::size_t i = 0; i < placed.size(); ++i) {
        EXPECT_TRUE(placed[i].placed && page.holds(placed[i].box)) << i;
        EXPECT_FALSE(placed[i].box.overlaps(markerAt(200, 150))) << i;
        for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(placed[i].box.overlaps(placed[k].box)) << i << " " << k;
    }
}

TEST(LabelPlacement, AloneItStandsClose) {
    const auto placed = placeLabels({{{60, 12}, {{200, 150}}}}, page, {markerAt(200, 150)}, {});
    EXPECT_FALSE(placed[0].leader);
    EXPECT_LT(glm::distance(placed[0].anchor, glm::clamp(placed[0].anchor, placed[0].box.low, placed[0].box.high)), 10);
}

TEST(LabelPlacement, AtTheEdgeItStaysOnThePage) {
    for (const glm::dvec2 corner : {glm::dvec2(2, 2), glm::dvec2(398, 298)})
        EXPECT_TRUE(page.holds(placeLabels({{{60, 12}, {corner}}}, page, {}, {})[0].box));
}

TEST(LabelPlacement, PrefersTheFreeSideOfALine) {
    std::vector<DrawnPoint> line;
    for (double y = 0; y < 300; y += 4)
        for (double x = 200; x < 290; x += 4) line.push_back({{x, y}, 1}); // all to the right is full
    EXPECT_LE(placeLabels({{{60, 12}, {{200, 150}}, 1}}, page, {}, line)[0].box.high.x, 200);
}

TEST(LabelPlacement, StandsNearerToItsOwnThanToAnyOther) {
    std::vector<DrawnPoint> others = {{{229, 150}, 2}, {{171, 150}, 2}}; // just beyond where it would stand
    for (double x = 160; x < 240; x += 4) others.push_back({{x, 129}, 2});
    const PlacedLabel label = placeLabels({{{20, 12}, {{200, 150}}, 1}}, page, {}, others)[0];
    const auto away = [&](const glm::dvec2& p) {
        return glm::distance(p, glm::clamp(p, label.box.low, label.box.high));
    };
    for (const DrawnPoint& other : others) EXPECT_GE(away(other.at), away(label.anchor)) << other.at.x;
}

TEST(LabelPlacement, LeavesOutWhatMayBeLeftOutWhereThereIsNoRoom) {
    std::vector<PageBox> markers;
    for (double x = 0; x < 400; x += 10)
        for (double y = 0; y < 300; y += 10) markers.push_back(markerAt(x, y));
    const auto placed =
        placeLabels({{{60, 12}, {{200, 150}}, 0, true}, {{60, 12}, {{100, 90}}, 0, false}}, page, markers, {});
    EXPECT_TRUE(placed[0].placed);
    EXPECT_FALSE(placed[1].placed);
}

TEST(LogAxis, PlacesByTheLogarithm) {
    const LogAxis axis{0.1, 100.0, 50.0, 350.0};
    EXPECT_DOUBLE_EQ(axis.place(0.1), 50.0);
    EXPECT_NEAR(axis.place(1.0), 150.0, 1e-9);
    EXPECT_NEAR(axis.place(10.0), 250.0, 1e-9);
    EXPECT_DOUBLE_EQ(axis.place(0.0), 50.0);
    EXPECT_DOUBLE_EQ(axis.place(1e9), 350.0);
    EXPECT_EQ(axis.ticks(), (std::vector<double>{0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100}));
}

TEST(LogAxis, HoldsAllValuesButNothingBelowTheLeast) {
    const LogAxis axis = logAxis({0.0, 3.0, 40.0}, 0.01, 0.0, 100.0);
    EXPECT_LT(axis.low, 0.01);
    EXPECT_GT(axis.low, 0.005);
    EXPECT_GT(axis.high, 40.0);
    for (const std::vector<double>& values : {std::vector<double>{}, {2.0}, {-5.0, 0.0}}) {
        const LogAxis one = logAxis(values, 0.01, 0.0, 100.0);
        EXPECT_TRUE(one.low > 0.0 && one.high > one.low);
    }
}

} // namespace
