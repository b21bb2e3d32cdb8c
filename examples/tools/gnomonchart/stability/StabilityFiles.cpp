// SPDX-License-Identifier: MIT
#include "StabilityFiles.h"

#include "../report/CsvText.h"
#include "JsonFields.h"
#include "JsonFile.h"
#include "OutputFile.h"

#include <filesystem>
#include <sstream>

namespace gnomon::examples {

using nlohmann::json;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityJudgement> judgement) {
    way.field("p95Pixels", judgement.p95);
    way.field("floorPixels", judgement.floor);
    way.field("wrong", judgement.wrong);
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

constexpr const char* csvHeader =
    "scene,parameter,value,unit,kit,technique,setting,outcome,failure,p95_px,wrong_px,shadow_px,iou,"
    "receiver_p95_px,receiver_wrong_px,receiver_iou,not_finite,in_budget,catastrophe,stated,diagnosis\r\n";

std::string judgementFields(const StabilityJudgement& judged, bool withShadow) {
    std::ostringstream out;
    out.precision(17);
    out << "," << (judged.p95 ? valueText(*judged.p95) : "") << "," << judged.wrong;
    if (withShadow) out << "," << judged.shadow;
    out << "," << valueText(judged.iou);
    return out.str();
}

std::string csvLine(const StabilitySceneText& scene, const StabilityRow& row, std::size_t place) {
    const StabilityCell& cell = row.cells[place];
    const auto yes = [](bool is) { return is ? ",yes" : ",no"; };
    std::string line = csvField(scene.id) + "," + csvField(scene.parameter) + "," + valueText(scene.values[place]) +
                       "," + csvField(scene.unit) + "," + row.kit + "," + csvField(row.technique) + "," +
                       csvField(row.setting) + "," + nameOf(row.outcome()) + "," + cell.failure;
    line += judgementFields(cell.everywhere, true);
    line += cell.onReceiver ? judgementFields(*cell.onReceiver, false) : ",,,";
    line += "," + std::to_string(cell.notFinite);
    line += yes(cell.inBudget());
    line += yes(cell.catastrophe());
    line += yes(cell.stated());
    return line + "," + csvField(cell.message.empty() ? joined(cell.diagnosis, " ") : cell.message) + "\r\n";
}

std::string csvOf(const StabilityResults& results) {
    std::string text = csvHeader;
    for (const StabilitySceneText& scene : results.scenes)
        for (const StabilityRow& row : results.rows)
            for (std::size_t place = 0; row.scene == scene.id && place < row.cells.size(); ++place)
                text += csvLine(scene, row, place);
    return text;
}

template <class Part>
json written(const Part& part) {
    json object;
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
    OutputFile((fs::path(folder) / "stability.csv").string()).write(csvOf(results));
}

StabilityResults loadStability(const std::string& file) {
    StabilityResults results;
    readResultsFile(file, "stability.json", "gnomonchart --stability", [&](const json& object) {
        FieldReader way(object);
        fields(way, results);
    });
    return results;
}

} // namespace gnomon::examples
