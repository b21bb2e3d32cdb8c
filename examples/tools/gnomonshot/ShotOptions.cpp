// SPDX-License-Identifier: MIT
#include "ShotOptions.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int mostFrames = 100000;

using Text = const std::string&;

void addShotOptions(Options& table, ShotOptions& into) {
    table.push_back({"--frames", "N", "frames to draw before the picture is taken, 1 to 100000", "1, with --stats 20",
                     [&into](Text t) { into.frames = readWhole(t, 1, mostFrames); }});
    table.push_back({"--out", "IMAGE", "picture to write; its ending chooses among OpenSceneGraph's formats", "none",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--stats", "FILE.json",
                     "measurements to write; times of whole frames in ms: msFirst, msSteady, msMoving (the light "
                     "turns\n      1 degree a frame about the z axis) and msNone (without shadows, interleaved)",
                     "none", [&into](Text t) { into.stats = t; }});
    table.push_back({"--truth", "FILE.osgb",
                     "true shadows of this view by ray casting, for gnomoncompare; needs one light and all casters",
                     "none", [&into](Text t) { into.truth = t; }});
    table.push_back({"--recommend", "",
                     "print what could draw each light's shadow, with predicted errors and times; the choice of\n"
                     "      --shadow auto first",
                     "", [&into](Text) { into.recommend = true; }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
}

Options shotOptions(ShotOptions& into) {
    Options table = viewOptions(into.view);
    addShotOptions(table, into);
    return table;
}

void requireOutput(const ShotOptions& options) {
    if (options.out.empty() && options.stats.empty() && options.truth.empty() && !options.recommend)
        throw std::invalid_argument(
            "no output is asked for. Give --out IMAGE, --stats FILE.json, --truth FILE.osgb or --recommend.");
    if (!options.truth.empty() && options.view.casters != "all")
        throw std::invalid_argument(
            "--truth and --casters exclude each other. Give one of them: the truth is that of all casters.");
}

void requireAuto(ShotOptions& options) {
    const std::vector<ShadowSpec>& shadows = options.view.shadows;
    if (!options.recommend) return;
    options.view.isUsual = false;
    if (shadows.size() > 1 || shadows.front().technique != "auto")
        throw std::invalid_argument(
            "--recommend needs --shadow auto and no other. Leave --shadow out, or give its budget.");
}

} // namespace

ShotOptions readShotOptions(osg::ArgumentParser& arguments) {
    ShotOptions options;
    readOptions(arguments, shotOptions(options));
    readOsgOptions(arguments);
    if (options.help) return options;
    readFiles(arguments, options.view);
    takeUsualShadow(options.view);
    requireOutput(options);
    requireConsistent(options.view);
    requireAuto(options);
    return options;
}

std::string shotHelp() {
    ShotOptions defaults;
    return "gnomonshot FILE... [OPTION...]\nRenders scene files with shadows to an image, without a display or "
           "GPU.\n\nLengths are in the scene's unit. The z axis points up.\n\n" +
           describeOptions(shotOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp() +
           "\nExample: gnomonshot bunny.obj --out bunny.png\n";
}

} // namespace gnomon::examples
