// SPDX-License-Identifier: MIT
// gnomoncompare: two pictures and a truth in; how wrong the shadows are, and where, out.
#include "CommandLine.h"
#include "ImageFile.h"
#include "OutputFile.h"
#include "Report.h"

#include <metrics/CauseSplit.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <stdexcept>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

/// What gnomoncompare is asked for.
struct CompareOptions {
    std::string casting, notCasting, truth; ///< files; all three are needed
    std::string shadowed;                   ///< file; empty: `ambient` everywhere
    double ambient = 0.0;
    std::string overlay, json; ///< files to write; empty: none
    metrics::CauseLimits limits;
    bool help = false;
};

using Text = const std::string&;

void addPictures(Options& table, CompareOptions& into) {
    table.push_back({"--casting", "IMAGE",
                     "A: the picture with shadows, linear; surfaces white and unlit apart from shadows; required", "",
                     [&into](Text t) { into.casting = t; }});
    table.push_back({"--not-casting", "IMAGE", "B: the same, with everything drawn and nothing casting; required", "",
                     [&into](Text t) { into.notCasting = t; }});
    table.push_back({"--truth", "FILE.osgb", "the true shadows, see TRUTH below; required", "",
                     [&into](Text t) { into.truth = t; }});
    table.push_back({"--shadowed", "IMAGE", "S: the same, with everything in shadow", "none, --ambient is used",
                     [&into](Text t) { into.shadowed = t; }});
    table.push_back({"--ambient", "GREY", "grey level of full shadow, 0 to 1, instead of --shadowed", "0",
                     [&into](Text t) { into.ambient = readNumber(t, 0.0, 1.0); }});
}

void addOutputs(Options& table, CompareOptions& into) {
    table.push_back(
        {"--overlay", "IMAGE",
         "picture to write: visibility, dark where not judged; missed shadow red, false shadow blue (pale on\n"
         "      edges), NaN magenta",
         "none", [&into](Text t) { into.overlay = t; }});
    table.push_back(
        {"--json", "FILE.json", "file to write with all numbers", "none", [&into](Text t) { into.json = t; }});
}

void addLimits(Options& table, CompareOptions& into) {
    table.push_back({"--contact", "METRES", "a pixel counts as contact if its blocker is nearer than this, 0 to 1e12",
                     "0.5", [&into](Text t) { into.limits.contact = readNumber(t, 0.0, largestNumber); }});
    table.push_back({"--attached", "PIXELS", "a pixel belongs to a true boundary that is nearer than this, 0 to 1e12",
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
    if (file.empty()) throw std::invalid_argument(std::string(option) + " is missing. See --help.");
}

void requireConsistent(osg::ArgumentParser& arguments, const CompareOptions& options, bool ambient) {
    if (arguments.argc() > 1)
        throw std::invalid_argument(std::string("no option takes \"") + arguments.argv()[1] +
                                    "\". Give each file after its option.");
    require(options.casting, "--casting");
    require(options.notCasting, "--not-casting");
    require(options.truth, "--truth");
    if (ambient && !options.shadowed.empty())
        throw std::invalid_argument("--shadowed and --ambient exclude each other. Give one of them.");
}

/// @throws std::invalid_argument, one sentence, for what cannot be used.
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
           "Measures the errors of a picture's shadows. Any renderer may have drawn it.\n\n"
           "Visibility is V = (A - S) / (B - S), for each pixel. Pictures are read as linear. 32-bit floats (.tif, "
           ".osgb,\n"
           ".osgt, .osgx, .ktx) lose nothing; with bytes, V is exact to 1/255 of B - S. Distances are in pixels.\n\n" +
           describeOptions(compareOptions(defaults)) + osgOptionsHelp() +
           "\nTRUTH is an osg::Image of floats with one layer for each map, named by the image's descriptions.\n"
           "Required: lit (share of 16 rays), litCentre, blockerDistance (metres), receiver (id, 0 is none), facing "
           "(cosine\n"
           "to the light). Optional: drawn (id), litByDisc, blocker (id), edgeLength (metres), x, y, z (metres), and "
           "the\n"
           "user values towardsLight and up.\n\n"
           "LIMITS\nPictures and truth must be of one view of one scene in one light. It is told where they cannot "
           "be:\n"
           "where A is brighter than B, or differs from it where the truth has no surface. Another view of the same\n"
           "even ground cannot be told from wrong shadows.\n\n"
           "Example: gnomoncompare --casting on.tif --not-casting off.tif --truth t.osgb --overlay errors.png\n";
}

namespace metrics = gnomon::metrics;

constexpr const char* program = "gnomoncompare";

std::string sizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

template <typename T>
void requireSize(const metrics::Picture& first, const CompareOptions& options, const metrics::Grid<T>& other,
                 const std::string& file) {
    if (first.sameSize(other)) return;
    throw std::runtime_error("\"" + file + "\" is " + sizeText(other.width, other.height) + " px and \"" +
                             options.casting + "\" " + sizeText(first.width, first.height) +
                             " px. Give files of one size.");
}

/// A, B and S, of one size.
struct Pictures {
    metrics::Picture casting, notCasting, shadowed;
};

Pictures readPictures(const CompareOptions& options) {
    Pictures result;
    result.casting = readGrey(options.casting, program);
    result.notCasting = readGrey(options.notCasting, program);
    requireSize(result.casting, options, result.notCasting, options.notCasting);
    result.shadowed = metrics::Picture(result.casting.width, result.casting.height, options.ambient);
    if (!options.shadowed.empty()) result.shadowed = readGrey(options.shadowed, program);
    requireSize(result.casting, options, result.shadowed, options.shadowed);
    return result;
}

/// Share of the pixels where no shadow can be what A and B differ by: A is brighter, or the truth has no surface there.
double strangeShare(const Pictures& pictures, const metrics::TruthMaps& truth) {
    std::size_t strange = 0;
    for (std::size_t i = 0; i < truth.receiver.cells.size(); ++i) {
        const double brighter = pictures.casting.cells[i] - pictures.notCasting.cells[i];
        strange += brighter > metrics::leastContrast ||
                   (truth.receiver.cells[i] == 0 && std::abs(brighter) > metrics::leastContrast);
    }
    return double(strange) / double(truth.receiver.cells.size());
}

/// Pictures of one view have next to none; a view from elsewhere has some percent.
constexpr double mostStrange = 0.01;

metrics::ShadowMetrics measure(const metrics::Visibility& visibility, const metrics::TruthMaps& truth,
                               const CompareOptions& options) {
    requireSize(visibility.value, options, truth.lit, options.truth);
    const metrics::ShadowMetrics result = metrics::shadowMetrics(visibility, truth, options.limits);
    if (result.facing == 0)
        throw std::runtime_error("no pixel can be judged. A pixel must face the light, show the object that the truth "
                                 "has there, and be brighter by 8/255 in B than in S.");
    return result;
}

void compare(const CompareOptions& options) {
    std::optional<OutputFile> overlay, json;
    if (!options.overlay.empty()) overlay.emplace(options.overlay).requireImage();
    if (!options.json.empty()) json.emplace(options.json);
    const Pictures pictures = readPictures(options);
    const metrics::Visibility visibility =
        metrics::visibility(pictures.casting, pictures.notCasting, pictures.shadowed);
    const metrics::TruthMaps truth = readTruth(options.truth, program);
    const metrics::ShadowMetrics result = measure(visibility, truth, options);
    std::cout << reportText(result);
    if (const double strange = strangeShare(pictures, truth); strange > mostStrange)
        std::cerr << program << ": note: these numbers mean nothing, because A is brighter than B, or differs from it "
                  << "where the truth has no surface, at " << std::lround(100.0 * strange)
                  << " % of the pixels; draw A, B and the truth with one camera and light." << std::endl;
    if (!result.sound)
        std::cerr << program << ": note: more than 5 % of the surface is dropped. Do not trust these numbers."
                  << std::endl;
    if (overlay) overlay->write(*errorOverlay(visibility.value, truth));
    if (json) json->write(jsonOf(result).dump(2) + "\n");
}

int run(osg::ArgumentParser& arguments) {
    const CompareOptions options = readCompareOptions(arguments);
    if (options.help)
        std::cout << compareHelp();
    else
        compare(options);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram(program, argc, argv, run); }
