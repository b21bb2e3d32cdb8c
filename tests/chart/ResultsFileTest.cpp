// SPDX-License-Identifier: MIT
// results.json there and back, and as a second reader (Python's own json and csv) understands both files.
#include "ResultsFile.h"
#include "../io/Program.h"
#include "PointNumbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

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

auto tied(const AddedTime& t) { return std::tie(t.q1, t.median, t.q3); }
auto tied(const ChartCost& c) { return std::tie(c.first, c.memory, c.draws, c.passes, c.triangles); }
auto tied(const Confusion& c) { return std::tie(c.shadow, c.falseShadow, c.falseLit, c.lit); }
auto tied(const BoundaryDistance& b) {
    return std::tie(b.mean, b.p95, b.max, b.signedMean, b.drawnLength, b.trueLength);
}
auto tied(const CauseSplit& c) {
    return std::tie(c.acne, c.halo, c.peterPanning, c.leak, c.erosion, c.overDark, c.overBright, c.acneShare,
                    c.peterPanningShare, c.gap);
}
auto tied(const IntensityError& e) { return std::tie(e.all, e.penumbra); }
auto tied(const ShadowMetrics& m) {
    return std::tie(m.agreeing, m.facing, m.certain, m.unmeasured, m.droppedShare, m.sound, m.catastrophes.notFinite,
                    m.catastrophes.allShadowed, m.catastrophes.allLit, m.catastrophes.lostShadow);
}
auto tied(const ChartPrediction& p) {
    return std::tie(p.spec, p.error, p.steady.spec, p.steady.time, p.moving.spec, p.moving.time);
}
auto tied(const ChartPoint& p) {
    return std::tie(p.scene, p.kit, p.technique, p.setting, p.settings, p.shadedRmse, p.flickerEnergy, p.flickerShare,
                    p.crawl, p.picture, p.overlay, p.notes, p.failure);
}
auto tied(const ChartSceneResult& s) {
    return std::tie(s.name, s.title, s.triangles, s.misclassifiedFloor, s.boundaryFloor, s.frame, s.truthPicture,
                    s.view);
}

void expectSame(const ChartCost& a, const ChartCost& b) {
    EXPECT_EQ(tied(a), tied(b));
    EXPECT_EQ(tied(a.steadyWall), tied(b.steadyWall));
    EXPECT_EQ(tied(a.steadyProcessor), tied(b.steadyProcessor));
    EXPECT_EQ(tied(a.movingWall), tied(b.movingWall));
    EXPECT_EQ(tied(a.movingProcessor), tied(b.movingProcessor));
}

void expectSame(const ShadowMetrics& a, const ShadowMetrics& b) {
    EXPECT_EQ(tied(a), tied(b));
    EXPECT_EQ(tied(a.headline), tied(b.headline));
    EXPECT_EQ(tied(a.raw), tied(b.raw));
    EXPECT_EQ(tied(a.terminator), tied(b.terminator));
    EXPECT_EQ(tied(a.selfShadowed), tied(b.selfShadowed));
    EXPECT_EQ(tied(a.boundary.value()), tied(b.boundary.value()));
    EXPECT_EQ(tied(a.causes), tied(b.causes));
    EXPECT_EQ(tied(a.pointSun), tied(b.pointSun));
    EXPECT_EQ(tied(a.discSun), tied(b.discSun));
    EXPECT_EQ(tied(a.thin), tied(b.thin));
}

class ResultsFile : public ::testing::Test {
protected:
    std::string file() const { return (folder.path() / "results.json").string(); }
    ChartResults thereAndBack(const ChartResults& results) {
        saveResults(results, folder.path().string());
        return loadResults(file());
    }
    /// What Python prints, as JSON.
    json python(const std::string& script) {
        const Ending ending = runProgram(PYTHON3, {"-c", "import csv, json\n" + script}, folder.path());
        EXPECT_EQ(ending.status, 0) << ending.err;
        return json::parse(ending.out, nullptr, false);
    }
    /// results.csv as Python reads it: a list of objects.
    json rows() {
        return python("print(json.dumps(list(csv.DictReader(open('results.csv', encoding='utf-8', newline='')))))");
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

TEST_F(ResultsFile, EveryFieldComesBackToTheBit) {
    const ChartResults results = fullResults(), back = thereAndBack(results);
    EXPECT_EQ(back.made, results.made);
    EXPECT_TRUE(back.complete);
    ASSERT_EQ(back.scenes.size(), 1u);
    EXPECT_EQ(tied(back.scenes[0]), tied(results.scenes[0]));
    ASSERT_EQ(back.points.size(), 2u);
    EXPECT_EQ(tied(back.points[0]), tied(results.points[0]));
    expectSame(back.points[0].cost.value(), results.points[0].cost.value());
    expectSame(back.points[0].errors.value(), results.points[0].errors.value());
    EXPECT_EQ(tied(back.points[0].prediction.value()), tied(results.points[0].prediction.value()));
    EXPECT_EQ(tied(back.points[1]), tied(results.points[1]));
    EXPECT_FALSE(back.points[1].prediction);
}

TEST_F(ResultsFile, WhatDoesNotExistComesBackAsNothing) {
    ChartResults results;
    results.scenes = {ChartSceneResult()};
    results.points = {ChartPoint(), ChartPoint()};
    results.points[1].errors.emplace();
    const ChartResults back = thereAndBack(results);
    EXPECT_FALSE(back.complete);
    EXPECT_FALSE(back.scenes.at(0).boundaryFloor);
    EXPECT_FALSE(back.points.at(0).cost || back.points.at(0).errors || back.points.at(0).shadedRmse);
    EXPECT_FALSE(back.points.at(1).errors.value().boundary || back.points.at(1).errors.value().causes.gap);
    EXPECT_EQ(python("print(json.dumps(json.load(open('results.json'))['points'][0]['errors']))"), nullptr);
}

TEST_F(ResultsFile, NumbersThatAreNoneComeBack) {
    ChartResults results = fullResults();
    results.points[0].cost->first = nan;
    results.points[0].cost->steadyWall = {-infinity, 0.0, infinity};
    results.points[0].shadedRmse = nan;
    results.points[0].errors->boundary->max = infinity;
    const ChartPoint back = thereAndBack(results).points.at(0);
    EXPECT_TRUE(std::isnan(back.cost->first));
    EXPECT_EQ(back.cost->steadyWall.q1, -infinity);
    EXPECT_EQ(back.cost->steadyWall.q3, infinity);
    EXPECT_TRUE(std::isnan(back.shadedRmse.value()));
    EXPECT_EQ(back.errors->boundary->max, infinity);
    const json row = rows().at(0);
    EXPECT_EQ(row["added_first_ms"], "NaN");
    EXPECT_EQ(row["added_steady_wall_q1_ms"], "-Infinity");
    EXPECT_EQ(row["added_steady_wall_ms"], "0");
    EXPECT_EQ(row["boundary_max_px"], "Infinity");
}

TEST_F(ResultsFile, TextThatIsNotUtf8IsMendedAndNothingElseIsLost) {
    ChartResults results = fullResults();
    results.points[0].notes = {"a\xff"
                               "b"};
    const ChartResults back = thereAndBack(results);
    EXPECT_EQ(back.points.at(0).notes.at(0), "a\xef\xbf\xbd"
                                             "b");
    EXPECT_EQ(back.points.size(), 2u);
    EXPECT_EQ(rows().at(0)["notes"], back.points.at(0).notes.at(0));
}

TEST_F(ResultsFile, AnotherReaderFindsTheSameInTheJson) {
    saveResults(fullResults(), folder.path().string());
    const json found = python("print(json.dumps(json.load(open('results.json', encoding='utf-8'))))");
    const json point = found["points"][0];
    EXPECT_EQ(found["made"][1][1], "gnomonchart --out \"x y\"");
    EXPECT_EQ(point["technique"], "map \"soft\", 'wide'");
    EXPECT_EQ(point["notes"][1], "影");
    EXPECT_EQ(point["catastrophic"], true);
    EXPECT_EQ(point["cost"]["firstMs"], 1.0 + 1.0 / 3.0); // the counter's first
    EXPECT_EQ(point["cost"]["steadyWallMs"]["median"], 3.0 + 1.0 / 3.0);
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

TEST_F(ResultsFile, TheCsvHasALineAPointWithNamesUnitsAndEveryNumber) {
    const ChartResults results = fullResults();
    saveResults(results, folder.path().string());
    const json found = rows();
    ASSERT_EQ(found.size(), 2u);
    const json row = found[0];
    EXPECT_EQ(row["scene"], "stadt-groß");
    EXPECT_EQ(row["technique"], "map \"soft\", 'wide'");
    EXPECT_EQ(row["settings"], "size=1024; filter=a,b\"c\"");
    EXPECT_EQ(row["notes"], "GL_INVALID_ENUM in\n\"glEnable\"; 影");
    EXPECT_EQ(row["catastrophic"], "yes");
    EXPECT_EQ(row["overlay"], "pictures/ö.png");
    EXPECT_EQ(std::stod(row["added_first_ms"].get<std::string>()), 1.0 + 1.0 / 3.0);
    EXPECT_EQ(std::stod(row["added_moving_wall_ms"].get<std::string>()), results.points[0].cost->movingWall.median);
    EXPECT_EQ(std::stod(row["boundary_p95_px"].get<std::string>()), results.points[0].errors->boundary->p95);
    EXPECT_EQ(row["acne_px"], std::to_string(results.points[0].errors->causes.acne));
    EXPECT_EQ(std::stod(row["flicker_share_percent"].get<std::string>()), 100.0 * *results.points[0].flickerShare);
    EXPECT_EQ(row["predicted_spec"], "volume");
    EXPECT_EQ(row["predicted_moving_spec"], "map:size=512");
    EXPECT_EQ(std::stod(row["predicted_boundary_p95_px"].get<std::string>()), results.points[0].prediction->error);
    EXPECT_EQ(row.size(), 13 + pointNumbers().size());
    EXPECT_FALSE(row.contains("null")); // Python's name for what is beyond the header
    EXPECT_EQ(found[1]["failure"], "It crashed: signal 11.");
    EXPECT_EQ(found[1]["added_first_ms"], "");
}

TEST_F(ResultsFile, LeavesNothingButItsTwoFiles) {
    saveResults(fullResults(), folder.path().string());
    saveResults(fullResults(), folder.path().string());
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"results.csv", "results.json"}));
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
    EXPECT_EQ(changed("\"complete\": true", "\"complete\": 1"), begin + "\"complete\" is neither true nor false.");
    EXPECT_EQ(changed("\"triangles\": 3000000", "\"triangles\": -3"),
              begin + "scenes[0]: \"triangles\" is not a whole number of 0 or more.");
    EXPECT_EQ(changed("\"firstMs\"", "\"f\""), begin + "points[0]: cost: \"firstMs\" is missing.");
    EXPECT_EQ(changed("\"p95\"", "\"p\""), begin + "points[0]: errors: boundaryPixels: \"p95\" is missing.");
    EXPECT_EQ(changed("\"causes\": {", "\"causes\": 3, \"c\": {"),
              begin + "points[0]: errors: \"causes\" is not an object.");
    EXPECT_EQ(changed("\"影\"", "7"), begin + "points[0]: notes: it is not a string.");
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
