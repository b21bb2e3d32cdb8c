// SPDX-License-Identifier: MIT
// gnomonchart: how fast and how wrong every shadow technique is, osgShadow's in the same run.
#include "ChartOptions.h"
#include "ChartRun.h"
#include "Contender.h"
#include "Machine.h"
#include "OutputFile.h"
#include "Progress.h"
#include "RandomSearch.h"
#include "SceneFile.h"
#include "SceneTruth.h"
#include "StabilityResults.h"
#include "StabilityRun.h"
#include "StabilityScene.h"
#include "StageViewer.h"

#include <gnomon_report.h>

#include <metrics/Visibility.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

/// Draws the figures and the page of the results in a folder, and prints what they say: report.py does.
///
/// Needs   python3 with matplotlib and jinja2, when it is called.
/// @throws std::runtime_error, one sentence, if Python cannot be started or the report fails; it has said why then.
void writeReport(const std::string& folder) {
    std::cout.flush();
    int ends[2];
    if (pipe(ends) != 0)
        throw std::runtime_error(std::string("the report cannot be made: ") + std::strerror(errno) + ".");
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[0], STDIN_FILENO);
        close(ends[0]);
        close(ends[1]);
        execlp(PYTHON3, PYTHON3, "-", folder.c_str(), static_cast<char*>(nullptr));
        execlp("python3", "python3", "-", folder.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[0]);
    const auto before = std::signal(SIGPIPE, SIG_IGN); // where Python cannot be started
    const std::size_t length = std::strlen(report_py);
    for (std::size_t at = 0; child > 0 && at < length;) {
        const ssize_t written = write(ends[1], report_py + at, length - at);
        if (written < 0 && errno != EINTR) break;
        at += written > 0 ? static_cast<std::size_t>(written) : 0;
    }
    close(ends[1]);
    int status = -1;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    std::signal(SIGPIPE, before);
    if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
        throw std::runtime_error("the report needs Python, which cannot be started. Install python3.");
    if (status != 0) throw std::runtime_error("the report could not be made; the results are kept.");
}

/// The first value, the middle one and the last.
StabilityScene coarse(StabilityScene scene) {
    const std::vector<double> all = scene.values;
    scene.values = {all.front(), all[all.size() / 2], all.back()};
    return scene;
}

StabilityPlan stabilityPlanOf(const ChartOptions& options) {
    StabilityPlan plan;
    plan.scenes = stabilityScenes(options.stabilityScenes);
    if (options.quick) std::transform(plan.scenes.begin(), plan.scenes.end(), plan.scenes.begin(), coarse);
    plan.contenders = stabilityContenders(options.techniques, !options.quick);
    plan.width = options.view.width;
    plan.height = options.view.height;
    plan.workers = std::max(1u, std::thread::hardware_concurrency());
    plan.folder = options.out;
    plan.made = {{"size", std::to_string(plan.width) + "x" + std::to_string(plan.height)},
                 {"sweep", options.quick ? "three values" : "all values"}};
    return plan;
}

/// What an interrupted run did not measure to the end cannot be judged.
void dropUnfinished(StabilityResults& results) {
    const auto isUnfinished = [](const StabilityRow& row) {
        return row.cells.empty() || std::any_of(row.cells.begin(), row.cells.end(), [](const StabilityCell& cell) {
                   return !cell.measured && cell.failure.empty();
               });
    };
    results.rows.erase(std::remove_if(results.rows.begin(), results.rows.end(), isUnfinished), results.rows.end());
}

/// @param stops  see makeStabilityTable().
template <class Work>
auto withProgress(std::size_t steps, const std::function<bool()>& stops, const Work& work) {
    ProgressLine progress(static_cast<double>(steps));
    return work([&](std::size_t done, const std::string& doing) {
        if (done) progress.show(double(done), doing);
        return !stops();
    });
}

/// Measures the stability table, writes it into the options' folder, and prints it.
/// @param stops  asked again and again; true ends the run with what there is.
/// @return whether it is complete.
/// @throws std::invalid_argument, one sentence, for a scene or technique that is not there; std::runtime_error, one
/// sentence, if a file cannot be written.
bool makeStabilityTable(const ChartOptions& options, const std::string& command, const std::function<bool()>& stops) {
    StabilityPlan plan = stabilityPlanOf(options);
    plan.made.insert(plan.made.begin(), {"command", command});
    requireFolder(options.out);
    std::size_t cells = 0;
    for (const StabilityScene& scene : plan.scenes) cells += scene.values.size() * plan.contenders.size();
    StabilityResults results =
        withProgress(cells, stops, [&](const auto& progress) { return runStability(plan, progress); });
    dropUnfinished(results);
    for (auto& fact : machineFacts()) results.made.push_back(fact); // after the run: it makes a context
    saveStability(results, options.out);
    writeReport(options.out);
    return results.complete;
}

/// Searches random scenes for shadows that Gnomon's techniques lose without a word, and prints each with the plainest scene
/// in which it is lost.
/// @return whether there is none, and the search went to its end.
bool searchRandom(const ChartOptions& options, const std::function<bool()>& stops) {
    RandomSearch search;
    search.first = options.seed;
    search.count = options.random.value_or(search.count);
    search.contenders = stabilityContenders(options.techniques, false);
    const auto isRough = [](const StabilityContender& each) {
        return each.contender.kit != "Gnomon" || each.contender.technique == "box"; // box: shadows of bounding boxes
    };
    search.contenders.erase(std::remove_if(search.contenders.begin(), search.contenders.end(), isRough),
                            search.contenders.end());
    search.workers = std::max(1u, std::thread::hardware_concurrency());
    search.batch = std::max(search.batch, 50 * search.workers); // two processes for each
    const std::size_t cells = std::size_t(search.count) * search.contenders.size();
    std::size_t faults = 0;
    const auto print = [&faults](const RandomFault& fault) {
        std::cout << faultText(fault) << std::endl; // at once: a long search may be ended
        ++faults;
    };
    const unsigned done =
        withProgress(cells, stops, [&](const auto& progress) { return searchRandomScenes(search, progress, print); });
    std::cout << (done < search.count ? "interrupted after " + std::to_string(done) + " of " : std::string())
              << search.count << " random scenes from seed " << search.first << ", " << faults << " faults\n";
    return faults == 0 && done == search.count;
}

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
