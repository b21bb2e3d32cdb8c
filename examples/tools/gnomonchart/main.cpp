// SPDX-License-Identifier: MIT
// gnomonchart: how fast and how wrong every shadow technique is, osgShadow's in the same run.
#include "ChartOptions.h"
#include "ChartRun.h"
#include "Contender.h"
#include "OutputFile.h"
#include "Report.h"
#include "SceneFile.h"
#include "SceneTruth.h"
#include "StabilityResults.h"
#include "StabilityScene.h"
#include "StabilityTable.h"
#include "StageViewer.h"

#include <metrics/Visibility.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

const osg::Vec4d suns[] = {{1.0, -1.0, 1.4, 0.0}, {-0.8, -0.5, 0.6, 0.0}};
constexpr const char* usual[] = {"volume", "map", "traced", "auto"};

metrics::Picture greys(const osg::Image& image) {
    const ShadedPicture colours = coloursOf(image);
    metrics::Picture result(colours.width, colours.height);
    std::transform(colours.cells.begin(), colours.cells.end(), result.cells.begin(),
                   [](const glm::dvec3& colour) { return (colour.r + colour.g + colour.b) / 3.0; });
    return result;
}

/// Pixels that are judged on this sun, and the pictures with it and without.
struct Truth {
    Truth(const ChartScene& scene) : maps(SceneTruth(*scene.content, Clear::PASSES).maps(scene.camera, scene.light)) {
        StageViewer viewer(std::make_unique<PlainStaging>(scene, Look::SHADED), scene.camera,
                           StageViewer::Colour::FLOATS);
        viewer.draw();
        lit = greys(*viewer.image());
        viewer.staging().setShining(false);
        viewer.draw();
        dark = greys(*viewer.image());
    }

    metrics::TruthMaps maps;
    metrics::Picture lit, dark;
};

nlohmann::json judgement(const ChartScene& scene, const Truth& truth, const std::string& technique) {
    StageViewer viewer(gnomonContender(technique, Receives::EVERYTHING).stage(scene, Look::SHADED), scene.camera,
                       StageViewer::Colour::FLOATS);
    for (int frame = 0; frame < 3; ++frame) viewer.draw();
    const metrics::Picture seen = metrics::visibility(greys(*viewer.image()), truth.lit, truth.dark).value;
    const metrics::PixelSets sets = metrics::pixelSets(truth.maps, seen);
    const StabilityJudgement judged = judge(seen, truth.maps, sets, sets.agreeing);
    return {{"technique", technique},
            {"wrong", judged.wrong},
            {"shadow", judged.shadow},
            {"judged", std::count(sets.certain.cells.begin(), sets.certain.cells.end(), 1)},
            {"said", viewer.staging().diagnose()}};
}

/// Judges techniques on the files, which are one model, under two suns: as a user sees them, with their own materials, against
/// rays that pass texels that blend with an alpha below one half. Prints a line of JSON for each sun and technique: pixels
/// wrong away from edges, pixels truly in shadow, pixels judged, and what diagnose() says.
///
/// Limits  pixels that the light meets at less than 3 degrees, or that are hardly darker in shadow, are not judged.
/// @throws std::runtime_error, one sentence, for a file that cannot be read.
void judgeModel(const ChartOptions& options) {
    const std::vector<std::string> asked =
        options.techniques.empty() ? std::vector<std::string>(std::begin(usual), std::end(usual)) : options.techniques;
    const osg::ref_ptr<osg::Node> model = readScene(options.view.files, "gnomonchart");
    for (int sun = 0; sun < 2; ++sun) {
        ViewOptions view = options.view;
        view.lights = {suns[sun]};
        const ChartScene scene = chartSceneOf(*model, view);
        const Truth truth(scene);
        for (const std::string& technique : asked) {
            nlohmann::json line = judgement(scene, truth, technique);
            line["sun"] = sun;
            std::cout << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
        }
    }
}

namespace fs = std::filesystem;

constexpr const char* program = "gnomonchart";
constexpr double quickSeconds = 280.0; // of five minutes
constexpr int interrupted = 130;       // as shells have it for SIGINT

volatile std::sig_atomic_t stopAsked = 0;

/// Ends the run at the next step; a second signal ends the program at once.
void askToStop(int signal) {
    stopAsked = 1;
    std::signal(signal, SIG_DFL);
}

/// Ctrl-C ends a run with what there is.
void listenForStop() {
    std::signal(SIGINT, askToStop);
    std::signal(SIGTERM, askToStop);
}

void listNames() {
    std::cout << "scenes:\n";
    for (const std::string& name : chartSceneNames()) std::cout << "  " << name << "\n";
    std::cout << "scenes of --stability:\n";
    for (const StabilityScene& scene : stabilityScenes()) std::cout << "  " << scene.id << "  " << scene.title << "\n";
    std::cout << "techniques:\n";
    for (const std::string& name : chartTechniques()) std::cout << "  " << name << "\n";
}

std::vector<std::string> sceneNames(const ChartOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    if (options.quick) return {"lab8-45", "bunny-45", "room"};
    return chartSceneNames();
}

/// Files are one scene, named after the first.
void planFiles(const ChartOptions& options, ChartPlan& plan) {
    const osg::ref_ptr<osg::Node> files = readScene(options.view.files, program);
    const std::string name = fs::path(options.view.files.front()).stem().string();
    ChartScene scene = chartSceneOf(*files, options.view);
    scene.name = scene.title = name;
    plan.scenes = {name};
    plan.scene = [scene](const std::string&) { return scene; };
}

void planBuiltIn(const ChartOptions& options, ChartPlan& plan) {
    plan.scenes = sceneNames(options);
    const int width = options.view.width, height = options.view.height;
    plan.scene = [width, height](const std::string& scene) { return chartScene(scene, width, height); };
    const std::vector<std::string> known = chartSceneNames();
    for (const std::string& name : plan.scenes)
        if (std::find(known.begin(), known.end(), name) == known.end()) plan.scene(name); // says which there are
}

ChartPlan planOf(const ChartOptions& options) {
    ChartPlan plan;
    options.view.files.empty() ? planBuiltIn(options, plan) : planFiles(options, plan);
    plan.techniques = options.techniques;
    plan.folder = options.out;
    plan.frames = options.frameCount();
    if (options.quick) plan.seconds = quickSeconds;
    plan.flickerFrames = options.flickerFrames();
    plan.sweep = options.quick ? SweepWidth::NARROW : SweepWidth::WIDE;
    plan.disc = !options.quick;
    plan.made = {{"size", std::to_string(options.view.width) + "x" + std::to_string(options.view.height)},
                 {"frames", std::to_string(plan.frames)},
                 {"flicker frames", std::to_string(plan.flickerFrames)},
                 {"sweep", options.quick ? "narrow" : "wide"}};
    return plan;
}

int chart(const ChartOptions& options, const std::string& command) {
    ChartPlan plan = planOf(options);
    plan.made.insert(plan.made.begin(), {"command", command});
    requireFolder(options.out);
    if (options.resume) plan.kept = keptOf(loadResults((fs::path(options.out) / "results.json").string()), plan);
    listenForStop();
    const ChartResults results = runChart(
        plan, [&](const ChartResults& sofar) { saveResults(sofar, options.out); }, [] { return stopAsked != 0; });
    for (const auto& [name, value] : results.made)
        if (name.rfind("left out", 0) == 0) std::cout << name << ": " << value << "\n";
    writeReport(options.out);
    if (!results.complete) std::cerr << program << ": interrupted. The results so far are kept." << std::endl;
    return results.complete ? 0 : interrupted;
}

int stability(const ChartOptions& options, const std::string& command) {
    listenForStop();
    const bool complete = makeStabilityTable(options, command, [] { return stopAsked != 0; });
    if (!complete) std::cerr << program << ": interrupted. The results so far are kept." << std::endl;
    return complete ? 0 : interrupted;
}

int random(const ChartOptions& options) {
    listenForStop();
    return searchRandom(options, [] { return stopAsked != 0; }) ? 0 : 1;
}

std::string commandOf(osg::ArgumentParser& arguments) {
    std::string command = program;
    for (int i = 1; i < arguments.argc(); ++i) command += std::string(" ") + arguments[i];
    return command;
}

int run(osg::ArgumentParser& arguments) {
    const std::string command = commandOf(arguments);
    const ChartOptions options = readChartOptions(arguments);
    if (options.help)
        std::cout << chartHelp();
    else if (options.list)
        listNames();
    else if (!options.again.empty())
        writeReport(options.again);
    else if (options.model)
        judgeModel(options);
    else if (options.random)
        return random(options);
    else if (options.stability)
        return stability(options, command);
    else
        return chart(options, command);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram(program, argc, argv, run); }
