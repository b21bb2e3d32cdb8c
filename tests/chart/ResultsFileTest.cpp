// SPDX-License-Identifier: MIT
// results.json there and back.
#include "../io/Program.h"
#include "ChartResults.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
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
    return {next.number(), next.time(),  next.time(),  next.time(), next.time(),
            next.number(), next.count(), next.count(), next.count()};
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
    return {"stadt-groß", "A town\t<b>", 3000000, 1.0 / 3.0, 0.25, 4.75, "pictures/truth.png", {{"light", "1,2,3,0"}}};
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
    std::string saved(const ChartResults& results) {
        saveResults(results, folder.path().string());
        return readFile(file());
    }
    std::string refusalOf(const std::string& bytes) {
        folder.write("results.json", bytes);
        try {
            loadResults(file());
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "not refused";
    }

    TemporaryFolder folder;
};

/// With EveryNumberStandsUnderItsOwnName: what is written is read.
TEST_F(ResultsFile, IsTheSameToTheBitWhenItIsReadAndWrittenAgain) {
    ChartResults results = fullResults();
    results.points.push_back(fullPoint());
    results.points[2].cost->first = nan;
    results.points[2].cost->steadyWall = {-infinity, 0.0, infinity};
    results.points[2].errors->boundary.reset();
    const std::string text = saved(results);
    const ChartResults back = loadResults(file());
    EXPECT_EQ(saved(back), text);
    EXPECT_EQ(back.points[0].technique, "map \"soft\", 'wide'");
    EXPECT_EQ(back.points[0].notes[1], "影");
    EXPECT_EQ(back.points[0].cost->steadyWall.median, 3.0 + 1.0 / 3.0); // the counter's third
    EXPECT_TRUE(std::isnan(back.points[2].cost->first));
    EXPECT_EQ(back.points[2].cost->steadyWall.q1, -infinity);
    EXPECT_FALSE(back.points[2].errors->boundary);
    EXPECT_FALSE(back.points[1].cost || back.points[1].errors || back.points[1].prediction);
    EXPECT_EQ(folder.list(), std::vector<std::string>{"results.json"});
}

TEST_F(ResultsFile, TextThatIsNotUtf8IsMended) {
    ChartResults results = fullResults();
    results.points[0].notes = {"a\xff"
                               "b"};
    saved(results);
    EXPECT_EQ(loadResults(file()).points.at(0).notes.at(0), "a\xef\xbf\xbd"
                                                            "b");
}

/// Where results.json holds what fullPoint() counts, in the order in which it does.
const std::vector<const char*> countedPlaces{"/cost/firstMs",
                                             "/cost/steadyWallMs/q1",
                                             "/cost/steadyWallMs/median",
                                             "/cost/steadyWallMs/q3",
                                             "/cost/steadyProcessorMs/q1",
                                             "/cost/steadyProcessorMs/median",
                                             "/cost/steadyProcessorMs/q3",
                                             "/cost/movingWallMs/q1",
                                             "/cost/movingWallMs/median",
                                             "/cost/movingWallMs/q3",
                                             "/cost/movingProcessorMs/q1",
                                             "/cost/movingProcessorMs/median",
                                             "/cost/movingProcessorMs/q3",
                                             "/cost/memoryMiB",
                                             "/cost/draws",
                                             "/cost/passes",
                                             "/cost/triangles",
                                             "/errors/pixels/R",
                                             "/errors/pixels/R+",
                                             "/errors/pixels/Rc",
                                             "/errors/pixels/unmeasured",
                                             "/errors/pixels/droppedShare",
                                             "/errors/awayFromEdges/shadow",
                                             "/errors/awayFromEdges/falseShadow",
                                             "/errors/awayFromEdges/falseLit",
                                             "/errors/awayFromEdges/lit",
                                             "/errors/raw/shadow",
                                             "/errors/raw/falseShadow",
                                             "/errors/raw/falseLit",
                                             "/errors/raw/lit",
                                             "/errors/terminator/shadow",
                                             "/errors/terminator/falseShadow",
                                             "/errors/terminator/falseLit",
                                             "/errors/terminator/lit",
                                             "/errors/selfShadowed/shadow",
                                             "/errors/selfShadowed/falseShadow",
                                             "/errors/selfShadowed/falseLit",
                                             "/errors/selfShadowed/lit",
                                             "/errors/turnedAwayWrong",
                                             "/errors/boundaryPixels/mean",
                                             "/errors/boundaryPixels/p95",
                                             "/errors/boundaryPixels/max",
                                             "/errors/boundaryPixels/signedMean",
                                             "/errors/boundaryPixels/drawnLength",
                                             "/errors/boundaryPixels/trueLength",
                                             "/errors/causes/acne",
                                             "/errors/causes/halo",
                                             "/errors/causes/peterPanning",
                                             "/errors/causes/leak",
                                             "/errors/causes/erosion",
                                             "/errors/causes/overDark",
                                             "/errors/causes/overBright",
                                             "/errors/causes/acneShare",
                                             "/errors/causes/peterPanningShare",
                                             "/errors/causes/gapMetres",
                                             "/errors/rmsePointSun/all",
                                             "/errors/rmsePointSun/penumbra",
                                             "/errors/rmseDiscSun/all",
                                             "/errors/rmseDiscSun/penumbra",
                                             "/errors/rmsePointSunFiltered4x4/all",
                                             "/errors/rmsePointSunFiltered4x4/penumbra",
                                             "/errors/catastrophes/notFinitePixels",
                                             "/shadedRmse",
                                             "/flickerEnergy",
                                             "/flickerShare",
                                             "/crawlPixels",
                                             "/prediction/boundaryP95Pixels",
                                             "/prediction/steadyProcessor/ms",
                                             "/prediction/movingProcessor/ms"};

TEST_F(ResultsFile, EveryNumberStandsUnderItsOwnName) { // one list serves both ways: two names swapped would come back
    saveResults(fullResults(), folder.path().string());
    const json point = json::parse(readFile(file()))["points"][0];
    for (std::size_t i = 0; i < countedPlaces.size(); ++i) {
        const json number = point.value(json::json_pointer(countedPlaces[i]), json());
        const double third = number.is_number_float() ? 1.0 / 3.0 : 0.0; // see Counter
        EXPECT_EQ(number, double(i + 1) + third) << countedPlaces[i];
    }
}

TEST_F(ResultsFile, RefusesABrokenFileInOneSentence) {
    saveResults(fullResults(), folder.path().string());
    const std::string whole = readFile(file()), begin = "\"" + file() + "\" cannot be read as results of gnomonchart: ";
    const auto changed = [&](const std::string& old, const std::string& by) {
        std::string text = whole;
        return refusalOf(text.replace(text.find(old), old.size(), by));
    };
    EXPECT_EQ(refusalOf(whole.substr(0, whole.size() / 2)), begin + "it is not a complete JSON file.");
    EXPECT_EQ(refusalOf(""), begin + "it is not a complete JSON file.");
    EXPECT_EQ(refusalOf("[]"), begin + "\"gnomonchart\" is missing.");
    EXPECT_EQ(changed("\"gnomonchart\": 2", "\"gnomonchart\": 1"), begin + "its version is 1. Allowed: 2.");
    EXPECT_EQ(changed("\"complete\": true", "\"complete\": 1"), begin + "\"complete\" is of another kind.");
    EXPECT_EQ(changed("\"triangles\": 3000000", "\"triangles\": -3"),
              begin + "scenes[0]: \"triangles\" is of another kind.");
    EXPECT_EQ(changed("\"firstMs\"", "\"f\""), begin + "points[0]: cost: \"firstMs\" is missing.");
    EXPECT_EQ(changed("\"p95\"", "\"p\""), begin + "points[0]: errors: boundaryPixels: \"p95\" is missing.");
    EXPECT_EQ(changed("\"causes\": {", "\"causes\": 3, \"c\": {"),
              begin + "points[0]: errors: causes: \"acne\" is missing.");
    EXPECT_EQ(changed("\"影\"", "7"), begin + "points[0]: \"notes\" is of another kind.");
}

TEST_F(ResultsFile, RefusesAFileThatIsNotThere) {
    const std::string gone = (folder.path() / "gone.json").string();
    try {
        loadResults(gone);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "there is no file \"" + gone + "\". Give the results.json of a run of gnomonchart.");
    }
    EXPECT_THROW(loadResults(folder.path().string()), std::runtime_error);
    EXPECT_THROW(saveResults({}, gone), std::runtime_error);
}

} // namespace
