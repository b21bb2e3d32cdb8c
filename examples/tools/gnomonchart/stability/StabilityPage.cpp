// SPDX-License-Identifier: MIT
#include "StabilityPage.h"

#include "../report/Gnuplot.h"
#include "../report/PageData.h"
#include "../report/PageParts.h"
#include "../report/PagePictures.h"
#include "../report/TextTemplate.h"
#include "JsonFields.h"
#include "OutputFile.h"
#include "StabilityFigure.h"

#include <gnomon_stability_page.h>

#include <filesystem>

namespace gnomon::examples {
namespace {

using nlohmann::ordered_json;

ordered_json judgementJson(const StabilityJudgement& judged) {
    return {{"p95", jsonOf(judged.p95)}, {"wrong", judged.wrong}, {"shadow", judged.shadow}, {"iou", judged.iou}};
}

ordered_json cellJson(const StabilityCell& cell, PagePictures& pictures) {
    ordered_json json = {{"inBudget", cell.inBudget()}, {"catastrophe", cell.catastrophe()},
                         {"failure", cell.failure},     {"message", cell.message},
                         {"notFinite", cell.notFinite}, {"all", judgementJson(cell.everywhere)},
                         {"receiver", nullptr},         {"diagnosis", cell.diagnosis},
                         {"notes", cell.notes},         {"picture", pictures.add(cell.picture)}};
    if (cell.onReceiver) json["receiver"] = judgementJson(*cell.onReceiver);
    return json;
}

ordered_json rowJson(const StabilityRow& row, PagePictures& pictures) {
    ordered_json cells = ordered_json::array();
    for (const StabilityCell& cell : row.cells) cells.push_back(cellJson(cell, pictures));
    const std::optional<std::size_t> left = row.leftAt();
    return {{"scene", row.scene},
            {"kit", row.kit},
            {"technique", row.technique},
            {"setting", row.setting},
            {"settings", row.settings},
            {"outcome", nameOf(row.outcome())},
            {"reach", row.reach()},
            {"colour", reachColour(row.reach())},
            {"left", left ? ordered_json(*left) : ordered_json(nullptr)},
            {"flicker", jsonOf(row.flicker.energy)},
            {"crawl", jsonOf(row.flicker.crawl)},
            {"rayCrawl", jsonOf(row.flicker.rayCrawl)},
            {"filmed", jsonOf(row.flicker.value)},
            {"strip", pictures.add(row.flicker.picture)},
            {"cells", cells}};
}

ordered_json sceneJson(const StabilitySceneText& scene) {
    return {{"id", scene.id},     {"section", scene.section},     {"title", scene.title},  {"about", scene.about},
            {"unit", scene.unit}, {"parameter", scene.parameter}, {"values", scene.values}};
}

ordered_json dataOf(const StabilityResults& results, PagePictures& pictures) {
    ordered_json scenes = ordered_json::array(), rows = ordered_json::array();
    for (const StabilitySceneText& scene : results.scenes) scenes.push_back(sceneJson(scene));
    for (const StabilityRow& row : results.rows) rows.push_back(rowJson(row, pictures));
    return {{"scenes", scenes}, {"rows", rows}, {"pictures", pictures.json()}};
}

std::string pageOf(const StabilityResults& results, const std::string& folder) {
    PagePictures pictures(folder);
    const std::string data = scriptJson(dataOf(results, pictures));
    const std::string state =
        results.complete ? "" : element("p", "The run was interrupted: cells are missing.", "class=\"warning\"");
    return fillTemplate(page::stability_html,
                        {{"CSS", std::string(page::chart_css) + page::stability_css},
                         {"STATE", state},
                         {"SHRUNK", shrunkText(pictures.shrunk())},
                         {"MADE", madeHtml(results.made)},
                         {"DATA", data},
                         {"JQUERY", inlineScript(page::jquery_min_js)},
                         {"DATATABLES", inlineScript(page::jquery_dataTables_min_js)},
                         {"SCRIPT", inlineScript(std::string(page::common_js) + page::stability_js)}});
}

} // namespace

void writeStabilityPage(const StabilityResults& results, const std::string& folder) {
    const std::string name = "stability";
    drawScript(name, stabilityScript(results, name), folder);
    OutputFile((std::filesystem::path(folder) / (name + ".html")).string()).write(pageOf(results, folder));
}

} // namespace gnomon::examples
