// SPDX-License-Identifier: MIT
// gnomonshot: scene files in, a picture with shadows out; no display, no GPU.
#include "OutputFile.h"
#include "Recommendation.h"
#include "SceneFile.h"
#include "Shot.h"
#include "TruthFile.h"

#include <iostream>
#include <optional>

namespace {

using namespace gnomon::examples;

void shoot(const ShotOptions& options) {
    std::optional<OutputFile> picture, stats, truth;
    if (!options.out.empty()) picture.emplace(options.out).requireImage();
    if (!options.stats.empty()) stats.emplace(options.stats);
    if (!options.truth.empty()) truth.emplace(options.truth).requireData();
    Shot shot(options, *readScene(options.view.files, "gnomonshot"));
    nlohmann::json measured;
    stats ? void(measured = shot.measure()) : shot.draw();
    for (const std::string& cause : shot.diagnose()) std::cerr << "gnomonshot: note: " << cause << std::endl;
    if (options.recommend) std::cout << recommendation(shot.decisions());
    if (picture) picture->write(*shot.picture());
    if (truth) truth->writeData(*truthImage(shot.truth()));
    if (stats) stats->write(measured.dump(2) + "\n");
}

int run(osg::ArgumentParser& arguments) {
    const ShotOptions options = readShotOptions(arguments);
    if (options.help)
        std::cout << shotHelp();
    else
        shoot(options);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("gnomonshot", argc, argv, run); }
