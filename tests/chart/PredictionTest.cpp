// SPDX-License-Identifier: MIT
// What auto predicts beside what was measured: the summary of made-up points, and where it is shown.
#include "../io/Program.h"
#include "ChartReport.h"
#include "PredictionSummary.h"
#include "ResultsFile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace gnomon::examples;
using namespace gnomon::testing;

struct Times {
    double still, moving;
};

/// A point of Gnomon as measured, ms and px.
ChartPoint measured(const char* scene, const char* technique, const char* spec, double error, Times times) {
    ChartPoint point;
    point.scene = scene;
    point.kit = ourKit;
    point.technique = technique;
    point.setting = spec;
    point.settings = {{"--shadow", spec}};
    point.errors.emplace().boundary.emplace().p95 = error;
    point.cost.emplace();
    point.cost->steadyProcessor.median = times.still;
    point.cost->movingProcessor.median = times.moving;
    return point;
}

ChartPoint expecting(ChartPoint point, double error, Times times) {
    point.prediction = {{point.setting, error, {point.setting, times.still}, {point.setting, times.moving}}};
    return point;
}

/// Half of what it predicts is right.
ChartResults madeUp() {
    ChartResults results;
    results.complete = true;
    results.scenes = {{"lab8-45", "Lab 8", 1, 0.0, 0.4, 1.0, "", {}}, {"room", "Room", 1, 0.0, 0.4, 1.0, "", {}}};
    ChartPoint catastrophe = expecting(measured("room", "map", "map", 1.0, {1.0, 1.0}), 1.0, {2.5, 0.9});
    catastrophe.errors->catastrophes.allLit = true;
    results.points = {expecting(measured("lab8-45", "map", "map:size=512", 1.0, {2.0, 4.0}), 1.4, {4.0, 1.9}),
                      expecting(measured("lab8-45", "volume", "volume", 0.4, {-0.1, 6.0}), 0.7, {0.1, 6.0}),
                      catastrophe, measured("room", "map", "map:edges=soft", 1.0, {1.0, 1.0})};
    return results;
}

std::vector<AutoOutcome> outcomesOf(const ChartResults& results) { return predictionSummary(results).tuned.outcomes; }

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST(PredictionSummary, CountsWhatIsWithinAFactorForEitherHalfOfTheScenes) {
    const PredictionSummary summary = predictionSummary(madeUp());
    EXPECT_EQ(summary.tuned.share.errors, 2u);
    EXPECT_EQ(summary.tuned.share.errorsHeld, 1u) << "1.4 for 1, but not 0.7 for 0.4";
    EXPECT_EQ(summary.tuned.share.times, 4u);
    EXPECT_EQ(summary.tuned.share.timesHeld, 2u) << "4 for 2 and 6 for 6, but not 1.9 for 4 nor anything for -0.1";
    EXPECT_EQ(summary.other.share.errors, 1u);
    EXPECT_EQ(summary.other.share.errorsHeld, 0u) << "it is a catastrophe";
    EXPECT_EQ(summary.other.share.times, 2u);
    EXPECT_EQ(summary.other.share.timesHeld, 1u);
    EXPECT_EQ(sentencesOf(summary),
              (std::vector<std::string>{
                  "Scenes that auto was built on: 50 % of 2 predicted errors are within a factor of 1.5.",
                  "Scenes that auto was built on: 50 % of 4 predicted times are within a factor of 2.",
                  "Other scenes: 0 % of 1 predicted errors are within a factor of 1.5.",
                  "Other scenes: 50 % of 2 predicted times are within a factor of 2."}));
    EXPECT_TRUE(sentencesOf(predictionSummary({})).empty());
}

TEST(PredictionSummary, HoldsAutoAgainstTheCheapestFixedSettingThatKeepsTheError) {
    ChartResults results = madeUp();
    ChartPoint wrong = measured("lab8-45", "hull", "hull", 0.5, {0.1, 0.1});
    wrong.errors->catastrophes.lostShadow = true;
    for (const ChartPoint& point :
         {wrong, measured("lab8-45", "planar", "planar:composite=blend", 0.5, {0.2, 0.2}),
          measured("lab8-45", "map", "map:size=256", 1.1, {0.3, 0.3}),
          measured("town-45", "map", "map", 0.5, {0.4, 0.4}), measured("lab8-45", "traced", "traced", 0.4, {9.0, 9.0}),
          measured("lab8-45", "auto", "auto", 0.9, {0.5, 5.0}),
          measured("lab8-45", "auto", "auto:error=0.3", 0.5, {9, 9})})
        results.points.push_back(point);
    const std::vector<AutoOutcome> all = outcomesOf(results);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_TRUE(all[0].keepsBudget);
    EXPECT_EQ(all[0].best, "volume, volume") << "it took no time at all";
    EXPECT_NEAR(all[0].ratio.value(), 50.0, 1e-9) << "of the least time that is told apart, 0.01 ms";
    EXPECT_EQ(all[1].light, LightMotion::Moving);
    EXPECT_EQ(all[1].best, "map, map:size=512");
    EXPECT_NEAR(all[1].ratio.value(), 5.0 / 4.0, 1e-9);
    for (const std::size_t i : {2, 3}) {
        EXPECT_FALSE(all[i].keepsBudget);
        EXPECT_FALSE(all[i].ratio) << "no fixed setting keeps 0.3 px";
    }
    EXPECT_EQ(
        sentencesOf(predictionSummary(results)).at(2),
        "Scenes that auto was built on: auto keeps 2 of 2 budgets that a fixed setting keeps. In 1 of them it is as "
        "good as the best fixed setting, within a factor of 1.25.");
}

TEST(PredictionSummary, HoldsAutoAgainstNothingThatLeavesTheWallsLit) {
    ChartResults results;
    ChartPoint ground = measured("town-45", "hull", "hull", 0.4, {0.1, 0.1});
    ground.errors->headline = {99, 0, 1, 900};
    ChartPoint coarse = measured("town-45", "map", "map:size=256", 0.9, {0.5, 0.5});
    coarse.errors->headline = {98, 1, 1, 900}; // at an edge that is 0.9 px off
    results.points = {ground, coarse, measured("town-45", "auto", "auto", 0.4, {1.0, 1.0})};
    results.points.back().errors->headline = {100, 0, 0, 900};
    EXPECT_EQ(outcomesOf(results).at(0).best, "map, map:size=256");
    results.points.front().errors->headline = {100, 0, 0, 900};
    EXPECT_EQ(outcomesOf(results).at(0).best, "hull, hull") << "only the ground gets shadow";
}

TEST(PredictionSummary, HoldsAutoAgainstTheMostAccurateFixedSettingWithinTheTime) {
    ChartResults results = madeUp();
    results.points.push_back(measured("lab8-45", "auto", "auto:time=4", 1.2, {4.9, 5.1}));
    const std::vector<AutoOutcome> all = outcomesOf(results);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_TRUE(all[0].keepsBudget) << "within a quarter more";
    EXPECT_EQ(all[0].best, "volume, volume");
    EXPECT_NEAR(all[0].ratio.value(), 1.2 / 0.4, 1e-9);
    EXPECT_FALSE(all[1].keepsBudget);
    EXPECT_EQ(all[1].best, "map, map:size=512") << "volume takes 6 ms";
    EXPECT_NEAR(all[1].ratio.value(), 1.2, 1e-9);
}

TEST(PredictionSummary, NoValueIsWithinAFactorOfNothing) {
    EXPECT_TRUE(isWithin(1.0, 2.0, 2.0));
    EXPECT_TRUE(isWithin(2.0, 1.0, 2.0));
    EXPECT_FALSE(isWithin(2.001, 1.0, 2.0));
    for (const double none : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(isWithin(none, 1.0, 2.0)) << none;
        EXPECT_FALSE(isWithin(1.0, none, 2.0)) << none;
    }
}

/// A model that is in one half would be known in the other.
TEST(PredictionSummary, NoModelIsInBothHalves) {
    const auto isTuned = [](const char* scene) { return isTuningScene(scene); };
    const std::vector<std::vector<const char*>> models = {
        {"lab8-45", "lab8-10"},   {"bunny-45", "bunny-10"},
        {"flyer-45", "flyer-10"}, {"casting-45", "casting-10"},
        {"hills-45", "hills-10"}, {"town-45", "town-10", "town-utm", "street"},
        {"mountains-10"},         {"room"}};
    std::size_t tuned = 0, scenes = 0;
    for (const auto& model : models) {
        for (const char* scene : model) EXPECT_EQ(isTuned(scene), isTuned(model.front())) << scene;
        scenes += model.size();
        tuned += isTuned(model.front()) ? model.size() : 0;
    }
    EXPECT_EQ(2 * tuned, scenes);
    EXPECT_FALSE(isTuningScene("a model of one's own"));
}

TEST(PredictionReport, IsInTheResultsOnThePageAndInAFigureForEachScene) {
    TemporaryFolder folder;
    saveResults(madeUp(), folder.path().string());
    writeReport(madeUp(), folder.path().string());
    const nlohmann::json json = nlohmann::json::parse(readFile(folder.path() / "results.json"));
    EXPECT_EQ(json["predictions"]["builtOn"]["timesHeld"], 2);
    EXPECT_EQ(json["predictions"]["others"]["errors"], 1);
    const std::string html = readFile(folder.path() / "index.html");
    EXPECT_TRUE(holds(html, "Predicted and measured"));
    EXPECT_TRUE(holds(html, "50 % of 4 predicted times are within a factor of 2."));
    EXPECT_TRUE(holds(html, "<title>lab8-45: map, map:size=512, still light: predicted 4, measured 2 ms</title>"));
    for (const char* name : {"predicted", "predicted-lab8-45", "predicted-room"})
        EXPECT_TRUE(holds(html, std::string("id=\"") + name + "\"")) << name;
    const std::string script = readFile(folder.path() / "predicted.gnuplot");
    EXPECT_TRUE(holds(script, "\n1.4\t1\t")) << script;
    EXPECT_TRUE(holds(script, "\n4\t2\t"));
    EXPECT_TRUE(holds(script, "plot x with lines")) << "the line on which both are equal";
}

TEST(PredictionReport, IsLeftOutWhereNothingWasPredicted) {
    TemporaryFolder folder;
    ChartResults results = madeUp();
    for (ChartPoint& point : results.points) point.prediction.reset();
    writeReport(results, folder.path().string());
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "predicted.svg"));
    EXPECT_FALSE(holds(readFile(folder.path() / "index.html"), "Predicted and measured"));
}
