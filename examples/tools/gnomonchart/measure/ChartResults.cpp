// SPDX-License-Identifier: MIT
#include "ChartResults.h"

#include "OutputFile.h"
#include "Report.h"

#include <gnomon/HeadlessContext.h>
#include <osg/Version>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace gnomon::examples {

using nlohmann::ordered_json;

static constexpr unsigned version = 2;

static ordered_json jsonOf(const AddedTime& time) {
    return {{"q1", jsonOf(time.q1)}, {"median", jsonOf(time.median)}, {"q3", jsonOf(time.q3)}};
}

static ordered_json jsonOf(const ChartCost& cost) {
    return {{"firstMs", jsonOf(cost.first)},
            {"steadyWallMs", jsonOf(cost.steadyWall)},
            {"steadyProcessorMs", jsonOf(cost.steadyProcessor)},
            {"movingWallMs", jsonOf(cost.movingWall)},
            {"movingProcessorMs", jsonOf(cost.movingProcessor)},
            {"steadyAloneMs", jsonOf(cost.steadyAlone)},
            {"movingAloneMs", jsonOf(cost.movingAlone)},
            {"memoryMiB", jsonOf(cost.memory)},
            {"draws", cost.draws},
            {"passes", cost.passes},
            {"triangles", cost.triangles}};
}

static ordered_json jsonOf(const PredictedTime& predicted) {
    return {{"spec", predicted.spec}, {"ms", jsonOf(predicted.time)}};
}

static ordered_json jsonOf(const ChartPrediction& prediction) {
    return {{"spec", prediction.spec},
            {"boundaryP95Pixels", jsonOf(prediction.error)},
            {"steadyProcessor", jsonOf(prediction.steady)},
            {"movingProcessor", jsonOf(prediction.moving)}};
}

static ordered_json jsonOf(const ChartPoint& point) {
    return {{"scene", point.scene},
            {"kit", point.kit},
            {"technique", point.technique},
            {"setting", point.setting},
            {"settings", point.settings},
            {"failure", point.failure},
            {"catastrophic", point.catastrophic()},
            {"cost", jsonOf(point.cost)},
            {"errors", point.errors ? jsonOf(*point.errors) : ordered_json()},
            {"prediction", jsonOf(point.prediction)},
            {"shadedRmse", jsonOf(point.shadedRmse)},
            {"flickerEnergy", jsonOf(point.flickerEnergy)},
            {"flickerShare", jsonOf(point.flickerShare)},
            {"crawlPixels", jsonOf(point.crawl)},
            {"picture", point.picture},
            {"overlay", point.overlay},
            {"notes", point.notes}};
}

static ordered_json jsonOf(const ChartSceneResult& scene) {
    return {{"name", scene.name},
            {"title", scene.title},
            {"triangles", scene.triangles},
            {"misclassifiedFloor", jsonOf(scene.misclassifiedFloor)},
            {"boundaryFloorPixels", jsonOf(scene.boundaryFloor)},
            {"frameMs", jsonOf(scene.frame)},
            {"frameAloneMs", jsonOf(scene.frameAlone)},
            {"truthPicture", scene.truthPicture},
            {"view", scene.view}};
}

namespace {

std::string utcNow() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

/// What stands behind the first ": " of the first line that begins so.
std::string lineOf(const char* file, const std::string& begins) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.rfind(begins, 0) == 0) return line.substr(line.find(": ") + 2);
    return "unknown";
}

std::string memoryText() {
    const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    return std::to_string(static_cast<long>(bytes / (1024.0 * 1024.0))) + " MiB";
}

} // namespace

std::vector<std::pair<std::string, std::string>> machineFacts() {
    return {{"date", utcNow()},
            {"gnomon", GNOMON_VERSION},
            {"OpenSceneGraph", osgGetVersion()},
            {"renderer", HeadlessContext(16, 16).renderer()},
            {"compiler", __VERSION__},
            {"processor", lineOf("/proc/cpuinfo", "model name")},
            {"cores", std::to_string(std::thread::hardware_concurrency())},
            {"memory", memoryText()}};
}

std::string machineLoad() {
    std::ifstream in("/proc/loadavg");
    std::string load;
    return in >> load ? load : "unknown";
}

void saveResults(const ChartResults& results, const std::string& folder) {
    ordered_json all = {{"gnomonchart", version},
                        {"made", results.made},
                        {"complete", results.complete},
                        {"scenes", results.kept["scenes"]},
                        {"points", results.kept["points"]}};
    for (const ChartSceneResult& scene : results.scenes) all["scenes"].push_back(jsonOf(scene));
    for (const ChartPoint& point : results.points) all["points"].push_back(jsonOf(point));
    OutputFile((std::filesystem::path(folder) / "results.json").string()).write(resultsText(all));
}

ordered_json loadResults(const std::string& folder) {
    const std::string file = (std::filesystem::path(folder) / "results.json").string();
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("there is no file \"" + file + "\". Give the folder of a run of gnomonchart.");
    const ordered_json results = ordered_json::parse(in, nullptr, false);
    const auto refuse = [&file](const std::string& why) {
        throw std::runtime_error("\"" + file + "\" cannot be read as results of gnomonchart: " + why);
    };
    if (results.is_discarded() || !results.is_object()) refuse("it is not a complete JSON file.");
    if (results.value("gnomonchart", 0u) != version) refuse("its version is not " + std::to_string(version) + ".");
    for (const char* list : {"made", "scenes", "points"})
        if (!results.contains(list) || !results[list].is_array()) refuse("\"" + std::string(list) + "\" is missing.");
    return results;
}

} // namespace gnomon::examples
