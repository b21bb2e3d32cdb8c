// SPDX-License-Identifier: MIT
// arl_terrain: a town on mountains, in a window or a picture; its shadows by TerrainShadowGeode.
#include "Example.h"
#include "InputFile.h"
#include "ScenePicture.h"
#include "Town.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

constexpr double step = 0.5; // hours

const std::vector<std::string> techniques = {"none", "box", "hull"};

/// What the command line asks for besides what all examples have.
struct TownOptions {
    ShadowSpec shadow = parseShadowSpec("hull"); ///< one of `techniques`.
    double hour = 9.0;                           ///< solar time.
    double sunSpeed = 0.0;                       ///< of the window's sun, 1 is the clock's.
    TownPlan plan;
    std::string report; ///< folder for pictures; empty: none.
};

ShadowSpec readTownSpec(const std::string& text) {
    const ShadowSpec spec = parseShadowSpec(text);
    if (std::find(techniques.begin(), techniques.end(), spec.technique) == techniques.end())
        throw std::invalid_argument("Allowed: none, box, hull.");
    return spec;
}

Options townOptions(TownOptions& into) {
    using Text = const std::string&;
    return {{"--shadow", "none|box|hull", "shadow technique, with keys as in SPEC above", "hull",
             [&into](Text t) { into.shadow = readTownSpec(t); }},
            {"--hour", "H", "mean solar time on 20 March, 6.5 to 17.5 hours; the sun is due south shortly after 12",
             "9", [&into](Text t) { into.hour = readNumber(t, firstHour, lastHour); }},
            sunSpeedOption(into.sunSpeed),
            {"--objects", "N", "number of buildings, 1 to 1000000, each on a plot of 45 by 45 m", "400",
             [&into](Text t) { into.plan.buildings = readWhole(t, 1, 1000000); }},
            {"--report", "FOLDER",
             "write morning, noon and evening (8, 12 and 16 h) with each technique to this folder, as\n      "
             "NAME-TECHNIQUE.png, without a window or display",
             "a window", [&into](Text t) { into.report = t; }}};
}

/// What a user changes while looking at the town: technique, composite and time of day.
class TownControls {
public:
    TownControls(TownScene& town, double speed) : sunSpeed(speed), _town(town) {
        const ShadowSpec& given = town.view().shadows.front();
        for (const std::string& name : techniques) {
            if (name == given.technique) _chosen = _choices.size();
            _choices.push_back(name == given.technique ? given : parseShadowSpec(name));
        }
    }

    SceneSetup& setup() { return _town.setup(); }
    /// none, box, hull, and on from the first; that of the command line as it was given there.
    void nextTechnique() {
        _chosen = (_chosen + 1) % _choices.size();
        setup().castAsComposed({_choices[_chosen]});
    }
    /// Hours; stops while the sun is up.
    void passTime(double hours) { _town.setHour(std::clamp(_town.hour() + hours, firstHour, lastHour)); }

    std::vector<std::string> describe() const {
        const SunPosition sun = townSun(_town.hour());
        const long minutes = std::lround(_town.hour() * 60.0);
        const auto whole = [](double number) { return std::to_string(std::lround(number)); };
        std::vector<std::string> lines = {
            "shadow: " + _choices[_chosen].text + " (n: next)",
            std::string("composite: ") + (_town.setup().blends() ? "blend" : "relight") + " (r: the other)",
            "sun at " + std::to_string(minutes / 60) + (minutes % 60 < 10 ? ":0" : ":") + std::to_string(minutes % 60) +
                ": azimuth " + whole(sun.azimuth) + ", elevation " + whole(sun.elevation) +
                " degrees (j: earlier, k: later)"};
        for (const std::string& cause : _town.setup().causes()) lines.push_back(cause);
        return lines;
    }

    const double sunSpeed;

private:
    TownScene& _town;
    std::vector<ShadowSpec> _choices;
    std::size_t _chosen = 0;
};

void addHands(SceneWindow& window, TownControls& controls) {
    runSun(window, controls.sunSpeed, [&controls](double seconds) { controls.passTime(seconds / 3600.0); });
}

const std::vector<Key<TownControls>> keys = {
    {'n', "Next shadow technique: none, box, hull.", [](TownControls& c, Hud&) { c.nextTechnique(); }},
    {'r', "Switch between relight and blend.", [](TownControls& c, Hud&) { c.setup().toggleComposite(); }},
    {'j', "Half an hour earlier.", [](TownControls& c, Hud&) { c.passTime(-step); }},
    {'k', "Half an hour later.", [](TownControls& c, Hud&) { c.passTime(step); }},
    {'g', "Hide or show Gnomon's text.", [](TownControls&, Hud& hud) { hud.toggle(); }},
};

/// Morning, noon and evening, with each technique: NAME-TECHNIQUE.png.
/// @throws std::runtime_error, one sentence, if the folder cannot be made or written to.
void report(TownScene& town, const std::filesystem::path& folder) {
    requireFolder(folder);
    ScenePicture picture(town.view(), town.setup());
    for (const std::string& technique : techniques) {
        town.setup().cast({parseShadowSpec(technique)});
        for (const auto& [name, hour] : {std::pair("morning", 8.0), {"noon", 12.0}, {"evening", 16.0}}) {
            OutputFile file((folder / (std::string(name) + "-" + technique + ".png")).string());
            town.setHour(hour);
            file.write(*picture.draw());
        }
    }
}

int run(osg::ArgumentParser& arguments) {
    const ExampleText text = {
        "arl_terrain",
        "shows a town's shadows on terrain.",
        "Shows a town on an elevation model, with shadows by the bounding-box method of ARL-TN-156 (box)\n"
        "and by its successor (hull).\n\n"
        "ELEVATION is a file that GDAL reads, in metres, with .gdal added to its name: dem.tif.gdal. The default is\n"
        "the mountains around the Jacksboro fault, data/jacksboro.vrt.gdal.\n\nSPEC\n" +
            shadowSpecHelp(techniques),
        "arl_terrain --shadow box --hour 16.5 --out town.png",
        "[ELEVATION]",
        ""};
    TownOptions asked;
    auto options = readExample(arguments, text, townOptions(asked), {}, keysHelp(keys));
    if (!options) return 0;
    const std::vector<std::string>& files = options->view.files;
    if (files.size() > 1)
        throw std::invalid_argument("\"" + files[1] + "\" is a second elevation model. Give only one.");
    if (!options->out.empty() && !asked.report.empty())
        throw std::invalid_argument("--out and --report exclude each other. Give one of them.");
    if (!options->out.empty()) OutputFile(options->out).requireImage();
    options->view.shadows = {asked.shadow};
    TownScene town(options->view, asked.hour,
                   *readElevation(files.empty() ? GNOMON_JACKSBORO : files.front(), text.program), asked.plan);
    if (!asked.report.empty()) return report(town, asked.report), 0;
    options->view = town.view();
    TownControls controls(town, asked.sunSpeed);
    return showExample(text, *options, keys, controls);
}

} // namespace

int main(int argc, char** argv) { return runProgram("arl_terrain", argc, argv, run); }
