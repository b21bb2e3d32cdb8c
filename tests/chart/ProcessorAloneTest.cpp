// SPDX-License-Identifier: MIT
// Times of a process that draws nothing: what is made of its answers, and of none.
#include "ProcessorAlone.h"
#include "ChartRun.h"
#include "OtherProcess.h"
#include "SmallScene.h"

#include "../io/Program.h"

#include <gnomon/HeadlessContext.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace {

using namespace gnomon::examples;

bool always() { return true; }

/// A program of the shell's in the place of gnomonchart.
AlonePlan answering(const std::string& script) { return {{"sh", "-c", script}, "small", 2}; }

/// What runs has four contenders to time.
std::vector<std::optional<AloneTimes>> timesBy(const std::string& script,
                                               const std::function<bool()>& goesOn = always) {
    return timesAlone(answering(script), std::vector<Contender>(4, plainContender()), goesOn);
}

const std::string line = "echo 'processor alone: [0.5, [1, 2, 3], [4, 5, 6]]'; ";

TEST(ProcessorAlone, TakesEachAnswerAndPassesOverWhatLibrariesSay) {
    const auto times = timesBy("printf 'Obj unable to find material\\nOn its ' >&2; " + line +
                               "echo 'processor alone: null'; " + line + line);
    ASSERT_EQ(times.size(), 4u);
    EXPECT_FALSE(times[1]) << "a contender that failed";
    for (const std::size_t i : {0, 2, 3}) {
        ASSERT_TRUE(times[i]);
        EXPECT_EQ(times[i]->frame, 0.5);
        EXPECT_EQ(times[i]->steady.median, 2.0);
        EXPECT_EQ(times[i]->moving.q3, 6.0);
    }
}

/// Each process ends after an answer: the contender that it was at has none, and the next process goes on with the one after.
TEST(ProcessorAlone, AProcessThatEndsTooSoonCostsOneContenderItsTimes) {
    const auto times = timesBy(line + "kill -9 $$");
    ASSERT_EQ(times.size(), 4u);
    for (const std::size_t i : {0, 2}) EXPECT_TRUE(times[i]) << i;
    for (const std::size_t i : {1, 3}) EXPECT_FALSE(times[i]) << i;
}

TEST(ProcessorAlone, StoppedItKeepsWhatItHasAndWaitsForNoMore) {
    int asked = 0;
    const auto times = timesBy(line + line + "sleep 0.1; " + line + line, [&asked] { return ++asked < 2; });
    EXPECT_EQ(times.size(), 2u);
}

TEST(ProcessorAlone, WhereOpenGLDrawsAllTheSameItIsRefused) {
    gnomon::HeadlessContext(16, 16).renderer(); // from now on Mesa draws in this process
    try {
        drawNothing();
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("which draws in spite of GALLIUM_NOOP"), std::string::npos)
            << error.what();
    }
    unsetenv("GALLIUM_NOOP");
    unsetenv("GALLIUM_THREAD");
}

/// The chart of two scenes, whose other process says that there is a card.
TEST(ProcessorAlone, WhereItCannotBeMeasuredTheChartSaysSoOnceAndGoesOn) {
    const gnomon::testing::TemporaryFolder folder;
    ChartPlan plan;
    plan.scenes = {"one", "two"};
    plan.scene = [](const std::string& name) {
        ChartScene scene = test::smallScene();
        scene.name = name;
        return scene;
    };
    plan.techniques = {"planar"};
    plan.folder = folder.path().string();
    plan.frames = 2;
    plan.flickerFrames = 0;
    plan.brief = true;
    plan.disc = false;
    plan.alone = {"sh", "-c", "echo gnomonchart: OpenGL is a card. >&2; exit 1"};
    const ChartResults results = runChart(
        plan, [](const ChartResults&) {}, [] { return false; });
    EXPECT_TRUE(results.complete);
    const std::pair<std::string, std::string> said("processor alone", "not measured: OpenGL is a card.");
    EXPECT_EQ(std::count(results.made.begin(), results.made.end(), said), 1);
    EXPECT_EQ(results.scenes.size(), 2u);
    for (const ChartPoint& point : results.points) {
        ASSERT_TRUE(point.cost) << point.failure;
        EXPECT_FALSE(point.cost->steadyAlone);
    }
}

TEST(OtherProcess, WordsReachItAsTheyAre) {
    const std::string word = "a 'b' \"$c\" `d` \\ *";
    EXPECT_EQ(runCommand("printf '%s\n' " + shellWord(word)).said, word + "\n");
}

} // namespace
