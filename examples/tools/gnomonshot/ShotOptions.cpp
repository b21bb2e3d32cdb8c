// SPDX-License-Identifier: MIT
#include "ShotOptions.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int mostFrames = 100000;

using Text = const std::string&;

void addShotOptions(Options& table, ShotOptions& into) {
    table.push_back({"--frames", "N", "frames to draw before the picture, 1 to 100000", "1, with --stats 20",
                     [&into](Text t) { into.frames = readWhole(t, 1, mostFrames); }});
    table.push_back({"--out", "IMAGE", "picture to write, in any format OpenSceneGraph writes, by its ending", "none",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--stats", "FILE.json",
                     "measurements to write; times are whole frames in ms: msFirst, msSteady, msMoving (the light "
                     "turned\n      1 degree a frame about up) and msNone (without shadows, interleaved)",
                     "none", [&into](Text t) { into.stats = t; }});
    table.push_back({"--truth", "FILE.osgb",
                     "what is true in this view, by rays, for gnomoncompare; of one light, all casting", "none",
                     [&into](Text t) { into.truth = t; }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
}

Options shotOptions(ShotOptions& into) {
    Options table = viewOptions(into.view);
    addShotOptions(table, into);
    return table;
}

void requireOutput(const ShotOptions& options) {
    if (options.out.empty() && options.stats.empty() && options.truth.empty())
        throw std::invalid_argument("nothing is asked for; give --out IMAGE, --stats FILE.json or --truth FILE.osgb.");
    if (!options.truth.empty() && options.view.casters != "all")
        throw std::invalid_argument("--truth and --casters are given; the truth is that of all casters.");
}

} // namespace

ShotOptions readShotOptions(osg::ArgumentParser& arguments) {
    ShotOptions options;
    readOptions(arguments, shotOptions(options));
    readOsgOptions(arguments);
    if (options.help) return options;
    readFiles(arguments, options.view);
    requireOutput(options);
    requireConsistent(options.view);
    return options;
}

std::string shotHelp() {
    ShotOptions defaults;
    return "gnomonshot FILE... [OPTION...]\n"
           "Draws scene files with shadows into a picture, without display or GPU.\n\n"
           "Lengths are in the scene's unit; everything is z up.\n\n" +
           describeOptions(shotOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp() +
           "\nExample: gnomonshot bunny.obj --shadow planar --out bunny.png\n";
}

} // namespace gnomon::examples
