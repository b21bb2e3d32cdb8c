// SPDX-License-Identifier: MIT
#include "TownOptions.h"
#include "RunningSun.h"
#include "SceneWindow.h"

#include <algorithm>
#include <cmath>
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

constexpr double step = 0.5; // hours

std::string whole(double number) { return std::to_string(std::lround(number)); }

std::string clockTime(double hour) {
    const long minutes = std::lround(hour * 60.0);
    return std::to_string(minutes / 60) + (minutes % 60 < 10 ? ":0" : ":") + std::to_string(minutes % 60);
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

TownControls::TownControls(TownScene& town) : _town(town) {
    const ShadowSpec& given = town.view().shadows.front();
    for (const std::string& name : townTechniques()) {
        if (name == given.technique) _chosen = _choices.size();
        _choices.push_back(name == given.technique ? given : parseShadowSpec(name));
    }
}

void TownControls::nextTechnique() {
    _chosen = (_chosen + 1) % _choices.size();
    _town.setup().castAsComposed({_choices[_chosen]});
}

void TownControls::toggleComposite() { _town.setup().toggleComposite(); }

void TownControls::passTime(double hours) { _town.setHour(std::clamp(_town.hour() + hours, firstHour, lastHour)); }

std::vector<std::string> TownControls::describe() const {
    const bool blends = _town.setup().blends();
    const SunPosition sun = townSun(_town.hour());
    std::vector<std::string> lines = {"shadow: " + _choices[_chosen].text + " (n: next)",
                                      std::string("composite: ") + (blends ? "blend" : "relight") + " (r: the other)",
                                      "sun at " + clockTime(_town.hour()) + ": azimuth " + whole(sun.azimuth) +
                                          ", elevation " + whole(sun.elevation) + " degrees (j: earlier, k: later)",
                                      "h shows all keys, g hides this text"};
    for (const std::string& cause : _town.setup().diagnose()) lines.push_back(cause);
    return lines;
}

const std::vector<Key<TownControls>>& townKeys() {
    static const std::vector<Key<TownControls>> keys = {
        {'n', "Next shadow technique: none, box, hull.", [](TownControls& c, Hud&) { c.nextTechnique(); }},
        {'r', "Switch between relight and blend.", [](TownControls& c, Hud&) { c.toggleComposite(); }},
        {'j', "Half an hour earlier.", [](TownControls& c, Hud&) { c.passTime(-step); }},
        {'k', "Half an hour later.", [](TownControls& c, Hud&) { c.passTime(step); }},
        {'g', "Hide or show Gnomon's text.", [](TownControls&, Hud& hud) { hud.toggle(); }},
    };
    return keys;
}

} // namespace gnomon::examples
