// SPDX-License-Identifier: MIT
#include "ResultsJson.h"

#include "JsonFields.h"
#include "Report.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using Pairs = std::vector<std::pair<std::string, std::string>>; // [["name", "value"], …]: keeps their order

constexpr unsigned version = 1;

ordered_json timeJson(const AddedTime& time) {
    return {{"q1", jsonOf(time.q1)}, {"median", jsonOf(time.median)}, {"q3", jsonOf(time.q3)}};
}

ordered_json costJson(const std::optional<ChartCost>& cost) {
    if (!cost) return nullptr;
    return {{"firstMs", jsonOf(cost->first)},
            {"steadyWallMs", timeJson(cost->steadyWall)},
            {"steadyProcessorMs", timeJson(cost->steadyProcessor)},
            {"movingWallMs", timeJson(cost->movingWall)},
            {"movingProcessorMs", timeJson(cost->movingProcessor)},
            {"memoryMiB", jsonOf(cost->memory)},
            {"draws", cost->draws},
            {"passes", cost->passes},
            {"triangles", cost->triangles}};
}

ordered_json pointJson(const ChartPoint& point) {
    return {{"scene", point.scene},
            {"kit", point.kit},
            {"technique", point.technique},
            {"setting", point.setting},
            {"settings", point.settings},
            {"failure", point.failure},
            {"catastrophic", point.catastrophic()},
            {"cost", costJson(point.cost)},
            {"errors", point.errors ? ordered_json(reportJson(*point.errors)) : ordered_json(nullptr)},
            {"shadedRmse", jsonOf(point.shadedRmse)},
            {"flickerEnergy", jsonOf(point.flickerEnergy)},
            {"flickerShare", jsonOf(point.flickerShare)},
            {"crawlPixels", jsonOf(point.crawl)},
            {"picture", point.picture},
            {"overlay", point.overlay},
            {"notes", point.notes}};
}

ordered_json sceneJson(const ChartSceneResult& scene) {
    return {{"name", scene.name},
            {"title", scene.title},
            {"triangles", scene.triangles},
            {"misclassifiedFloor", jsonOf(scene.misclassifiedFloor)},
            {"boundaryFloorPixels", jsonOf(scene.boundaryFloor)},
            {"frameMs", jsonOf(scene.frame)},
            {"truthPicture", scene.truthPicture},
            {"view", scene.view}};
}

std::string textOf(const json& value) {
    if (!value.is_string()) throw std::runtime_error("it is no text.");
    return value.get<std::string>();
}

std::vector<std::string> textsField(const json& object, const char* name) {
    std::vector<std::string> texts;
    const json& list = listField(object, name);
    for (const json& text : list) readInside(name, [&] { texts.push_back(textOf(text)); });
    return texts;
}

Pairs pairsField(const json& object, const char* name) {
    Pairs pairs;
    for (const json& pair : listField(object, name)) {
        if (!pair.is_array() || pair.size() != 2) throw std::runtime_error(std::string(name) + ": it holds no pairs.");
        readInside(name, [&] { pairs.emplace_back(textOf(pair[0]), textOf(pair[1])); });
    }
    return pairs;
}

void readTime(const json& cost, const char* name, AddedTime& time) {
    const json& from = objectField(cost, name);
    readInside(name, [&] {
        readField(from, "q1", time.q1);
        readField(from, "median", time.median);
        readField(from, "q3", time.q3);
    });
}

ChartCost costOf(const json& from) {
    ChartCost cost;
    readField(from, "firstMs", cost.first);
    readTime(from, "steadyWallMs", cost.steadyWall);
    readTime(from, "steadyProcessorMs", cost.steadyProcessor);
    readTime(from, "movingWallMs", cost.movingWall);
    readTime(from, "movingProcessorMs", cost.movingProcessor);
    readField(from, "memoryMiB", cost.memory);
    readField(from, "draws", cost.draws);
    readField(from, "passes", cost.passes);
    readField(from, "triangles", cost.triangles);
    return cost;
}

void readNames(const json& from, ChartPoint& point) {
    readField(from, "scene", point.scene);
    readField(from, "kit", point.kit);
    readField(from, "technique", point.technique);
    readField(from, "setting", point.setting);
    readField(from, "failure", point.failure);
    readField(from, "picture", point.picture);
    readField(from, "overlay", point.overlay);
    point.settings = pairsField(from, "settings");
    point.notes = textsField(from, "notes");
}

void readNumbers(const json& from, ChartPoint& point) {
    readField(from, "shadedRmse", point.shadedRmse);
    readField(from, "flickerEnergy", point.flickerEnergy);
    readField(from, "flickerShare", point.flickerShare);
    readField(from, "crawlPixels", point.crawl);
    const json &cost = objectField(from, "cost", true), &errors = objectField(from, "errors", true);
    if (!cost.is_null()) readInside("cost", [&] { point.cost = costOf(cost); });
    if (!errors.is_null()) readInside("errors", [&] { point.errors = reportOf(errors); });
}

ChartPoint pointOf(const json& from) {
    ChartPoint point;
    readNames(from, point);
    readNumbers(from, point);
    return point;
}

ChartSceneResult sceneOf(const json& from) {
    ChartSceneResult scene;
    readField(from, "name", scene.name);
    readField(from, "title", scene.title);
    readField(from, "triangles", scene.triangles);
    readField(from, "misclassifiedFloor", scene.misclassifiedFloor);
    readField(from, "boundaryFloorPixels", scene.boundaryFloor);
    readField(from, "frameMs", scene.frame);
    readField(from, "truthPicture", scene.truthPicture);
    scene.view = pairsField(from, "view");
    return scene;
}

/// Every element of a list; errors name which one.
template <typename Part>
std::vector<Part> partsField(const json& object, const char* name, Part (*partOf)(const json&)) {
    std::vector<Part> parts;
    for (const json& from : listField(object, name))
        readInside(std::string(name) + "[" + std::to_string(parts.size()) + "]",
                   [&] { parts.push_back(partOf(from)); });
    return parts;
}

template <typename Part>
ordered_json listJson(const std::vector<Part>& parts, ordered_json (*partJson)(const Part&)) {
    ordered_json list = ordered_json::array();
    for (const Part& part : parts) list.push_back(partJson(part));
    return list;
}

} // namespace

ordered_json jsonOf(const ChartResults& results) {
    return {{"gnomonchart", version},
            {"made", results.made},
            {"complete", results.complete},
            {"scenes", listJson(results.scenes, sceneJson)},
            {"points", listJson(results.points, pointJson)}};
}

ChartResults chartResultsOf(const json& from) {
    unsigned found = 0;
    readField(from, "gnomonchart", found);
    if (found != version) throw std::runtime_error("it is of version " + std::to_string(found) + "; 1 is allowed.");
    ChartResults results;
    results.made = pairsField(from, "made");
    readField(from, "complete", results.complete);
    results.scenes = partsField(from, "scenes", sceneOf);
    results.points = partsField(from, "points", pointOf);
    return results;
}

} // namespace gnomon::examples
