// SPDX-License-Identifier: MIT
#include "StabilityFiles.h"

#include "JsonFields.h"
#include "OutputFile.h"

#include <filesystem>

namespace gnomon::examples {

using nlohmann::json;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityJudgement> judgement) {
    way.field("p95Pixels", judgement.p95);
    way.field("floorPixels", judgement.floor);
    way.field("wrong", judgement.wrong);
    way.field("turnedAwayWrong", judgement.turnedAwayWrong);
    way.field("shadow", judgement.shadow);
    way.field("iou", judgement.iou);
    way.field("lost", judgement.lost);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityCell> cell) {
    way.field("failure", cell.failure);
    way.field("message", cell.message);
    way.field("measured", cell.measured);
    way.object("everywhere", cell.everywhere);
    way.object("onReceiver", cell.onReceiver);
    way.field("notFinite", cell.notFinite);
    way.field("diagnosis", cell.diagnosis);
    way.field("notes", cell.notes);
    way.field("picture", cell.picture);
    way.derived("inBudget", cell.inBudget());
    way.derived("catastrophe", cell.catastrophe());
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityFlicker> flicker) {
    way.field("flickerValue", flicker.value);
    way.field("flickerEnergy", flicker.energy);
    way.field("flickerShare", flicker.share);
    way.field("crawlPixels", flicker.crawl);
    way.field("rayCrawlPixels", flicker.rayCrawl);
    way.field("flickerTurnedAwayWrong", flicker.turnedAwayWrong);
    way.field("flickerPicture", flicker.picture);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityRow> row) {
    way.field("scene", row.scene);
    way.field("kit", row.kit);
    way.field("technique", row.technique);
    way.field("setting", row.setting);
    way.field("settings", row.settings);
    way.derived("outcome", std::string(nameOf(row.outcome())));
    way.derived("reach", row.reach());
    fields(way, row.flicker);
    way.list("cells", row.cells);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilitySceneText> scene) {
    way.field("id", scene.id);
    way.field("section", scene.section);
    way.field("title", scene.title);
    way.field("about", scene.about);
    way.field("parameter", scene.parameter);
    way.field("unit", scene.unit);
    way.field("values", scene.values);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityResults> results) {
    way.field("complete", results.complete);
    way.field("made", results.made);
    way.list("scenes", results.scenes);
    way.list("rows", results.rows);
}

namespace {

template <class Part>
ordered_json written(const Part& part) {
    ordered_json object;
    FieldWriter way(object);
    fields(way, part);
    return object;
}

template <class Part>
Part partOf(const json& object) {
    Part part;
    FieldReader way(object);
    fields(way, part);
    return part;
}

} // namespace

json jsonOf(const StabilityCell& cell) { return written(cell); }
json jsonOf(const StabilityFlicker& flicker) { return written(flicker); }

StabilityCell cellOf(const json& object) { return partOf<StabilityCell>(object); }
StabilityFlicker flickerOf(const json& object) { return partOf<StabilityFlicker>(object); }

void saveStability(const StabilityResults& results, const std::string& folder) {
    ordered_json object;
    FieldWriter way(object);
    fields(way, results);
    OutputFile((fs::path(folder) / "stability.json").string()).write(resultsText(object));
}

} // namespace gnomon::examples
