// SPDX-License-Identifier: MIT
#include "ChartResults.h"

#include "JsonFields.h"
#include "OutputFile.h"
#include "Report.h"

#include <filesystem>
#include <stdexcept>

namespace gnomon::examples {

using nlohmann::json;
using nlohmann::ordered_json;

static constexpr unsigned version = 2;

template <class Way>
static void fields(Way& way, PartOf<Way, AddedTime> time) {
    way.field("q1", time.q1);
    way.field("median", time.median);
    way.field("q3", time.q3);
}

template <class Way>
static void fields(Way& way, PartOf<Way, ChartCost> cost) {
    way.field("firstMs", cost.first);
    way.object("steadyWallMs", cost.steadyWall);
    way.object("steadyProcessorMs", cost.steadyProcessor);
    way.object("movingWallMs", cost.movingWall);
    way.object("movingProcessorMs", cost.movingProcessor);
    way.field("memoryMiB", cost.memory);
    way.field("draws", cost.draws);
    way.field("passes", cost.passes);
    way.field("triangles", cost.triangles);
}

template <class Way>
static void fields(Way& way, PartOf<Way, PredictedTime> predicted) {
    way.field("spec", predicted.spec);
    way.field("ms", predicted.time);
}

template <class Way>
static void fields(Way& way, PartOf<Way, ChartPrediction> prediction) {
    way.field("spec", prediction.spec);
    way.field("boundaryP95Pixels", prediction.error);
    way.object("steadyProcessor", prediction.steady);
    way.object("movingProcessor", prediction.moving);
}

template <class Way>
static void fields(Way& way, PartOf<Way, ChartPoint> point) {
    way.field("scene", point.scene);
    way.field("kit", point.kit);
    way.field("technique", point.technique);
    way.field("setting", point.setting);
    way.field("settings", point.settings);
    way.field("failure", point.failure);
    way.derived("catastrophic", point.catastrophic());
    way.object("cost", point.cost);
    way.object("errors", point.errors);
    way.object("prediction", point.prediction);
    way.field("shadedRmse", point.shadedRmse);
    way.field("flickerEnergy", point.flickerEnergy);
    way.field("flickerShare", point.flickerShare);
    way.field("crawlPixels", point.crawl);
    way.field("picture", point.picture);
    way.field("overlay", point.overlay);
    way.field("notes", point.notes);
}

template <class Way>
static void fields(Way& way, PartOf<Way, ChartSceneResult> scene) {
    way.field("name", scene.name);
    way.field("title", scene.title);
    way.field("triangles", scene.triangles);
    way.field("misclassifiedFloor", scene.misclassifiedFloor);
    way.field("boundaryFloorPixels", scene.boundaryFloor);
    way.field("frameMs", scene.frame);
    way.field("truthPicture", scene.truthPicture);
    way.field("view", scene.view);
}

template <class Way>
static void fields(Way& way, PartOf<Way, ChartResults> results) {
    way.derived("gnomonchart", version);
    way.field("made", results.made);
    way.field("complete", results.complete);
    way.list("scenes", results.scenes);
    way.list("points", results.points);
}

void saveResults(const ChartResults& results, const std::string& folder) {
    ordered_json object;
    FieldWriter way(object);
    fields(way, results);
    OutputFile((std::filesystem::path(folder) / "results.json").string()).write(resultsText(object));
}

ChartResults loadResults(const std::string& file) {
    ChartResults results;
    readResultsFile(file, "results.json", "gnomonchart", [&](const json& object) {
        unsigned found = 0;
        FieldReader(object).field("gnomonchart", found);
        if (found != version) throw std::runtime_error("its version is " + std::to_string(found) + ". Allowed: 2.");
        FieldReader way(object);
        fields(way, results);
    });
    return results;
}

} // namespace gnomon::examples
