// SPDX-License-Identifier: MIT
// The stability table's runner: what crashes, hangs or refuses costs its own cell, and a right picture is called right.
// This process never draws: the children do.
#include "StabilityResults.h"
#include "StabilityScene.h"
#include "scenes/SceneParts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <unistd.h>

namespace {

using namespace gnomon::examples;
using Cells = std::vector<StabilityCell>;

constexpr double hostile = 2.0; // the value at which the bad ones go wrong; ChartScene::radius tells it

SceneParts boxOnGround(double value) {
    SceneParts parts = onGround();
    parts.add(boxAt({0.0, 0.0, 0.0}, {2.0, 2.0, 3.0}));
    parts.radius = value;
    return parts;
}

Contender gnomons(const std::string& technique) {
    for (const Contender& contender : gnomonContenders())
        if (contender.technique == technique) return contender;
    throw std::logic_error("no technique " + technique);
}

/// Draws no shadow, and does this at the hostile value before.
Contender badContender(const std::string& name, void (*does)()) {
    Contender contender = plainContender();
    contender.technique = name;
    contender.stage = [does](const ChartScene& scene, Look look) {
        if (scene.radius == hostile) does();
        return std::make_unique<PlainStaging>(scene, look);
    };
    return contender;
}

void hang() {
    for (volatile unsigned turns = 0;; turns = turns + 1) continue;
}

StabilityPlan smallPlan() {
    StabilityPlan plan;
    plan.scenes = {{{"T1", "tests", "Box", "About.", "radius", "m", {1.0, hostile, 3.0}}, madeOf(boxOnGround)}};
    plan.width = 128;
    plan.height = 96;
    return plan;
}

StabilityResults run(const StabilityPlan& plan) {
    return runStability(plan, [](std::size_t, const std::string&) { return true; });
}

Cells cellsOf(const Contender& contender, double seconds = 60.0) {
    StabilityPlan plan = smallPlan();
    plan.contenders = {{contender}, {gnomons("planar")}};
    plan.seconds = seconds;
    const StabilityResults results = run(plan);
    EXPECT_TRUE(results.complete);
    EXPECT_EQ(results.rows.size(), 2u);
    EXPECT_EQ(results.rows[1].outcome(), StabilityOutcome::HELD) << "what comes after it is measured as ever";
    return results.rows[0].cells;
}

TEST(StabilityRun, FindsARightContenderRight) {
    const Cells cells = cellsOf(gnomons("planar"));
    ASSERT_EQ(cells.size(), 3u);
    for (const StabilityCell& cell : cells) {
        EXPECT_TRUE(cell.measured);
        EXPECT_TRUE(cell.inBudget());
        EXPECT_GT(cell.everywhere.shadow, 20u);
        EXPECT_EQ(cell.everywhere.iou, 1.0);
        ASSERT_TRUE(cell.onReceiver);
        EXPECT_TRUE(cell.onReceiver->inBudget());
    }
}

/// Normals under a scale are not of length 1.
TEST(StabilityRun, JudgesAScaledScene) {
    StabilityPlan plan = smallPlan();
    plan.scenes = stabilityScenes(std::vector<std::string>{"N3"});
    plan.scenes[0].values = {1.0, 1e-3, 1e4};
    plan.contenders = {{gnomons("traced")}};
    const Cells cells = run(plan).rows[0].cells;
    EXPECT_GT(cells[0].everywhere.shadow, 100u);
    for (const StabilityCell& cell : cells) {
        EXPECT_NEAR(double(cell.everywhere.shadow), double(cells[0].everywhere.shadow), 2.0);
        EXPECT_TRUE(cell.inBudget());
    }
}

/// What would be drawn of casters without their broken triangles; OpenSceneGraph leaves out what is infinitely large.
TEST(StabilityRun, SeesCastersWithBrokenTriangles) {
    StabilityPlan plan = smallPlan();
    plan.scenes = stabilityScenes(std::vector<std::string>{"N2"});
    plan.scenes[0].values = {0.0, 100.0};
    plan.contenders = {{gnomons("traced")}};
    const Cells cells = run(plan).rows[0].cells;
    EXPECT_TRUE(cells[0].inBudget());
    EXPECT_TRUE(cells[1].inBudget());
}

TEST(StabilityRun, FindsAContenderWithoutShadowsCatastrophic) {
    for (const StabilityCell& cell : cellsOf(plainContender())) {
        EXPECT_TRUE(cell.measured);
        EXPECT_EQ(cell.everywhere.iou, 0.0);
        EXPECT_TRUE(cell.catastrophe());
    }
}

TEST(StabilityRun, ACrashCostsItsCellAlone) {
    const Cells cells = cellsOf(badContender("crashes", [] { std::raise(SIGKILL); }));
    EXPECT_TRUE(cells[0].measured);
    EXPECT_EQ(cells[1].failure, "crashed");
    EXPECT_NE(cells[1].message.find("signal"), std::string::npos) << cells[1].message;
    EXPECT_TRUE(cells[1].catastrophe());
    EXPECT_TRUE(cells[2].measured);
}

/// It is set up once for each of three values, and then for the film.
TEST(StabilityRun, ACrashWhileTheCameraMovesCostsTheCellOfTheFilm) {
    Contender contender = gnomons("planar");
    const auto calls = std::make_shared<int>(0);
    contender.stage = [stage = contender.stage, calls](const ChartScene& scene, Look look) {
        if (++*calls == 4) std::raise(SIGKILL);
        return stage(scene, look);
    };
    const Cells cells = cellsOf(contender);
    EXPECT_TRUE(cells[0].inBudget());
    EXPECT_TRUE(cells[1].inBudget());
    EXPECT_EQ(cells[2].failure, "crashed");
}

TEST(StabilityRun, FilmsTheLastValueAndKeepsThePictureOfFlicker) {
    const auto folder = std::filesystem::temp_directory_path() / ("films-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    StabilityPlan plan = smallPlan();
    plan.folder = folder.string();
    plan.contenders = {{gnomons("planar")}, stabilityContenders({"ParallelSplit"}, false).front()};
    const StabilityResults results = run(plan);
    const StabilityFlicker &still = results.rows[0].flicker, &swims = results.rows[1].flicker;
    EXPECT_EQ(still.value, 3.0);
    EXPECT_EQ(still.energy, 0.0);
    EXPECT_EQ(still.picture, "");
    EXPECT_GT(swims.share.value(), 0.0);
    EXPECT_TRUE(std::filesystem::exists(folder / swims.picture)) << swims.picture;
    std::filesystem::remove_all(folder);
}

TEST(StabilityRun, AProcessThatEndsItselfCostsItsCellAlone) {
    const Cells cells = cellsOf(badContender("ends", [] { _exit(0); }));
    EXPECT_TRUE(cells[0].measured);
    EXPECT_EQ(cells[1].failure, "crashed");
    EXPECT_TRUE(cells[2].measured);
}

/// The limit holds for the other cells, too, each of which takes a tenth of it.
TEST(StabilityRun, AHangCostsItsCellAlone) {
    const Cells cells = cellsOf(badContender("hangs", hang), 3.0);
    EXPECT_TRUE(cells[0].measured);
    EXPECT_EQ(cells[1].failure, "hung");
    EXPECT_TRUE(cells[1].catastrophe());
    EXPECT_TRUE(cells[2].measured);
}

TEST(StabilityRun, ARefusalIsAStatedLimit) {
    const Cells cells = cellsOf(badContender("refuses", [] { throw std::invalid_argument("not here."); }));
    EXPECT_EQ(cells[1].failure, "refused");
    EXPECT_EQ(cells[1].message, "not here.");
    EXPECT_TRUE(cells[1].stated());
    EXPECT_FALSE(cells[1].catastrophe());
}

TEST(StabilityRun, IsTheSameFromRunToRun) {
    StabilityPlan plan = smallPlan();
    plan.contenders = {{gnomons("map")}, {gnomons("auto")}, {gnomons("traced")}};
    for (const char* peer : {"SoftShadowMap", "LightSpacePerspective", "ViewDependent"})
        plan.contenders.push_back(stabilityContenders({peer}, false).front());
    const StabilityResults first = run(plan);
    plan.workers = 2;
    unsetenv("LP_NUM_THREADS"); // nor does it matter how many threads draw
    const StabilityResults second = run(plan);
    for (std::size_t row = 0; row < first.rows.size(); ++row) {
        for (std::size_t place = 0; place < first.rows[row].cells.size(); ++place)
            EXPECT_EQ(jsonOf(first.rows[row].cells[place]), jsonOf(second.rows[row].cells[place]));
        EXPECT_EQ(first.rows[row].flicker.energy, second.rows[row].flicker.energy);
        EXPECT_TRUE(first.rows[row].flicker.energy);
    }
}

TEST(StabilityRun, EndsWhenItIsToldTo) {
    StabilityPlan plan = smallPlan();
    plan.contenders = {{badContender("hangs", hang)}};
    const StabilityResults results = runStability(plan, [](std::size_t done, const std::string&) { return done == 0; });
    EXPECT_FALSE(results.complete);
    EXPECT_TRUE(results.rows[0].cells[0].measured);
    EXPECT_FALSE(results.rows[0].cells[2].measured);
}

} // namespace
