// SPDX-License-Identifier: MIT
// gnomonchart as users run it, small and short.
#include "../io/Program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <exception>
#include <filesystem>
#include <set>
#include <sstream>

namespace {

using namespace gnomon::testing;
using nlohmann::json;
using Arguments = std::vector<std::string>;
namespace fs = std::filesystem;

const std::string lab8 = GNOMON_DATA "/lab8.osgt";

/// A tenth of a second a contender and frame, two contenders.
Arguments small(const std::string& out, const std::string& technique = "Standard") {
    return {lab8, "--quick", "--size", "160x120", "--frames", "3", "--technique", technique, "--out", out};
}

class Gnomonchart : public ::testing::Test {
protected:
    Ending run(const Arguments& arguments) { return runProgram(GNOMONCHART, arguments, folder.path()); }
    json results(const std::string& out) { return json::parse(readFile(folder.path() / out / "results.json")); }

    /// The one sentence of a run that must be refused.
    std::string refusal(const Arguments& arguments) {
        const Ending ending = run(arguments);
        EXPECT_EQ(ending.status, 1) << ending.err;
        EXPECT_EQ(ending.out, "");
        EXPECT_EQ(ending.err.find('\n'), ending.err.size() - 1) << ending.err;
        const std::string prefix = "gnomonchart: ";
        EXPECT_EQ(ending.err.rfind(prefix, 0), 0u) << ending.err;
        return ending.err.substr(std::min(prefix.size(), ending.err.size()));
    }

    TemporaryFolder folder;
};

TEST_F(Gnomonchart, AFileOfOnesOwnGetsItsNumbersAndPictures) {
    const Ending ending = run(small("o"));
    ASSERT_EQ(ending.status, 0) << ending.err;
    EXPECT_EQ(ending.err, ""); // progress is for terminals
    EXPECT_NE(ending.out.find("lab8: Standard is best with"), std::string::npos) << ending.out;
    const json r = results("o");
    EXPECT_EQ(r["complete"], true);
    ASSERT_EQ(r["scenes"].size(), 1u);
    EXPECT_EQ(r["scenes"][0]["name"], "lab8");
    EXPECT_GT(r["scenes"][0]["triangles"], 100);
    EXPECT_GT(r["scenes"][0]["frameMs"], 0.0);
    EXPECT_TRUE(fs::exists(folder.path() / "o" / r["scenes"][0]["truthPicture"].get<std::string>()));
    ASSERT_EQ(r["points"].size(), 2u);
    EXPECT_EQ(r["points"][0]["setting"], "defaults");
    EXPECT_EQ(r["points"][1]["setting"], "best");
    for (const json& point : r["points"]) {
        EXPECT_EQ(point["failure"], "");
        for (const char* name : {"errors", "cost", "shadedRmse", "flickerEnergy", "crawlPixels"})
            ASSERT_FALSE(point[name].is_null()) << name;
        EXPECT_GT(point["errors"]["awayFromEdges"]["iou"], 0.8);
        EXPECT_GT(point["cost"]["steadyWallMs"]["median"], 0.0);
        EXPECT_TRUE(point["cost"]["movingAloneMs"].is_object());
        EXPECT_EQ(point["cost"]["passes"], 2); // once for the light, once for the eye
        for (const char* name : {"picture", "overlay"})
            EXPECT_TRUE(fs::exists(folder.path() / "o" / point[name].get<std::string>())) << name;
    }
    EXPECT_TRUE(fs::exists(folder.path() / "o" / "results.csv"));
    EXPECT_NE(readFile(folder.path() / "o" / "index.html").find("lab8"), std::string::npos);
}

/// Names that the shell and the parser of options would take apart reach the process that draws nothing as they are. Rays have no
/// time there: depths that nothing draws start them anywhere.
TEST_F(Gnomonchart, EachPointHasItsTimeOnTheProcessorAlone) {
    fs::copy_file(lab8, folder.path() / "a 'b' $c.osgt");
    const Ending ending = run({"a 'b' $c.osgt", "--quick", "--size=160x120", "--frames", "8", "--technique", "volume",
                               "--technique", "traced", "--brief", "--flicker=0", "--out", "o"});
    ASSERT_EQ(ending.status, 0) << ending.err;
    const json r = results("o");
    EXPECT_GT(r["scenes"][0]["frameAloneMs"], 0.0);
    EXPECT_LT(r["scenes"][0]["frameAloneMs"], r["scenes"][0]["frameMs"]);
    ASSERT_EQ(r["points"].size(), 6u);
    for (const json& point : r["points"])
        for (const char* name : {"steadyAloneMs", "movingAloneMs"}) {
            const json& time = point["cost"][name];
            ASSERT_EQ(time.is_null(), point["technique"] == "traced") << point["technique"] << ", " << point["setting"];
            if (time.is_null()) continue;
            EXPECT_GT(time["median"], 0.0) << name << " of " << point["setting"];
            EXPECT_LE(time["q1"], time["q3"]);
        }
    EXPECT_NE(readFile(folder.path() / "o" / "index.html").find("<th>processor alone, still light</th>"),
              std::string::npos);
}

TEST_F(Gnomonchart, AModelIsJudgedUnderTwoSunsAgainstRays) {
    const Ending ending = run({"--model", lab8, "--technique", "none", "--technique", "traced"});
    ASSERT_EQ(ending.status, 0) << ending.err;
    std::istringstream lines(ending.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        const json row = json::parse(line);
        EXPECT_GT(row["judged"], 1000) << line;
        if (row["technique"] == "traced")
            EXPECT_EQ(row["wrong"], 0) << line;
        else
            EXPECT_GT(row["wrong"], 10) << line;
    }
    EXPECT_EQ(count, 4);
}

TEST_F(Gnomonchart, PointsHaveWhatAutoPredictsBesideWhatWasMeasured) {
    Arguments both = small("o", "auto");
    both.insert(both.end(), {"--technique", "volume", "--flicker", "0"});
    const Ending ending = run(both);
    ASSERT_EQ(ending.status, 0) << ending.err;
    EXPECT_NE(ending.out.find(" errors that auto predicts "), std::string::npos) << ending.out;
    EXPECT_NE(ending.out.find("auto keeps "), std::string::npos) << ending.out;
    std::set<std::string> techniques;
    const json file = results("o");
    for (const json& point : file["points"]) {
        techniques.insert(point["technique"].get<std::string>());
        const json& predicted = point["prediction"];
        if (point["technique"] != "auto") {
            EXPECT_TRUE(predicted.is_null()) << point["technique"];
            continue;
        }
        ASSERT_TRUE(predicted.is_object()) << point["setting"] << ": " << point["failure"];
        EXPECT_GT(predicted["boundaryP95Pixels"], 0.0);
        for (const json* part : {&predicted["steadyProcessor"], &predicted["movingProcessor"]})
            EXPECT_GT((*part)["ms"], 0.0);
        for (const json* part : {&predicted, &predicted["steadyProcessor"], &predicted["movingProcessor"]}) {
            const std::string spec = (*part)["spec"];
            EXPECT_FALSE(spec.empty() || spec.rfind("auto", 0) == 0) << spec;
        }
    }
    EXPECT_EQ(techniques, (std::set<std::string>{"auto", "volume", "volume, smooth"}));
}

TEST_F(Gnomonchart, TwoRunsGiveTheSameErrorsToTheDigitOneWithoutFlickerToo) {
    Arguments without = small("without", "SoftShadowMap");
    without.insert(without.end(), {"--flicker", "0"});
    ASSERT_EQ(run(small("with", "SoftShadowMap")).status, 0);
    ASSERT_EQ(run(without).status, 0);
    const json with = results("with")["points"];
    json less = results("without")["points"];
    ASSERT_EQ(less.size(), with.size());
    for (std::size_t i = 0; i < less.size(); ++i) {
        EXPECT_TRUE(less[i]["errors"]["boundaryPixels"].is_object());
        EXPECT_TRUE(less[i]["cost"].is_object());
        less[i]["cost"] = with[i]["cost"]; // which no two runs share
        for (const char* name : {"flickerEnergy", "flickerShare", "crawlPixels"}) {
            EXPECT_TRUE(less[i][name].is_null() && !with[i][name].is_null()) << name;
            less[i][name] = with[i][name];
        }
        for (const char* name : {"picture", "overlay"}) {
            const std::string file = with[i][name];
            EXPECT_EQ(readFile(folder.path() / "with" / file), readFile(folder.path() / "without" / file)) << file;
        }
    }
    EXPECT_EQ(less, with);
    EXPECT_TRUE(fs::exists(folder.path() / "without" / "index.html"));
}

/// Once something is measured, long before a run of all techniques can end.
TEST_F(Gnomonchart, AnInterruptedRunKeepsWhatItHas) {
    ChildProcess chart({GNOMONCHART, lab8, "--size", "64x48", "--out", "o"}, folder.path());
    const auto hasAPoint = [this] {
        try {
            return !results("o")["points"].empty();
        } catch (const std::exception&) { // there is no file yet
            return false;
        }
    };
    ASSERT_TRUE(waitFor(std::chrono::seconds(60), hasAPoint));
    chart.interrupt();
    EXPECT_EQ(chart.ended(std::chrono::seconds(60)), 130);
    const std::string said = readFile(folder.path() / "gnomonchart.err");
    EXPECT_NE(said.find("gnomonchart: interrupted. The results so far are kept.\n"), std::string::npos) << said;
    const json r = results("o");
    EXPECT_EQ(r["complete"], false);
    EXPECT_EQ(r["scenes"].size(), 1u);
    ASSERT_GE(r["points"].size(), 1u);
    EXPECT_TRUE(r["points"][0]["errors"].is_object());
    EXPECT_EQ(readFile(folder.path() / "o" / "results.csv").find("lab8"),
              readFile(folder.path() / "o" / "results.csv").find('\n') + 1);
}

/// What was measured keeps its times to the bit, which no second measurement would have; what was not is measured.
TEST_F(Gnomonchart, AResumedRunMeasuresOnlyWhatIsLeft) {
    const Arguments lab = {"--scene", "lab8-45",  "--scene", "lab8-10", "--technique", "Standard",  "--quick", "--size",
                           "160x120", "--frames", "3",       "--out",   "o",           "--flicker", "0"};
    ASSERT_EQ(run(lab).status, 0);
    const json before = results("o");
    json cut = before;
    cut["complete"] = false;
    cut["points"].erase(3);
    folder.write("o/results.json", cut.dump());
    Arguments more = lab;
    more.push_back("--resume");
    ASSERT_EQ(run(more).status, 0);
    const json after = results("o");
    ASSERT_EQ(after["points"].size(), 4u);
    EXPECT_EQ(after["complete"], true);
    for (int i : {0, 1}) EXPECT_EQ(after["points"][i], before["points"][i]) << "lab8-45";
    for (int i : {2, 3}) {
        EXPECT_EQ(after["points"][i]["errors"], before["points"][i]["errors"]) << "lab8-10";
        EXPECT_NE(after["points"][i]["cost"], before["points"][i]["cost"]) << "lab8-10";
    }
    more[10] = "4"; // --frames
    EXPECT_EQ(refusal(more),
              "--resume: the results in the folder were not made with frames 4. Leave --resume out to measure "
              "everything again.\n");
    more[12] = "elsewhere"; // --out
    EXPECT_NE(refusal(more).find("there is no file"), std::string::npos);
}

/// The map as it comes, the one with smooth edges, and the finest.
TEST_F(Gnomonchart, ABriefRunMeasuresDefaultsAndBests) {
    ASSERT_EQ(run({lab8, "--brief", "--quick", "--technique", "map", "--size", "160x120", "--frames", "2", "--flicker",
                   "0", "--out", "o"})
                  .status,
              0);
    ASSERT_EQ(results("o")["points"].size(), 3u);
    EXPECT_EQ(results("o")["points"][0]["settings"][0][1], "map");
}

TEST_F(Gnomonchart, WhatCannotBeDoneIsSaidInOneSentence) {
    EXPECT_NE(refusal({"--scene", "moon"}).find("no scene is named \"moon\". Allowed: lab8-45"), std::string::npos);
    EXPECT_EQ(refusal({lab8, "--technique", "volumetric"}),
              "no technique's name contains \"volumetric\". See --list.\n");
    EXPECT_EQ(refusal({lab8, "--technique", "map", "--technique", "volumetric"}),
              "no technique's name contains \"volumetric\". See --list.\n");
    EXPECT_NE(refusal({"missing.obj"}).find("missing.obj"), std::string::npos);
    EXPECT_EQ(refusal({lab8, "--scene", "room"}), "--scene and files exclude each other. Give one of them.\n");
    EXPECT_NE(refusal({lab8, "--frames", "1"}).find("2 to 10000"), std::string::npos);
    EXPECT_NE(refusal({lab8, "--flicker", "-1"}).find("0 to 1000"), std::string::npos);
    EXPECT_NE(refusal({"--stability", "Q9"}).find("no scene of the stability table is \"Q9\". Allowed: L1"),
              std::string::npos);
    EXPECT_NE(refusal({"--stability", "--scene", "room"}).find("--stability does not go with"), std::string::npos);
    EXPECT_EQ(
        refusal({"--stability", "--frames", "9"}),
        "--stability does not go with --frames. Allowed beside it: --technique, --out, --size, --quick, --again.\n");
    EXPECT_NE(refusal({"--stability", "--flicker", "9"}).find("does not go with --flicker"), std::string::npos);
    EXPECT_EQ(refusal({"--random", "5", "--size", "64x64"}),
              "--random does not go with --size. Allowed beside it: --seed, --technique.\n");
    EXPECT_NE(refusal({"--random", "5", "--out", "o"}).find("does not go with --out"), std::string::npos);
    EXPECT_NE(refusal({"--random", "5", lab8}).find("does not go with files"), std::string::npos);
    EXPECT_EQ(refusal({"--seed", "5"}), "--seed needs --random N.\n");
    EXPECT_NE(refusal({"--again", "o", "--frames", "9"}).find("does not go with --frames"), std::string::npos);
    EXPECT_NE(refusal({lab8, "--size", "16x16"}).find("32x32"), std::string::npos);
    EXPECT_NE(refusal({lab8, "--shadow", "planar"}).find("there is no option --shadow"), std::string::npos);
    folder.write("taken", "");
    EXPECT_NE(refusal({lab8, "--out", "taken"}).find("\"taken\" cannot be created as a folder"), std::string::npos);
}

TEST_F(Gnomonchart, MakesTheStabilityTable) {
    const Ending ending = run({"--stability", "L5", "--quick", "--technique", "planar", "--out", "o"});
    ASSERT_EQ(ending.status, 0) << ending.err;
    EXPECT_NE(ending.out.find("held to the end"), std::string::npos) << ending.out;
    for (const char* file :
         {"stability.csv", "stability.json", "stability.html", "stability.svg", "l5-planar-defaults-2.png"})
        EXPECT_TRUE(fs::exists(folder.path() / "o" / file)) << file;
}

TEST_F(Gnomonchart, ListsWhatItKnows) {
    const Ending ending = run({"--list"});
    EXPECT_EQ(ending.status, 0);
    for (const char* name : {"lab8-45", "room", "planar", "traced", "ShadowMap", "ViewDependent perspective x2"})
        EXPECT_NE(ending.out.find(std::string("  ") + name + "\n"), std::string::npos) << name;
    EXPECT_NE(run({"--help"}).out.find("--quick"), std::string::npos);
}

} // namespace
