// SPDX-License-Identifier: MIT
// gnomoncompare: two pictures and a truth in; how wrong the shadows are, and where, out.
#include "CompareOptions.h"
#include "ImageFile.h"
#include "OutputFile.h"
#include "Overlay.h"
#include "Report.h"
#include "TruthFile.h"

#include <iostream>
#include <optional>
#include <stdexcept>

namespace {

using namespace gnomon::examples;
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

metrics::Visibility readVisibility(const CompareOptions& options) {
    const metrics::Picture casting = readGrey(options.casting, program);
    const metrics::Picture notCasting = readGrey(options.notCasting, program);
    requireSize(casting, options, notCasting, options.notCasting);
    metrics::Picture shadowed(casting.width, casting.height, options.ambient);
    if (!options.shadowed.empty()) shadowed = readGrey(options.shadowed, program);
    requireSize(casting, options, shadowed, options.shadowed);
    return metrics::visibility(casting, notCasting, shadowed);
}

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
    const metrics::Visibility visibility = readVisibility(options);
    const metrics::TruthMaps truth = readTruth(options.truth, program);
    const metrics::ShadowMetrics result = measure(visibility, truth, options);
    std::cout << reportText(result);
    if (!result.sound)
        std::cerr << program << ": note: more than 5 % of the surface is dropped. Do not trust these numbers."
                  << std::endl;
    if (overlay) overlay->write(*errorOverlay(visibility.value, truth));
    if (json) json->write(reportJson(result).dump(2) + "\n");
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
