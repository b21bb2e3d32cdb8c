// SPDX-License-Identifier: MIT
// gnomonchart: how fast and how wrong every shadow technique is, osgShadow's in the same run.
#include "ChartRun.h"
#include "Contender.h"
#include "ImageFile.h"
#include "InputFile.h"
#include "OtherProcess.h"
#include "OutputFile.h"
#include "ProcessorAlone.h"
#include "RandomScene.h"
#include "SceneTruth.h"
#include "StabilityResults.h"
#include "StabilityScene.h"
#include "StageViewer.h"
#include "TimeLeft.h"
#include "ViewOptions.h"

#include <gnomon_report.h>

#include <metrics/Visibility.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

/// What gnomonchart's command line asks for.
struct ChartOptions {
    ViewOptions view;                         ///< files, and how they are seen; its size is that of all pictures.
    std::vector<std::string> scenes;          ///< names of built-in ones.
    std::vector<std::string> techniques;      ///< parts of techniques' names; none: all.
    std::string out = "chart-out";            ///< folder.
    std::string again;                        ///< folder of results to be drawn again; empty: measure.
    std::optional<int> frames;                ///< 60, or 12 with quick.
    std::optional<int> flicker;               ///< frames of each film; 16, or 8 with quick; none below 2.
    bool resume = false;                      ///< go on with what is in `out`.
    bool stability = false;                   ///< the stability table, of the scenes in stabilityScenes.
    std::vector<std::string> stabilityScenes; ///< ids; empty: all.
    bool model = false;                       ///< judge techniques on the files against rays instead.
    std::optional<unsigned> random;           ///< search so many random scenes instead.
    unsigned seed = 1;                        ///< of the first of them.
    bool brief = false;                       ///< defaults and best settings alone.
    bool quick = false, list = false, help = false;

    int frameCount() const { return frames.value_or(quick ? 12 : 60); }
    int flickerFrames() const { return flicker.value_or(quick ? 8 : 16); }
};

constexpr int leastFrames = 2, mostFrames = 10000;
constexpr int mostFlickerFrames = 1000;
constexpr int mostRandom = 1000000, mostSeed = 1000000000;
constexpr int stabilityWidth = 160, stabilityHeight = 120;
constexpr int leastSide = 32; // pixels; smaller pictures have no pixel that is judged

// Every technique is measured, each with its own casters and receivers, under light of the chart's own.
constexpr std::array<const char*, 6> notOfUse{"--shadow",  "--casters",    "--ambient",
                                              "--diffuse", "--background", "--samples"};

using Text = const std::string&;

void addChartOptions(Options& table, ChartOptions& into) {
    table.push_back({"--scene", "NAME", "built-in scene, see --list", "all, if no FILE is given",
                     [&into](Text t) { into.scenes.push_back(t); }, true});
    table.push_back({"--technique", "TEXT", "measure only techniques whose name contains this, see --list", "all",
                     [&into](Text t) { into.techniques.push_back(t); }, true});
    table.push_back({"--out", "FOLDER", "folder for results and pictures; created if missing", "chart-out",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--quick", "",
                     "small pictures, few frames, narrow sweeps, and three scenes if none is named: at most five "
                     "minutes on\n      two cores",
                     "", [&into](Text) { into.quick = true; }});
    table.push_back(
        {"--brief", "",
         "measure each technique at its defaults and at its best alone, and one of variants that are alike: "
         "less\n      than half the time",
         "", [&into](Text) { into.brief = true; }});
    table.push_back({"--frames", "N", "frames to time for each motion, 2 to 10000", "60, with --quick 12",
                     [&into](Text t) { into.frames = readWhole(t, leastFrames, mostFrames); }});
    table.push_back(
        {"--flicker", "N",
         "frames of each of the two films that flicker is measured in, 0 to 1000; fewer than 2 leave flicker\n"
         "      out and save time",
         "16, with --quick 8", [&into](Text t) { into.flicker = readWhole(t, 0, mostFlickerFrames); }});
    table.push_back({"--stability", "",
                     "the stability table instead: when shadows break. The arguments are its scenes' ids then, see "
                     "--list",
                     "", [&into](Text) { into.stability = true; }});
    table.push_back({"--model", "",
                     "instead judge techniques on FILES as they look, under two suns, against rays; prints lines of "
                     "JSON.\n      --technique is a specification then (default volume, map, traced and auto)",
                     "", [&into](Text) { into.model = true; }});
    table.push_back({"--random", "N",
                     "instead search N random scenes, 1 to 1000000, for shadows that are lost; nothing is written", "",
                     [&into](Text t) { into.random = unsigned(readWhole(t, 1, mostRandom)); }});
    table.push_back({"--seed", "S", "seed of the first random scene, 0 to 1000000000", "1",
                     [&into](Text t) { into.seed = unsigned(readWhole(t, 0, mostSeed)); }});
    table.push_back({"--resume", "",
                     "continue an interrupted run; scenes that are complete in FOLDER are not measured again", "",
                     [&into](Text) { into.resume = true; }});
    table.push_back({"--again", "FOLDER",
                     "measure nothing; write the figures and index.html in FOLDER again from its results.json", "",
                     [&into](Text t) { into.again = t; }});
    table.push_back(
        {"--list", "", "print the names of scenes and techniques", "", [&into](Text) { into.list = true; }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
}

bool isOfUse(const Option& option) {
    return std::find(notOfUse.begin(), notOfUse.end(), option.name) == notOfUse.end();
}

Options chartOptions(ChartOptions& into) {
    Options table;
    addChartOptions(table, into);
    for (Option& option : viewOptions(into.view)) {
        if (option.name == "--light") option.repeats = false;
        if (option.name == "--size") option.fallback = "640x480, with --quick 320x240";
        if (isOfUse(option)) table.push_back(option);
    }
    return table;
}

void setSize(ChartOptions& options, bool given) {
    if (!given && options.stability) {
        options.view.width = stabilityWidth;
        options.view.height = stabilityHeight;
    } else if (!given && options.model) {
        options.view.width = 400;
        options.view.height = 300;
    } else if (!given) {
        options.view.width = options.quick ? 320 : 640;
        options.view.height = options.quick ? 240 : 480;
    }
    if (std::min(options.view.width, options.view.height) < leastSide)
        throw std::invalid_argument("--size is too small to be judged. Allowed: 32x32 pixels or more.");
}

/// Names of options that stand on the command line.
std::vector<std::string> namesGiven(const osg::ArgumentParser& arguments, const Options& table) {
    std::vector<std::string> names;
    for (const Option& option : table)
        if (arguments.find(option.name) > 0) names.push_back(option.name);
    return names;
}

/// What a mode would not heed is refused.
struct Mode {
    std::string name;               ///< of its option.
    std::vector<std::string> heeds; ///< options beside it.
};

const std::array<Mode, 4> modes{{{"--random", {"--seed", "--technique"}},
                                 {"--model", {"--technique", "--size", "--up", "--ground"}},
                                 {"--again", {"--stability"}},
                                 {"--stability", {"--technique", "--out", "--size", "--quick", "--again"}}}};

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

void refuseUnheeded(const std::vector<std::string>& given, bool withArguments) {
    const auto holds = [](const std::vector<std::string>& names, Text name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const Mode& mode : modes) {
        if (!holds(given, mode.name)) continue;
        const std::string allowed = " Allowed beside it: " + listed(mode.heeds) + ".";
        for (const std::string& name : given)
            if (name != mode.name && !holds(mode.heeds, name))
                throw std::invalid_argument(mode.name + " does not go with " + name + "." + allowed);
        if (withArguments && mode.name != "--stability" && mode.name != "--model")
            throw std::invalid_argument(mode.name + " does not go with files or scenes." + allowed);
        break; // the first one is what is done
    }
    if (holds(given, "--seed") && !holds(given, "--random")) throw std::invalid_argument("--seed needs --random N.");
}

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
ChartOptions readChartOptions(osg::ArgumentParser& arguments) {
    ChartOptions options;
    const Options table = chartOptions(options);
    const std::vector<std::string> given = namesGiven(arguments, table);
    const bool sized = arguments.find("--size") > 0;
    readOptions(arguments, table);
    readOsgOptions(arguments);
    if (options.help || options.list) return options;
    takeFiles(arguments, options.view);
    refuseUnheeded(given, !options.view.files.empty());
    if (options.stability) options.stabilityScenes.swap(options.view.files); // the arguments are no files
    if (!options.view.files.empty() && !options.scenes.empty())
        throw std::invalid_argument("--scene and files exclude each other. Give one of them.");
    if (options.model && options.view.files.empty()) throw std::invalid_argument("--model needs a FILE.");
    requireConsistent(options.view);
    setSize(options, sized);
    return options;
}

std::string chartHelp() {
    ChartOptions defaults;
    return "gnomonchart [FILE...] [OPTION...]\n"
           "gnomonchart --stability [SCENE...] [OPTION...]\n"
           "Measures how fast and how wrong every shadow technique is, Gnomon's and osgShadow's in the same run: in\n"
           "built-in scenes, or in a scene of your own. FILES form one scene, in any format that OpenSceneGraph "
           "reads.\n\n"
           "Writes results.json, results.csv, pictures and index.html. Ctrl-C ends the run early and keeps its "
           "results.\n"
           "Lengths are in the scene's unit. The z axis points up. Times are the milliseconds that shadows add to a "
           "frame.\n\n" +
           describeOptions(chartOptions(defaults)) + osgOptionsHelp() +
           "\nThe options for scene, light and camera apply to FILES only.\n"
           "\nExample: gnomonchart bunny.obj --quick --out bunny-chart\n";
}

/// Draws the figures and the page of the results in a folder, and prints what they say: report.py does.
///
/// Needs   python3 with matplotlib and jinja2, when it is called.
/// @return its status; where that is not 0 it has said why. @throws std::runtime_error, one sentence, if Python cannot be started.
int report(const std::string& folder) {
    std::cout.flush();
    setenv("GNOMON_RESULTS", folder.c_str(), 1);       // which a shell need not quote
    const auto before = std::signal(SIGPIPE, SIG_IGN); // where Python cannot be started
    std::FILE* python = popen("p='" PYTHON3 "'; test -x \"$p\" || p=python3; exec \"$p\" - \"$GNOMON_RESULTS\"", "w");
    if (python) std::fputs(report_py, python);
    const int status = python ? pclose(python) : -1;
    std::signal(SIGPIPE, before);
    if (status == -1 || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
        throw std::runtime_error("the report needs Python, which cannot be started. Install python3.");
    return status == 0 ? 0 : 1;
}

/// The same of what was just measured. @throws std::runtime_error, one sentence, if it fails.
void writeReport(const std::string& folder) {
    if (report(folder) != 0) throw std::runtime_error("the report could not be made; the results are kept.");
}

constexpr const char* program = "gnomonchart";
constexpr double quickSeconds = 280.0; // of five minutes
constexpr int interrupted = 130;       // as shells have it for SIGINT

volatile std::sig_atomic_t stopAsked = 0;

bool isStopped() { return stopAsked != 0; }

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

/// @return the program's exit status.
int ended(bool complete) {
    if (!complete) std::cerr << program << ": interrupted. The results so far are kept." << std::endl;
    return complete ? 0 : interrupted;
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

/// What a long run calls as it goes on; false ends it.
std::function<bool(std::size_t, const std::string&)> progressOf(std::size_t steps) {
    const auto left = std::make_shared<TimeLeft>(static_cast<double>(steps));
    return [left](std::size_t done, const std::string& doing) {
        if (done) left->show(double(done), doing);
        return !isStopped();
    };
}

/// Measures the stability table, writes it into the options' folder, and prints it.
/// @throws std::invalid_argument, one sentence, for a scene or technique that is not there; std::runtime_error, one
/// sentence, if a file cannot be written.
int stability(const ChartOptions& options, const std::string& command) {
    StabilityPlan plan = stabilityPlanOf(options);
    plan.made.insert(plan.made.begin(), {"command", command});
    requireFolder(options.out);
    listenForStop();
    std::size_t cells = 0;
    for (const StabilityScene& scene : plan.scenes) cells += scene.values.size() * plan.contenders.size();
    StabilityResults results = runStability(plan, progressOf(cells));
    dropUnfinished(results);
    for (auto& fact : machineFacts()) results.made.push_back(fact); // after the run: it makes a context
    saveStability(results, options.out);
    writeReport(options.out);
    return ended(results.complete);
}

/// Searches random scenes for shadows that Gnomon's techniques lose without a word, and prints each with the plainest scene
/// in which it is lost.
/// @return 0 if there is none, and the search went to its end.
int searchRandom(const ChartOptions& options) {
    listenForStop();
    RandomSearch search;
    search.first = options.seed;
    search.count = options.random.value_or(search.count);
    search.contenders = stabilityContenders(options.techniques, false);
    const auto isRough = [](const Entrant& each) {
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
    const unsigned done = searchRandomScenes(search, progressOf(cells), print);
    std::cout << (done < search.count ? "interrupted after " + std::to_string(done) + " of " : std::string())
              << search.count << " random scenes from seed " << search.first << ", " << faults << " faults\n";
    return faults == 0 && done == search.count ? 0 : 1;
}

const osg::Vec4d suns[] = {{1.0, -1.0, 1.4, 0.0}, {-0.8, -0.5, 0.6, 0.0}};
constexpr const char* usual[] = {"volume", "map", "traced", "auto"};

/// Pixels that are judged on this sun, and the pictures with it and without.
struct Truth {
    Truth(const ChartScene& scene) : maps(SceneTruth(*scene.content, Clear::PASSES).maps(scene.camera, scene.light)) {
        StageViewer viewer(std::make_unique<PlainStaging>(scene, Look::SHADED), scene.camera,
                           StageViewer::Colour::FLOATS);
        viewer.draw();
        lit = greysOf(*viewer.image());
        viewer.staging().setShining(false);
        viewer.draw();
        dark = greysOf(*viewer.image());
    }

    metrics::TruthMaps maps;
    metrics::Picture lit, dark;
};

nlohmann::json judgement(const ChartScene& scene, const Truth& truth, const std::string& technique) {
    StageViewer viewer(gnomonContender(technique, Receives::EVERYTHING).stage(scene, Look::SHADED), scene.camera,
                       StageViewer::Colour::FLOATS);
    for (int frame = 0; frame < 3; ++frame) viewer.draw();
    const metrics::Picture seen = metrics::visibility(greysOf(*viewer.image()), truth.lit, truth.dark).value;
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
    plan.disc = !options.quick && !options.brief;
    plan.brief = options.brief;
    plan.made = {{"size", std::to_string(options.view.width) + "x" + std::to_string(options.view.height)},
                 {"frames", std::to_string(plan.frames)},
                 {"flicker frames", std::to_string(plan.flickerFrames)},
                 {"sweep", options.quick ? "narrow" : "wide"},
                 {"settings", options.brief ? "brief" : "all"}};
    return plan;
}

std::string commandOf(const std::vector<std::string>& words) {
    std::string command = program;
    for (std::size_t i = 1; i < words.size(); ++i) command += " " + words[i];
    return command;
}

/// With it a run of the chart starts this program again, on the same scenes: see answerAlone(). For no user.
constexpr const char* aloneOption = "--alone";

int chart(const ChartOptions& options, const std::vector<std::string>& words) {
    ChartPlan plan = planOf(options);
    plan.made.insert(plan.made.begin(), {"command", commandOf(words)});
    plan.alone = words;
    plan.alone.front() = thisProgram();
    plan.alone.push_back(aloneOption);
    entrants(options.techniques, true); // so that no folder is made for names that are none
    requireFolder(options.out);
    if (options.resume) plan.kept = keptOf(loadResults(options.out), plan);
    listenForStop();
    const ChartResults results = runChart(
        plan, [&](const ChartResults& sofar) { saveResults(sofar, options.out); }, isStopped);
    for (const auto& [name, value] : results.made)
        if (name.rfind("left out", 0) == 0) std::cout << name << ": " << value << "\n";
    writeReport(options.out);
    return ended(results.complete);
}

int answer(const ChartOptions& options, const std::string& request) {
    listenForStop();
    answerAlone(request, planOf(options).scene, isStopped);
    return 0;
}

int run(osg::ArgumentParser& arguments) {
    const std::vector<std::string> words(arguments.argv(), arguments.argv() + arguments.argc());
    std::string request;
    const bool isAlone = arguments.read(aloneOption, request);
    const ChartOptions options = readChartOptions(arguments);
    if (options.help)
        std::cout << chartHelp();
    else if (options.list)
        listNames();
    else if (!options.again.empty())
        return report(options.again);
    else if (options.model)
        judgeModel(options);
    else if (options.random)
        return searchRandom(options);
    else if (options.stability)
        return stability(options, commandOf(words));
    else if (isAlone)
        return answer(options, request);
    else
        return chart(options, words);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram(program, argc, argv, run); }
