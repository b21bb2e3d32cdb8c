// SPDX-License-Identifier: MIT
#include "ChartOptions.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int leastFrames = 2, mostFrames = 10000;
constexpr int leastSide = 32; // pixels; smaller pictures have no pixel that is judged

// Every technique is measured, each with its own casters and receivers, under light of the chart's own.
constexpr std::array<const char*, 5> notOfUse{"--shadow", "--casters", "--ambient", "--diffuse", "--background"};

using Text = const std::string&;

void addChartOptions(Options& table, ChartOptions& into) {
    table.push_back({"--scene", "NAME", "a built-in scene; --list names them", "all, if no FILE is given",
                     [&into](Text t) { into.scenes.push_back(t); }, true});
    table.push_back({"--technique", "TEXT", "only techniques whose name holds this; --list names them", "all",
                     [&into](Text t) { into.technique = t; }});
    table.push_back({"--out", "FOLDER", "where results and pictures go; it is made if it is not there", "chart-out",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--quick", "",
                     "small pictures, few frames, narrow sweeps and, if none is named, three scenes: within five "
                     "minutes on\n      two cores",
                     "", [&into](Text) { into.quick = true; }});
    table.push_back({"--frames", "N", "frames timed, of each motion, 2 to 10000", "60, with --quick 12",
                     [&into](Text t) { into.frames = readWhole(t, leastFrames, mostFrames); }});
    table.push_back({"--resume", "",
                     "go on with an interrupted run: scenes that FOLDER holds whole are not measured again", "",
                     [&into](Text) { into.resume = true; }});
    table.push_back({"--again", "FOLDER",
                     "measure nothing: draw the figures and index.html in FOLDER again from its results.json", "",
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
    if (!given) {
        options.view.width = options.quick ? 320 : 640;
        options.view.height = options.quick ? 240 : 480;
    }
    if (std::min(options.view.width, options.view.height) < leastSide)
        throw std::invalid_argument("--size is less than 32 pixels one way; 32x32 and more can be judged.");
}

} // namespace

ChartOptions readChartOptions(osg::ArgumentParser& arguments) {
    ChartOptions options;
    const bool sized = arguments.find("--size") > 0;
    readOptions(arguments, chartOptions(options));
    readOsgOptions(arguments);
    if (options.help || options.list) return options;
    takeFiles(arguments, options.view);
    if (!options.again.empty() && !options.view.files.empty())
        throw std::invalid_argument("--again and files are given; one of them is allowed.");
    if (!options.view.files.empty() && !options.scenes.empty())
        throw std::invalid_argument("--scene and files are given; one of them is allowed.");
    requireConsistent(options.view);
    setSize(options, sized);
    return options;
}

std::string chartHelp() {
    ChartOptions defaults;
    return "gnomonchart [FILE...] [OPTION...]\n"
           "Charts how fast and how wrong every shadow technique is, Gnomon's and osgShadow's in the same run: in "
           "built-in\n"
           "scenes, or in a scene of your own. FILES are one scene, in any format that OpenSceneGraph reads.\n\n"
           "Writes results.json, results.csv, pictures and index.html. Ctrl-C ends it early and keeps what it has.\n"
           "Lengths are in the scene's unit; everything is z up. Times are milliseconds beyond the scene without "
           "shadows.\n\n" +
           describeOptions(chartOptions(defaults)) + osgOptionsHelp() +
           "\nThe options of scene, light and camera are for FILES.\n"
           "\nExample: gnomonchart bunny.obj --quick --out bunny-chart\n";
}

} // namespace gnomon::examples
