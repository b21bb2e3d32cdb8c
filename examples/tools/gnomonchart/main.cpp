// SPDX-License-Identifier: MIT
// gnomonchart: how fast and how wrong every shadow technique is, osgShadow's in the same run.
#include "ChartOptions.h"
#include "ChartRun.h"
#include "Contender.h"
#include "Kept.h"
#include "Models.h"
#include "OutputFile.h"
#include "Report.h"
#include "SceneFile.h"
#include "StabilityScene.h"
#include "StabilityTable.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace {

using namespace gnomon::examples;
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
