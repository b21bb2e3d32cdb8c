// SPDX-License-Identifier: MIT
#include "ShotOptions.h"

#include <osgDB/Registry>

#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int largestSide = 16384;
constexpr int mostFrames = 100000;

using Text = const std::string&;

void takeSize(ShotOptions& into, Text text) {
    const std::size_t cross = text.find('x');
    try {
        into.width = readWhole(text.substr(0, cross), 1, largestSide);
        into.height = cross == std::string::npos ? 0 : readWhole(text.substr(cross + 1), 1, largestSide);
    } catch (const std::invalid_argument&) {
        into.height = 0;
    }
    if (into.height == 0) throw std::invalid_argument("allowed: WIDTHxHEIGHT from 1x1 to 16384x16384 pixels.");
}

void addShotOptions(Options& table, ShotOptions& into) {
    table.push_back({"--size", "WxH", "of the picture, 1x1 to 16384x16384 pixels", "800x600",
                     [&into](Text t) { takeSize(into, t); }});
    table.push_back({"--frames", "N", "frames to draw before the picture, 1 to 100000", "1, with --stats 20",
                     [&into](Text t) { into.frames = readWhole(t, 1, mostFrames); }});
    table.push_back({"--out", "IMAGE", "picture to write, in any format OpenSceneGraph writes, by its ending", "none",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--stats", "FILE.json",
                     "measurements to write; times are whole frames in ms: msFirst, msSteady, msMoving (the light "
                     "turned\n      1 degree a frame about up) and msNone (without shadows, interleaved)",
                     "none", [&into](Text t) { into.stats = t; }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
}

Options shotOptions(ShotOptions& into) {
    Options table = viewOptions(into.view);
    addShotOptions(table, into);
    return table;
}

void requireFilesAndOutput(const ShotOptions& options) {
    if (options.view.files.empty()) throw std::invalid_argument("no scene file is given; --help says how.");
    if (options.out.empty() && options.stats.empty())
        throw std::invalid_argument("nothing is asked for; give --out IMAGE, --stats FILE.json or both.");
}

/// OpenSceneGraph's own options take the argument that follows them, whether it is there or not.
void readOsgOptions(osg::ArgumentParser& arguments) {
    for (const char* name : {"-O", "-e", "-l"})
        if (arguments.find(name) == arguments.argc() - 1)
            throw std::invalid_argument(std::string(name) + " needs a value.");
    osgDB::Registry::instance()->readCommandLine(arguments);
}

} // namespace

ShotOptions readShotOptions(osg::ArgumentParser& arguments) {
    ShotOptions options;
    readOptions(arguments, shotOptions(options));
    readOsgOptions(arguments);
    if (options.help) return options;
    refuseUnknownOptions(arguments);
    for (int i = 1; i < arguments.argc(); ++i) options.view.files.push_back(arguments[i]);
    requireFilesAndOutput(options);
    requireConsistent(options.view);
    return options;
}

std::string shotHelp() {
    ShotOptions defaults;
    return "gnomonshot FILE... [OPTION...]\n"
           "Draws scene files with shadows into a picture, without display or GPU.\n\n"
           "Lengths are in the scene's unit; everything is z up.\n\n" +
           describeOptions(shotOptions(defaults)) +
           "  -O TEXT, -e EXT, -l LIBRARY\n      as in other OpenSceneGraph programs\n\n" + "SPEC\n" +
           shadowSpecHelp() + "\nExample: gnomonshot bunny.obj --shadow planar --out bunny.png\n";
}

} // namespace gnomon::examples
