// SPDX-License-Identifier: MIT
// What the stability table makes of its cells; its files and its scenes.
#include "StabilityResults.h"
#include "StabilityScene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>

namespace {

using namespace gnomon::examples;
namespace metrics = gnomon::metrics;
using Outcome = StabilityOutcome;

StabilityCell rightCell() {
    StabilityCell cell;
    cell.measured = true;
    cell.everywhere.p95 = 0.5;
    return cell;
}

StabilityCell wrongCell() {
    StabilityCell cell = rightCell();
    cell.everywhere.wrong = 7;
    cell.everywhere.iou = 0.8;
    return cell;
}

StabilityCell lostCell() {
    StabilityCell cell = wrongCell();
    cell.everywhere.iou = 0.0;
    cell.everywhere.lost = true;
    return cell;
}

StabilityCell saying(StabilityCell cell) {
    cell.diagnosis = {"it cannot be done."};
    return cell;
}

StabilityCell rightOnItsReceiver(StabilityCell cell) {
    cell.onReceiver = rightCell().everywhere;
    return cell;
}

StabilityRow rowOf(std::vector<StabilityCell> cells) {
    StabilityRow row;
    row.scene = "T1";
    row.kit = "Gnomon";
    row.technique = "planar";
    row.setting = "defaults";
    row.cells = std::move(cells);
    return row;
}

TEST(StabilityOutcomes, AreTheWorstOfTheSweep) {
    EXPECT_EQ(rowOf({rightCell(), rightCell()}).outcome(), Outcome::HELD);
    EXPECT_EQ(rowOf({rightCell(), wrongCell()}).outcome(), Outcome::LEFT);
    EXPECT_EQ(rowOf({lostCell(), wrongCell()}).outcome(), Outcome::CATASTROPHE);
    EXPECT_EQ(rowOf({saying(lostCell()), rightCell()}).outcome(), Outcome::STATED);
    EXPECT_EQ(rowOf({saying(wrongCell()), wrongCell()}).outcome(), Outcome::LEFT);
    EXPECT_EQ(rowOf({rightOnItsReceiver(lostCell()), rightCell()}).outcome(), Outcome::ELSEWHERE);
}

TEST(StabilityOutcomes, DoNotTakeARemarkForALimit) {
    StabilityCell wrong = wrongCell(), lost = lostCell();
    wrong.diagnosis = {"ShadowVolumeTechnique: invalid triangles are left out: 1, the first in 'b'."};
    lost.diagnosis = {"ShadowMapTechnique: invalid triangles are left out: 3, the first in 'a'."};
    EXPECT_EQ(rowOf({wrong}).outcome(), Outcome::LEFT);
    EXPECT_EQ(rowOf({lost}).outcome(), Outcome::CATASTROPHE);
    lost.diagnosis.push_back("ShadowMapTechnique: no light is on in this view.");
    EXPECT_EQ(rowOf({lost}).outcome(), Outcome::STATED);
}

TEST(StabilityOutcomes, AreCatastrophesWhateverIsSaidAfterACrashOrNaN) {
    StabilityCell notFinite = saying(rightOnItsReceiver(rightCell())), crashed;
    notFinite.notFinite = 1;
    crashed.failure = "crashed";
    EXPECT_EQ(rowOf({notFinite}).outcome(), Outcome::CATASTROPHE);
    EXPECT_EQ(rowOf({crashed}).outcome(), Outcome::CATASTROPHE);
}

TEST(StabilityOutcomes, TellHowFarASweepGets) {
    EXPECT_EQ(rowOf({rightCell(), rightCell()}).leftAt(), std::nullopt);
    EXPECT_EQ(rowOf({rightCell(), rightCell()}).reach(), 1.0);
    EXPECT_EQ(rowOf({rightCell(), wrongCell(), rightCell(), wrongCell()}).leftAt(), 1u);
    EXPECT_EQ(rowOf({rightCell(), wrongCell(), rightCell(), wrongCell()}).reach(), 0.25);
}

StabilityCell withShadow(StabilityCell cell) {
    cell.everywhere.shadow = 50;
    if (cell.onReceiver) cell.onReceiver->shadow = 50;
    return cell;
}

TEST(StabilityFilms, ShowTheLastValueThatIsRightAndHasAShadow) {
    const StabilityCell right = withShadow(rightCell()), wrong = withShadow(wrongCell());
    EXPECT_EQ(filmedAt({right, right, right}), 2u);
    EXPECT_EQ(filmedAt({right, right, wrong}), 1u);
    EXPECT_EQ(filmedAt({right, wrong, right}), 2u);
    EXPECT_EQ(filmedAt({right, rightCell()}), 0u);     // no shadow at the end
    EXPECT_EQ(filmedAt({right, StabilityCell()}), 0u); // nothing was drawn
    EXPECT_EQ(filmedAt({wrong, wrong}), std::nullopt);
}

TEST(StabilityFilms, ShowNoValueAtWhichTheTechniqueStatesALimit) {
    const StabilityCell right = withShadow(rightCell());
    EXPECT_EQ(filmedAt({right, saying(right)}), 0u);
}

TEST(StabilityFilms, AskATechniqueOfOneReceiverToBeRightThere) {
    const StabilityCell right = withShadow(rightCell());
    EXPECT_EQ(filmedAt({right, withShadow(rightOnItsReceiver(wrongCell()))}), 1u);
    EXPECT_EQ(filmedAt({right, withShadow(rightOnItsReceiver(saying(wrongCell())))}), 1u); // of other receivers
    StabilityCell none = withShadow(rightOnItsReceiver(wrongCell()));
    none.onReceiver->shadow = 49;
    EXPECT_EQ(filmedAt({right, none}), 0u);
}

TEST(StabilityOutcomes, TakeAPixelAtThe95thPercentileAsTheLimit) {
    StabilityCell cell = rightCell();
    cell.everywhere.p95 = 1.0;
    EXPECT_TRUE(cell.inBudget());
    cell.everywhere.p95 = 1.001;
    EXPECT_FALSE(cell.inBudget());
}

TEST(StabilityOutcomes, AskNoMoreThanAPictureOfOneRayAPixelHas) {
    StabilityCell cell = rightCell();
    cell.everywhere.p95 = cell.everywhere.floor = 1.8;
    EXPECT_TRUE(cell.inBudget());
    cell.everywhere.p95 = 1.81;
    EXPECT_FALSE(cell.inBudget());
}

/// A truth of 32 × 32 pixels, the left half shadowed, the column between them an edge.
metrics::TruthMaps halfShadowed() {
    metrics::TruthMaps truth;
    truth.lit = truth.blockerDistance = truth.facing = metrics::Picture(32, 32, 1.0);
    truth.litCentre = metrics::Mask(32, 32, 1);
    truth.receiver = metrics::Grid<int>(32, 32, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x <= 16; ++x) {
            truth.lit.at(x, y) = x < 16 ? 0.0 : 0.5;
            truth.litCentre.at(x, y) = x == 16;
        }
    return truth;
}

StabilityJudgement judged(const metrics::Picture& visibility) {
    const metrics::TruthMaps truth = halfShadowed();
    const metrics::PixelSets sets = metrics::pixelSets(truth, visibility);
    return judge(visibility, truth, sets, sets.agreeing);
}

metrics::Picture centreRays() {
    const metrics::TruthMaps truth = halfShadowed();
    metrics::Picture picture(32, 32);
    for (std::size_t i = 0; i < picture.cells.size(); ++i) picture.cells[i] = truth.litCentre.cells[i];
    return picture;
}

TEST(StabilityJudge, FindsThePictureOfRaysRight) {
    const StabilityJudgement judgement = judged(centreRays());
    EXPECT_TRUE(judgement.inBudget());
    EXPECT_EQ(judgement.iou, 1.0);
    EXPECT_GT(judgement.shadow, 400u); // 15 columns without the picture's rim
}

/// A shadow that lies between two rows of pixel centres is in no picture of one ray a pixel.
TEST(StabilityJudge, HasTheFloorOfAPictureOfRays) {
    metrics::TruthMaps truth = halfShadowed();
    for (int y = 2; y < 30; ++y) truth.lit.at(24, y) = 0.4;
    const metrics::PixelSets sets = metrics::pixelSets(truth, centreRays());
    const StabilityJudgement judgement = judge(centreRays(), truth, sets, sets.agreeing);
    EXPECT_GT(judgement.floor, 5.0); // of 8 columns to the next edge
    EXPECT_EQ(judgement.p95, judgement.floor);
    EXPECT_TRUE(judgement.inBudget());
}

/// One that a place 1/16 px beside the centre sees is in the picture of another ray.
TEST(StabilityJudge, HasTheFloorOfTheWorstRayBesideTheCentre) {
    metrics::TruthMaps truth = halfShadowed();
    truth.litBeside.fill(truth.litCentre);
    const auto floorNow = [&] {
        const metrics::PixelSets sets = metrics::pixelSets(truth, centreRays());
        return judge(centreRays(), truth, sets, sets.agreeing).floor;
    };
    EXPECT_LE(floorNow(), 0.5);
    for (int y = 2; y < 30; ++y) truth.litBeside[2].at(24, y) = 0;
    EXPECT_GT(floorNow(), 5.0); // of 8 columns to the next edge
}

TEST(StabilityJudge, DoesNotCountAPixelThatTheTruthLeavesUndecided) {
    metrics::TruthMaps truth = halfShadowed();
    truth.undecided = metrics::Mask(32, 32, 0);
    metrics::Picture picture = centreRays();
    picture.at(5, 5) = picture.at(5, 20) = 1.0;
    truth.undecided.at(5, 20) = 1;
    const metrics::PixelSets sets = metrics::pixelSets(truth, picture);
    EXPECT_EQ(judge(picture, truth, sets, sets.agreeing).wrong, 1u);
}

TEST(StabilityJudge, CountsAWrongPixelAwayFromEdgesButNotOneBesideThem) {
    metrics::Picture picture = centreRays();
    picture.at(18, 10) = 0.0; // two from the edge's column
    EXPECT_EQ(judged(picture).wrong, 0u);
    picture.at(19, 10) = 0.0;
    EXPECT_EQ(judged(picture).wrong, 1u);
    picture.at(5, 5) = 1.0;
    EXPECT_EQ(judged(picture).wrong, 2u);
    EXPECT_FALSE(judged(picture).inBudget());
}

/// A wall of 20 x 20 pixels that is turned away.
metrics::TruthMaps turnedAwayBy(double cosine) {
    metrics::TruthMaps truth = halfShadowed();
    truth.lit = metrics::Picture(32, 32, 0.0);
    truth.litCentre = metrics::Mask(32, 32, 0);
    for (int y = 6; y < 26; ++y)
        for (int x = 6; x < 26; ++x) truth.facing.at(x, y) = -cosine;
    return truth;
}

TEST(StabilityJudge, CountsPixelsTurnedAwayThatAreBrightOrStripedAwayFromEdges) {
    const auto wrong = [](const metrics::Picture& picture, const metrics::TruthMaps& truth) {
        const metrics::PixelSets sets = metrics::pixelSets(truth, picture);
        return judge(picture, truth, sets, sets.agreeing).turnedAwayWrong;
    };
    metrics::Picture dark(32, 32, 0.0), spot = dark, rim = dark;
    const metrics::Picture bright(32, 32, 1.0);
    spot.at(12, 12) = 1.0;
    rim.at(7, 12) = 1.0; // two from another face
    EXPECT_EQ(wrong(dark, turnedAwayBy(0.1)), 0u);
    EXPECT_EQ(wrong(bright, turnedAwayBy(0.1)), 256u); // of 16 x 16 that are more than two from others
    EXPECT_EQ(wrong(spot, turnedAwayBy(0.1)), 1u);
    EXPECT_EQ(wrong(rim, turnedAwayBy(0.1)), 0u);
    EXPECT_EQ(wrong(bright, turnedAwayBy(0.001)), 0u); // whole: depth does not tell to which side it turns
    EXPECT_EQ(wrong(spot, turnedAwayBy(0.001)), 5u);   // itself and its neighbours
    EXPECT_EQ(wrong(bright, turnedAwayBy(-0.001)), 0u);
}

TEST(StabilityJudge, LeavesItsBudgetForAToothOfAConvexBody) {
    metrics::TruthMaps truth = halfShadowed();
    truth.smoothLight = metrics::Picture(32, 32, 0.0);
    for (int y = 4; y < 28; ++y) truth.smoothLight.at(8, y) = 0.2;
    metrics::Picture picture = centreRays();
    for (int y = 4; y < 28; ++y) picture.at(8, y) = 1.0;
    for (int y = 4; y < 28; ++y) truth.facing.at(8, y) = -0.1;
    const auto judgedNow = [&] {
        const metrics::PixelSets sets = metrics::pixelSets(truth, picture);
        return judge(picture, truth, sets, sets.agreeing);
    };
    EXPECT_EQ(judgedNow().teeth, 0u);
    EXPECT_TRUE(judgedNow().inBudget());
    picture.at(8, 10) = 0.0;
    EXPECT_EQ(judgedNow().teeth, 1u);
    EXPECT_FALSE(judgedNow().inBudget());
    EXPECT_EQ(judged(centreRays()).teeth, std::nullopt);
}

TEST(StabilityJudge, CallsAShadowLostIfNothingOfItIsThere) {
    EXPECT_TRUE(judged(metrics::Picture(32, 32, 1.0)).lost);
    EXPECT_FALSE(judged(centreRays()).lost);
}

TEST(StabilityFiles, HoldCellsAndOutcomes) {
    StabilityResults results;
    results.made = {{"size", "160x120"}};
    results.scenes = {{"T1", "tests", "Box, \"large\"", "About.", "size", "m", {1.0, 0.1, 1e7}}};
    results.rows = {rowOf({rightCell(), rightOnItsReceiver(saying(wrongCell())), lostCell()})};
    results.rows[0].flicker.crawl = 0.125;
    const auto folder = std::filesystem::temp_directory_path() / ("stability-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    saveStability(results, folder.string());
    const auto saved = nlohmann::ordered_json::parse(std::ifstream(folder / "stability.json"));
    std::filesystem::remove_all(folder);
    EXPECT_EQ(saved["scenes"][0]["values"], (std::vector<double>{1.0, 0.1, 1e7}));
    EXPECT_EQ(saved["rows"][0]["outcome"], "catastrophe");
    EXPECT_EQ(saved["rows"][0]["crawlPixels"], 0.125);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(saved["rows"][0]["cells"][i], jsonOf(results.rows[0].cells[i]));
        EXPECT_EQ(jsonOf(cellOf(saved["rows"][0]["cells"][i])),
                  jsonOf(results.rows[0].cells[i])); // a child hands it over
    }
}

TEST(StabilityScenes, CanAllBeMadeAtEachValue) {
    std::set<std::string> ids;
    for (const StabilityScene& scene : stabilityScenes()) {
        EXPECT_TRUE(ids.insert(scene.id).second) << scene.id;
        EXPECT_GE(scene.values.size(), 3u) << scene.id;
        EXPECT_EQ(scene.about.back(), '.') << scene.id;
        for (const double value : scene.values) {
            const StabilityCase made = scene.make(value, 16, 12);
            EXPECT_GT(made.scene.content->getNumChildren(), 0u) << scene.id;
            EXPECT_TRUE(made.scene.bounds.valid()) << scene.id << " at " << value;
            EXPECT_TRUE(made.scene.camera.view.valid()) << scene.id << " at " << value;
        }
    }
    EXPECT_GE(ids.size(), 15u);
}

TEST(StabilityScenes, AreChosenByTheirIds) {
    const std::vector<StabilityScene> chosen = stabilityScenes({"N1", "L5"});
    ASSERT_EQ(chosen.size(), 2u);
    EXPECT_EQ(chosen[0].id, "L5");
    EXPECT_EQ(stabilityScenes(std::vector<std::string>()).size(), stabilityScenes().size());
    EXPECT_THROW(stabilityScenes({"L5", "Q9"}), std::invalid_argument);
}

} // namespace
