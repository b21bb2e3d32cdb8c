// SPDX-License-Identifier: MIT
// What results.json holds, and what of it a run that goes on keeps.
#include "../io/Program.h"
#include "ChartResults.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <limits>

namespace {

using namespace gnomon::examples;
using namespace gnomon::testing;
using gnomon::metrics::BoundaryDistance;
using gnomon::metrics::CauseSplit;
using gnomon::metrics::Confusion;
using gnomon::metrics::IntensityError;
using gnomon::metrics::ShadowMetrics;
using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();
const double nan = std::nan("");

/// Values that no other field has, so that a swapped field shows. A third has no short decimal form.
struct Counter {
    double number() { return ++_last + 1.0 / 3.0; }
    unsigned count() { return ++_last; }
    AddedTime time() { return {number(), number(), number()}; }
    Confusion confusion() { return {count(), count(), count(), count()}; }
    IntensityError intensity() { return {number(), number()}; }

private:
    unsigned _last = 0;
};

ChartCost fullCost(Counter& next) {
    return {next.number(), next.time(),   next.time(),  next.time(),  next.time(), next.time(),
            next.time(),   next.number(), next.count(), next.count(), next.count()};
}

ShadowMetrics fullErrors(Counter& next) {
    ShadowMetrics m;
    m.agreeing = next.count();
    m.facing = next.count();
    m.certain = next.count();
    m.unmeasured = next.count();
    m.droppedShare = next.number();
    m.sound = false;
    for (Confusion* set : {&m.headline, &m.raw, &m.terminator, &m.selfShadowed}) *set = next.confusion();
    m.turnedAwayWrong = next.count();
    m.teeth = next.count();
    m.boundary =
        BoundaryDistance{next.number(), next.number(), next.number(), next.number(), next.number(), next.number()};
    m.causes = CauseSplit{next.count(), next.count(), next.count(),  next.count(),  next.count(),
                          next.count(), next.count(), next.number(), next.number(), next.number()};
    for (IntensityError* error : {&m.pointSun, &m.discSun, &m.thin}) *error = next.intensity();
    m.catastrophes = {next.count(), true, false, true};
    return m;
}

/// A point with every field, and names that quote, break lines and are not ASCII.
ChartPoint fullPoint() {
    Counter next;
    ChartPoint point;
    point.scene = "stadt-groß";
    point.kit = "Gnomon";
    point.technique = "map \"soft\", 'wide'";
    point.setting = "size 1024; ½ texel";
    point.settings = {{"size", "1024"}, {"filter", "a,b\"c\""}};
    point.cost = fullCost(next);
    point.errors = fullErrors(next);
    point.shadedRmse = next.number();
    point.flickerEnergy = next.number();
    point.flickerShare = next.number();
    point.crawl = next.number();
    point.prediction = {{"volume", next.number(), {"map", next.number()}, {"map:size=512", next.number()}}};
    point.picture = "pictures/a b.png";
    point.overlay = "pictures/ö.png";
    point.notes = {"GL_INVALID_ENUM in\n\"glEnable\"", "影"};
    return point;
}

ChartSceneResult fullScene() {
    return {"stadt-groß",         "A town\t<b>",         3000000, 1.0 / 3.0, 0.25, 4.75, 0.5,
            "pictures/truth.png", {{"light", "1,2,3,0"}}};
}

ChartResults fullResults() {
    ChartResults results;
    results.made = {{"renderer", "llvmpipe (LLVM 15.0.6, 256 bits)"}, {"command", "gnomonchart --out \"x y\""}};
    results.complete = true;
    results.scenes = {fullScene()};
    results.points = {fullPoint(), ChartPoint()};
    results.points[1].failure = "It crashed: signal 11.";
    return results;
}

class ResultsFile : public ::testing::Test {
protected:
    std::string file() const { return (folder.path() / "results.json").string(); }
    json saved(const ChartResults& results) {
        saveResults(results, folder.path().string());
        return json::parse(readFile(file()));
    }
    std::string refusalOf(const std::string& bytes) {
        folder.write("results.json", bytes);
        try {
            loadResults(folder.path().string());
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "not refused";
    }

    TemporaryFolder folder;
};

TEST_F(ResultsFile, HoldsTextAsItIsAndNumbersThatJsonHasNotAsText) {
    ChartResults results = fullResults();
    results.points[0].cost->first = nan;
    results.points[0].cost->steadyWall = {-infinity, 0.0, infinity};
    results.points[0].errors->boundary.reset();
    results.points[0].cost->movingAlone.reset();
    results.points[0].notes = {"a\xff" // no UTF-8
                               "b",
                               "影"};
    const json file = saved(results), &point = file["points"][0], &failed = file["points"][1];
    EXPECT_EQ(point["technique"], "map \"soft\", 'wide'");
    EXPECT_EQ(point["settings"], json::parse(R"([["size", "1024"], ["filter", "a,b\"c\""]])"));
    EXPECT_EQ(point["notes"], json({"a\xef\xbf\xbd"
                                    "b",
                                    "影"}));
    EXPECT_EQ(point["cost"]["firstMs"], "NaN");
    EXPECT_EQ(point["cost"]["steadyWallMs"], json({{"q1", "-Infinity"}, {"median", 0.0}, {"q3", "Infinity"}}));
    EXPECT_TRUE(point["errors"]["boundaryPixels"].is_null());
    EXPECT_TRUE(point["cost"]["movingAloneMs"].is_null());
    EXPECT_TRUE(failed["cost"].is_null() && failed["errors"].is_null() && failed["prediction"].is_null());
    EXPECT_EQ(failed["failure"], "It crashed: signal 11.");
    EXPECT_EQ(folder.list(), std::vector<std::string>{"results.json"});
}

TEST_F(ResultsFile, KeepsAnEarlierRunsToTheBitBeforeItsOwn) {
    const json earlier = saved(fullResults());
    ChartResults more;
    more.kept = loadResults(folder.path().string());
    more.points = {ChartPoint()};
    const json both = saved(more);
    EXPECT_EQ(both["scenes"], earlier["scenes"]);
    ASSERT_EQ(both["points"].size(), 3u);
    for (int i : {0, 1}) EXPECT_EQ(both["points"][i], earlier["points"][i]);
}

/// Where results.json holds what fullPoint() counts, in the order in which it does.
std::vector<std::string> countedPlaces() {
    std::vector<std::string> places;
    const auto add = [&places](const std::string& part, const std::vector<const char*>& names) {
        for (const char* name : names) places.push_back(part + "/" + name);
    };
    add("/cost", {"firstMs"});
    for (const char* time :
         {"steadyWallMs", "steadyProcessorMs", "movingWallMs", "movingProcessorMs", "steadyAloneMs", "movingAloneMs"})
        add(std::string("/cost/") + time, {"q1", "median", "q3"});
    add("/cost", {"memoryMiB", "draws", "passes", "triangles"});
    add("/errors/pixels", {"R", "R+", "Rc", "unmeasured", "droppedShare"});
    for (const char* set : {"awayFromEdges", "raw", "terminator", "selfShadowed"})
        add(std::string("/errors/") + set, {"shadow", "falseShadow", "falseLit", "lit"});
    add("/errors", {"turnedAwayWrong", "teeth"});
    add("/errors/boundaryPixels", {"mean", "p95", "max", "signedMean", "drawnLength", "trueLength"});
    add("/errors/causes", {"acne", "halo", "peterPanning", "leak", "erosion", "overDark", "overBright", "acneShare",
                           "peterPanningShare", "gapMetres"});
    for (const char* error : {"rmsePointSun", "rmseDiscSun", "rmsePointSunFiltered4x4"})
        add(std::string("/errors/") + error, {"all", "penumbra"});
    add("/errors/catastrophes", {"notFinitePixels"});
    add("", {"shadedRmse", "flickerEnergy", "flickerShare", "crawlPixels"});
    add("/prediction", {"boundaryP95Pixels", "steadyProcessor/ms", "movingProcessor/ms"});
    return places;
}

TEST_F(ResultsFile, EveryNumberStandsUnderItsOwnName) {
    const json point = saved(fullResults())["points"][0];
    const std::vector<std::string> places = countedPlaces();
    ASSERT_EQ(places.size(), 76u);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const json number = point.value(json::json_pointer(places[i]), json());
        const double third = number.is_number_float() ? 1.0 / 3.0 : 0.0; // see Counter
        EXPECT_EQ(number, double(i + 1) + third) << places[i];
    }
}

TEST_F(ResultsFile, RefusesABrokenOrMissingFileInOneSentence) {
    saveResults(fullResults(), folder.path().string());
    const std::string whole = readFile(file()), begin = "\"" + file() + "\" cannot be read as results of gnomonchart: ";
    const auto changed = [&](const std::string& old, const std::string& by) {
        std::string text = whole;
        return refusalOf(text.replace(text.find(old), old.size(), by));
    };
    EXPECT_EQ(refusalOf(whole.substr(0, whole.size() / 2)), begin + "it is not a complete JSON file.");
    EXPECT_EQ(refusalOf(""), begin + "it is not a complete JSON file.");
    EXPECT_EQ(refusalOf("[]"), begin + "it is not a complete JSON file.");
    EXPECT_EQ(changed("\"gnomonchart\": 2", "\"gnomonchart\": 1"), begin + "its version is not 2.");
    EXPECT_EQ(changed("\"points\"", "\"p\""), begin + "\"points\" is missing.");
    std::filesystem::remove(file());
    try {
        loadResults(folder.path().string());
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "there is no file \"" + file() + "\". Give the folder of a run of gnomonchart.");
    }
    EXPECT_THROW(saveResults({}, file()), std::runtime_error);
}

} // namespace
