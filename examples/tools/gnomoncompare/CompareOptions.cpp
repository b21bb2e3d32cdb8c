// SPDX-License-Identifier: MIT
#include "CompareOptions.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

using Text = const std::string&;

void addPictures(Options& table, CompareOptions& into) {
    table.push_back({"--casting", "IMAGE", "A: the picture with shadows; linear, white and unlit but for them",
                     "needed", [&into](Text t) { into.casting = t; }});
    table.push_back({"--not-casting", "IMAGE", "B: the same renderer, all drawn and nothing casting; needed", "",
                     [&into](Text t) { into.notCasting = t; }});
    table.push_back(
        {"--truth", "FILE.osgb", "what is true, see below; needed", "", [&into](Text t) { into.truth = t; }});
    table.push_back({"--shadowed", "IMAGE", "S: the same with everything in shadow", "none, then --ambient",
                     [&into](Text t) { into.shadowed = t; }});
    table.push_back({"--ambient", "GREY", "grey of full shadow, 0 to 1, in place of --shadowed", "0",
                     [&into](Text t) { into.ambient = readNumber(t, 0.0, 1.0); }});
}

void addOutputs(Options& table, CompareOptions& into) {
    table.push_back({"--overlay", "IMAGE",
                     "picture to write: the visibility, dark where it is not judged; missed shadow red, false shadow\n"
                     "      blue (pale on edges), no number magenta",
                     "none", [&into](Text t) { into.overlay = t; }});
    table.push_back({"--json", "FILE.json", "all numbers, in full", "none", [&into](Text t) { into.json = t; }});
}

void addLimits(Options& table, CompareOptions& into) {
    table.push_back({"--contact", "METRES", "blockers nearer than this make a pixel one of contact, 0 to 1e12", "0.5",
                     [&into](Text t) { into.limits.contact = readNumber(t, 0.0, largestNumber); }});
    table.push_back({"--attached", "PIXELS", "what is nearer to a true boundary than this belongs to it, 0 to 1e12",
                     "2", [&into](Text t) { into.limits.boundary = readNumber(t, 0.0, largestNumber); }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
}

Options compareOptions(CompareOptions& into) {
    Options table;
    addPictures(table, into);
    addOutputs(table, into);
    addLimits(table, into);
    return table;
}

void require(const std::string& file, const char* option) {
    if (file.empty()) throw std::invalid_argument(std::string(option) + " is needed; --help says what it is.");
}

void requireConsistent(osg::ArgumentParser& arguments, const CompareOptions& options, bool ambient) {
    if (arguments.argc() > 1)
        throw std::invalid_argument(std::string("there is nothing to do with \"") + arguments.argv()[1] +
                                    "\"; files come after options.");
    require(options.casting, "--casting");
    require(options.notCasting, "--not-casting");
    require(options.truth, "--truth");
    if (ambient && !options.shadowed.empty())
        throw std::invalid_argument("--shadowed and --ambient are given; one of them is allowed.");
}

} // namespace

CompareOptions readCompareOptions(osg::ArgumentParser& arguments) {
    CompareOptions options;
    const bool ambient = arguments.find("--ambient") > 0;
    readOptions(arguments, compareOptions(options));
    readOsgOptions(arguments);
    if (options.help) return options;
    refuseUnknownOptions(arguments);
    requireConsistent(arguments, options, ambient);
    return options;
}

std::string compareHelp() {
    CompareOptions defaults;
    return "gnomoncompare --casting A --not-casting B --truth T [OPTION...]\n"
           "Says how wrong the shadows of a picture are, whichever renderer drew it.\n\n"
           "Visibility is V = (A - S) / (B - S), pixel by pixel. Pictures are taken as linear; in 32-bit floats "
           "(.tif,\n"
           ".osgb, .osgt, .osgx, .ktx) nothing is lost, in bytes V is known to 1/255 of B - S. Distances are in "
           "pixels.\n\n" +
           describeOptions(compareOptions(defaults)) + osgOptionsHelp() +
           "\nTRUTH is an osg::Image of floats, a layer a map, named by its descriptions: lit (share of 16 rays), "
           "litCentre,\n"
           "blockerDistance (metres), receiver (id, 0 is none), facing (cosine to the light); optional drawn (id), "
           "litByDisc,\n"
           "blocker (id), edgeLength (metres), x, y, z (metres), and the user values towardsLight and up.\n\n"
           "Example: gnomoncompare --casting on.tif --not-casting off.tif --truth t.osgb --overlay errors.png\n";
}

} // namespace gnomon::examples
