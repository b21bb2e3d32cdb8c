// SPDX-License-Identifier: MIT
#include "TownOptions.h"
#include "RunningSun.h"
#include "SceneWindow.h"
#include "TownControls.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using Text = const std::string&;

constexpr int mostBuildings = 1000000;

ShadowSpec readTownSpec(Text text) {
    const ShadowSpec spec = parseShadowSpec(text);
    const auto& allowed = townTechniques();
    if (std::find(allowed.begin(), allowed.end(), spec.technique) == allowed.end())
        throw std::invalid_argument("Allowed: none, box, hull.");
    return spec;
}

Options townOptions(TownOptions& into) {
    Options table;
    table.push_back({"--shadow", "none|box|hull", "shadow technique, with keys as in SPEC below", "hull",
                     [&into](Text t) { into.view.shadows = {readTownSpec(t)}; }});
    table.push_back({"--hour", "H",
                     "mean solar time on 20 March, 6.5 to 17.5 hours; the sun is due south shortly after 12", "9",
                     [&into](Text t) { into.hour = readNumber(t, firstHour, lastHour); }});
    table.push_back(sunSpeedOption(into.sunSpeed));
    table.push_back({"--objects", "N", "number of buildings, 1 to 1000000, each on a plot of 45 by 45 m", "400",
                     [&into](Text t) { into.plan.buildings = readWhole(t, 1, mostBuildings); }});
    addSize(table, into.view);
    table.push_back({"--out", "IMAGE", "write one picture to this file, without a window or display", "a window",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--report", "FOLDER",
                     "write morning, noon and evening (8, 12 and 16 h) with each technique to this folder, as\n      "
                     "NAME-TECHNIQUE.png, without a window or display",
                     "a window", [&into](Text t) { into.report = t; }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
    return table;
}

void takeElevation(osg::ArgumentParser& arguments, TownOptions& into) {
    takeFiles(arguments, into.view);
    if (into.view.files.size() > 1)
        throw std::invalid_argument("\"" + into.view.files[1] + "\" is a second elevation model. Give only one.");
    into.elevation = into.view.files.empty() ? GNOMON_JACKSBORO : into.view.files.front();
}

} // namespace

const std::vector<std::string>& townTechniques() {
    static const std::vector<std::string> names = {"none", "box", "hull"};
    return names;
}

TownOptions readTownOptions(osg::ArgumentParser& arguments) {
    TownOptions options;
    options.view.shadows = {parseShadowSpec("hull")};
    readOptions(arguments, townOptions(options));
    readOsgOptions(arguments);
    if (options.help) return options;
    takeElevation(arguments, options);
    if (!options.out.empty() && !options.report.empty())
        throw std::invalid_argument("--out and --report exclude each other. Give one of them.");
    return options;
}

std::string townHelp() {
    TownOptions defaults;
    return "arl_terrain [ELEVATION] [OPTION...]\n"
           "Shows a town on an elevation model, with shadows by the bounding-box method of ARL-TN-156 (box)\n"
           "and by its successor (hull).\n\n"
           "ELEVATION is a file that GDAL reads, in metres, with .gdal added to its name: dem.tif.gdal. The default "
           "is\n"
           "the mountains around the Jacksboro fault, data/jacksboro.vrt.gdal.\n\n" +
           describeOptions(townOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp(townTechniques()) +
           "\nKEYS\n" + keysHelp(townKeys()) + windowKeysHelp("arl_terrain") +
           "\nExample: arl_terrain --shadow box --hour 16.5 --out town.png\n";
}

} // namespace gnomon::examples
