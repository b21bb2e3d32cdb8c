// SPDX-License-Identifier: MIT
#include "Page.h"

#include "FigureSvg.h"
#include "Findings.h"
#include "GnuplotText.h"
#include "InputFile.h"
#include "PageData.h"
#include "PageParts.h"
#include "PredictionSummary.h"
#include "TextTemplate.h"

#include <gnomon_page.h>
#include <md4c-html.h>

#include <algorithm>
#include <filesystem>

namespace gnomon::examples {
namespace {

void append(const char* text, MD_SIZE size, void* html) { static_cast<std::string*>(html)->append(text, size); }

/// The last part of docs/measuring.md as HTML: what each number means.
std::string metricsHtml() {
    const std::string measuring = page::measuring_md;
    const std::string markdown =
        measuring.substr(std::min(measuring.size(), measuring.find("## What the numbers mean")));
    std::string html;
    md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html, MD_FLAG_TABLES | MD_FLAG_NOHTML, 0);
    return html;
}

std::string svgOf(const DrawnFigure& figure, const std::string& folder) {
    const std::string svg = fileBytes(std::filesystem::path(folder) / (figure.name + ".svg")).value_or("");
    return svg.substr(std::min(svg.size(), svg.find("<svg"))); // without the XML declaration
}

std::string figureHtml(const DrawnFigure& figure, const std::string& folder) {
    const std::string attributes = "data-scene=\"" + escaped(figure.scene) + "\" id=\"" + figure.name + "\"" +
                                   (figure.scene.empty() ? "" : " hidden");
    return element("figure", svgOf(figure, folder) + element("figcaption", escaped(figure.caption)), attributes);
}

std::string figuresHtml(const std::vector<DrawnFigure>& figures, const std::string& folder) {
    std::string html;
    for (const DrawnFigure& figure : figures) html += figureHtml(figure, folder);
    return html;
}

std::string sceneOptions(const ChartResults& results) {
    std::string html = element("option", "all scenes (medians)", "value=\"\"");
    for (const ChartSceneResult& scene : results.scenes)
        html += element("option", escaped(scene.title), "value=\"" + escaped(scene.name) + "\"");
    return html;
}

std::string findingHtml(const SceneFinding& finding) {
    std::string items;
    for (const std::string& sentence : finding.sentences) items += element("li", escaped(sentence));
    const char* light = finding.light == LightMotion::Still ? "still light" : "moving light";
    const std::string mark = finding.peerBeatsUs ? element("span", "a peer wins", "class=\"peer\"") : "";
    return element("h3", escaped(finding.title) + ", " + light + " " + mark) + element("ul", items);
}

std::string findingsHtml(const ChartResults& results) {
    const std::vector<SceneFinding> all = findings(results);
    std::string html, summary = escaped(findingsSummary(all));
    for (const SceneFinding& finding : all) html += findingHtml(finding);
    return element("p", summary, "class=\"summary\"") + element("details", element("summary", "Scene by scene") + html);
}

std::string outcomeHtml(const AutoOutcome& outcome) {
    const std::string ratio = outcome.ratio ? shortNumber(*outcome.ratio) : "";
    std::string cells;
    for (const std::string& text :
         {outcome.scene, outcome.setting, std::string(outcome.light == LightMotion::Still ? "still" : "moving"),
          shortNumber(outcome.error), shortNumber(outcome.time), std::string(outcome.keepsBudget ? "yes" : "no"),
          outcome.best, ratio})
        cells += element("td", escaped(text));
    return element("tr", cells);
}

/// Nothing if there are no predictions.
std::string predictionsHtml(const ChartResults& results) {
    const PredictionSummary summary = predictionSummary(results);
    std::string items, heads, rows;
    for (const std::string& sentence : sentencesOf(summary)) items += element("li", escaped(sentence));
    if (items.empty()) return "";
    for (const char* head :
         {"scene", "auto", "light", "error (px)", "time (ms)", "budget kept", "best fixed setting", "ratio to it"})
        heads += element("th", head);
    for (const PredictionHalf* half : {&summary.tuned, &summary.other})
        for (const AutoOutcome& outcome : half->outcomes) rows += outcomeHtml(outcome);
    const std::string table = element("table", element("tr", heads) + rows, "id=\"budgets\"");
    return element("h2", "Predicted and measured") + element("ul", items) +
           element("details", element("summary", "The budgets of auto") + table);
}

std::string stateOf(const ChartResults& results) {
    if (results.complete) return "";
    return element("p",
                   "The run was interrupted or is still running: " + std::to_string(results.points.size()) +
                       " points so far.",
                   "class=\"warning\"");
}

} // namespace

std::string pageOf(const ChartResults& results, const std::vector<DrawnFigure>& figures, const std::string& folder) {
    PagePictures pictures(folder);
    const std::string data = scriptJson(pageData(results, pictures));
    return fillTemplate(page::chart_html, {{"CSS", page::chart_css},
                                           {"STATE", stateOf(results)},
                                           {"FINDINGS", findingsHtml(results)},
                                           {"SCENES", sceneOptions(results)},
                                           {"PREDICTIONS", predictionsHtml(results)},
                                           {"FIGURES", figuresHtml(figures, folder)},
                                           {"SHRUNK", shrunkText(pictures.shrunk())},
                                           {"METRICS", metricsHtml()},
                                           {"MADE", madeHtml(results.made)},
                                           {"DATA", data},
                                           {"JQUERY", inlineScript(page::jquery_min_js)},
                                           {"DATATABLES", inlineScript(page::jquery_dataTables_min_js)},
                                           {"SCRIPT", inlineScript(std::string(page::common_js) + page::chart_js)}});
}

} // namespace gnomon::examples
