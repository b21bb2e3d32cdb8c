// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/ShadowMetrics.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// The kit that ChartPoint::kit names for Gnomon's own techniques; all others are peers.
inline constexpr const char* ourKit = "Gnomon";

/// Milliseconds a frame beyond the same frame without shadows, measured in turns with it.
struct AddedTime {
    double q1 = 0.0, median = 0.0, q3 = 0.0;
};

/// What shadows cost: wall time, and processor time over all threads.
struct ChartCost {
    double first = 0.0;                    ///< ms, wall, first frame beyond the first frame without shadows.
    AddedTime steadyWall, steadyProcessor; ///< the camera moves, nothing else.
    AddedTime movingWall, movingProcessor; ///< the light moves.
    std::optional<AddedTime> steadyAlone, movingAlone; ///< wall, where nothing is drawn: see ProcessorAlone.h.
    double memory = 0.0;                               ///< MiB beyond the scene without shadows, where it can be told.
    unsigned draws = 0;                                ///< calls that draw, in a steady frame.
    unsigned passes = 0;       ///< cameras that draw in it; Gnomon's marks and relights are in the view's own.
    std::size_t triangles = 0; ///< handed to OpenGL in it.
};

/// A time that auto's model expects, and of which technique.
struct PredictedTime {
    std::string spec;  ///< without composite and receiver; of a fixed setting its own.
    double time = 0.0; ///< ms of processor time that shadows add to a frame.
};

/// What auto expects of its own choice.
struct ChartPrediction {
    std::string spec;             ///< of the still picture.
    double error = 0.0;           ///< px, 95th percentile, of the still picture.
    PredictedTime steady, moving; ///< as ChartCost has them.
};

/// One technique at one setting in one scene.
struct ChartPoint {
    std::string scene;     ///< ChartScene::name.
    std::string kit;       ///< ourKit or "osgShadow".
    std::string technique; ///< curve's name: "planar", "ShadowMap", …
    std::string setting;   ///< the point on the curve: "size 1024", "defaults", "best".
    std::vector<std::pair<std::string, std::string>> settings; ///< all that differ from the technique's own defaults.
    std::optional<ChartCost> cost;
    std::optional<metrics::ShadowMetrics> errors;
    std::optional<ChartPrediction> prediction; ///< of a point of auto.
    std::optional<double> shadedRmse;          ///< of the shaded picture against the traced one, linear, 0 to 1.
    std::optional<double> flickerEnergy, flickerShare, crawl; ///< see metrics::FlickerMeter.
    std::string picture, overlay;   ///< PNG files, relative to the results' folder; may be empty.
    std::vector<std::string> notes; ///< diagnosis, complaints of OpenGL.
    std::string failure;            ///< one sentence if it could not be measured; else empty.

    bool ours() const { return kit == ourKit; }
    /// It failed, or its picture is catastrophic.
    bool catastrophic() const { return !failure.empty() || (errors && errors->catastrophes.any()); }
};

struct ChartSceneResult {
    std::string name, title;
    std::size_t triangles = 0;
    double misclassifiedFloor = 0.0;                       ///< share; what one perfect ray a pixel gets wrong.
    std::optional<double> boundaryFloor;                   ///< px, 95th percentile of the same.
    double frame = 0.0;                                    ///< ms, wall, median of a frame without shadows.
    std::optional<double> frameAlone;                      ///< the same where nothing is drawn.
    std::string truthPicture;                              ///< PNG, relative to the results' folder.
    std::vector<std::pair<std::string, std::string>> view; ///< light, camera, size, as gnomonshot's options take them.
};

struct ChartResults {
    std::vector<std::pair<std::string, std::string>> made; ///< command, date, versions, renderer, processor, load …
    bool complete = false;                                 ///< false: interrupted, or still under way.
    /// Those of an earlier run as it wrote them, before these.
    nlohmann::ordered_json kept = {{"scenes", nlohmann::ordered_json::array()},
                                   {"points", nlohmann::ordered_json::array()}};
    std::vector<ChartSceneResult> scenes;
    std::vector<ChartPoint> points;
};

/// Where and by what results are made: date, versions, renderer, processor, cores, memory. Needs a HeadlessContext,
/// which it makes.
std::vector<std::pair<std::string, std::string>> machineFacts();

/// Processes that run or wait for a core, averaged over a minute, as the system tells; "unknown" where it does not.
std::string machineLoad();

/// Writes results.json, every bit of every number, into an existing folder, whole or not at all.
/// Cost    about 0.15 ms a point that it holds: may be called after every one of some hundreds.
/// @throws std::runtime_error, one sentence, if the file cannot be written.
void saveResults(const ChartResults& results, const std::string& folder);

/// What results.json of a folder holds: "made", "complete", "scenes" and "points".
/// @throws std::runtime_error, one sentence, if it is missing, no JSON, of another version, or lacks a list.
nlohmann::ordered_json loadResults(const std::string& folder);

} // namespace gnomon::examples
