// SPDX-License-Identifier: MIT
#include "ChartOptions.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int leastFrames = 2, mostFrames = 10000;
constexpr int mostFlickerFrames = 1000;
constexpr int mostRandom = 1000000, mostSeed = 1000000000;
constexpr int stabilityWidth = 160, stabilityHeight = 120;
constexpr int leastSide = 32; // pixels; smaller pictures have no pixel that is judged

// Every technique is measured, each with its own casters and receivers, under light of the chart's own.
constexpr std::array<const char*, 5> notOfUse{"--shadow", "--casters", "--ambient", "--diffuse", "--background"};

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

} // namespace

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

} // namespace gnomon::examples
