// SPDX-License-Identifier: MIT
// What a figure shows, worked by hand.
#include "Curves.h"

#include <support/SyntheticChart.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace gnomon::examples;
using test::chartPoint;

ChartResults resultsOf(const std::vector<ChartPoint>& points) {
    ChartResults results;
    results.points = points;
    return results;
}

ChartPoint in(const char* scene, ChartPoint point) {
    point.scene = scene;
    return point;
}

ChartPoint catastrophic(ChartPoint point) {
    point.errors->catastrophes.lostShadow = true;
    return point;
}

ChartPoint failed(ChartPoint point) {
    point.cost.reset();
    point.errors.reset();
    point.failure = "It crashed.";
    return point;
}

/// "technique setting" of the staircase of one scene.
std::vector<std::string> bestOf(const std::vector<ChartPoint>& points) {
    std::vector<std::string> names;
    const std::vector<Curve> curves = sceneCurves(resultsOf(points), "boxes", LightMotion::Still);
    for (const BestPoint& best : staircase(curves)) names.push_back(best.curve->technique + " " + best.point->setting);
    return names;
}

TEST(Staircase, HoldsWhatNothingFasterBeats) {
    EXPECT_EQ(bestOf({chartPoint("Gnomon", "map", "512", 2, 4), chartPoint("Gnomon", "map", "1024", 3, 2),
                      chartPoint("osgShadow", "ShadowMap", "512", 2.5, 5),  // slower and worse than map 512
                      chartPoint("osgShadow", "ShadowMap", "1024", 2.5, 3), // between the two maps in both
                      chartPoint("Gnomon", "traced", "", 30, 0.4), chartPoint("Gnomon", "planar", "", 40, 0.4)}),
              (std::vector<std::string>{"map 512", "ShadowMap 1024", "map 1024", "traced "}));
}

TEST(Staircase, OfTwoAsFastTheMoreAccurateIsTheBest) {
    EXPECT_EQ(bestOf({chartPoint("Gnomon", "a", "", 2, 4), chartPoint("Gnomon", "b", "", 2, 3)}),
              (std::vector<std::string>{"b "}));
}

TEST(Staircase, OfTwoAlikeTheFirstIsTheBest) {
    EXPECT_EQ(bestOf({chartPoint("Gnomon", "a", "", 2, 3), chartPoint("Gnomon", "b", "", 2, 3)}),
              (std::vector<std::string>{"a "}));
}

TEST(Staircase, HoldsNothingThatIsCatastrophicOrFailedOrHasNoNumbers) {
    ChartPoint noBoundary = chartPoint("Gnomon", "c", "", 1, 1), noTime = chartPoint("Gnomon", "d", "", 1, 1);
    noBoundary.errors->boundary.reset();
    noTime.cost->steadyWall.median = std::nan("");
    EXPECT_EQ(bestOf({catastrophic(chartPoint("Gnomon", "a", "", 1, 1)), failed(chartPoint("Gnomon", "b", "", 1, 1)),
                      noBoundary, noTime, chartPoint("Gnomon", "e", "", 2, 3)}),
              (std::vector<std::string>{"e "}));
    EXPECT_TRUE(bestOf({}).empty());
}

TEST(Curves, KeepTheOrderOfTheirSettingsAndAskTheRightTime) {
    ChartPoint second = chartPoint("Gnomon", "map", "256", 1, 8);
    second.cost->movingWall = {5, 6, 7};
    const ChartResults results =
        resultsOf({chartPoint("Gnomon", "map", "512", 2, 4), chartPoint("osgShadow", "map", "512", 3, 4), second,
                   in("town", chartPoint("Gnomon", "map", "1024", 9, 9))});
    const std::vector<Curve> curves = sceneCurves(results, "boxes", LightMotion::Moving);
    ASSERT_EQ(curves.size(), 2u); // a kit's name sets curves apart
    ASSERT_EQ(curves[0].points.size(), 2u);
    EXPECT_EQ(curves[0].points[0].setting, "512");
    EXPECT_EQ(curves[0].points[1].setting, "256");
    EXPECT_EQ(curves[0].points[1].time.q1, 5);
    EXPECT_EQ(curves[0].points[1].time.median, 6);
    EXPECT_EQ(curves[0].points[1].error, 8);
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoMiddleOnes) {
    EXPECT_EQ(median({3, 1, 9}), 3);
    EXPECT_EQ(median({4, 1, 9, 2}), 3);
    EXPECT_TRUE(std::isnan(median({})));
}

TEST(PooledCurves, AreMediansOverScenes) {
    const ChartResults results = resultsOf({in("a", chartPoint("Gnomon", "map", "512", 2, 4)),
                                            in("b", chartPoint("Gnomon", "map", "512", 10, 1)),
                                            in("c", catastrophic(chartPoint("Gnomon", "map", "512", 3, 7))),
                                            in("a", chartPoint("Gnomon", "planar", "", 1, 0.5))});
    const std::vector<Curve> curves = pooledCurves(results, LightMotion::Still);
    ASSERT_EQ(curves.size(), 2u);
    const CurvePoint& map = curves[0].points.at(0);
    EXPECT_EQ(map.time.median, 3);
    EXPECT_EQ(map.error, 4);
    EXPECT_EQ(map.scenes, 3u);
    EXPECT_TRUE(map.catastrophic);
    EXPECT_EQ(curves[1].points.at(0).scenes, 1u);
    EXPECT_FALSE(curves[1].points.at(0).catastrophic);
}

TEST(PooledCurves, CountAFailureAsInfinitelyFarOffAndItsTimeNot) {
    const ChartPoint good = chartPoint("Gnomon", "map", "512", 2, 4), worse = chartPoint("Gnomon", "map", "512", 4, 6);
    const auto pooled = [](const std::vector<ChartPoint>& points) {
        return pooledCurves(resultsOf(points), LightMotion::Still).at(0).points.at(0);
    };
    const CurvePoint once = pooled({in("a", good), in("b", worse), in("c", failed(good))});
    EXPECT_EQ(once.error, 6); // 4, 6, infinity
    EXPECT_EQ(once.time.median, 3);
    EXPECT_TRUE(once.catastrophic);
    const CurvePoint half = pooled({in("a", good), in("b", failed(good))});
    EXPECT_FALSE(half.shown());
    EXPECT_EQ(half.scenes, 2u);
}

TEST(BoundaryFloor, IsTheScenesOwnOrTheMedianOfAll) {
    ChartResults results;
    for (const double floor : {0.3, 0.5, 0.4}) {
        results.scenes.emplace_back().name = std::string(1, static_cast<char>('a' + results.scenes.size()));
        results.scenes.back().boundaryFloor = floor;
    }
    results.scenes.emplace_back().name = "none"; // scene "e"
    EXPECT_EQ(boundaryFloor(results, results.scenes[1].name), 0.5);
    EXPECT_EQ(boundaryFloor(results, ""), 0.4);
    EXPECT_FALSE(boundaryFloor(results, "none"));
}

} // namespace
