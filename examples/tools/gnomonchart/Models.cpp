// SPDX-License-Identifier: MIT
#include "Models.h"

#include "Contender.h"
#include "Pictures.h"
#include "SceneFile.h"
#include "SceneTruth.h"
#include "StabilityJudge.h"
#include "StageViewer.h"

#include <metrics/Visibility.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace gnomon::examples {
namespace {

const osg::Vec4d suns[] = {{1.0, -1.0, 1.4, 0.0}, {-0.8, -0.5, 0.6, 0.0}};
constexpr const char* usual[] = {"volume", "map", "traced", "auto"};

metrics::Picture greys(const osg::Image& image) {
    const ShadedPicture colours = coloursOf(image);
    metrics::Picture result(colours.width, colours.height);
    std::transform(colours.cells.begin(), colours.cells.end(), result.cells.begin(),
                   [](const glm::dvec3& colour) { return (colour.r + colour.g + colour.b) / 3.0; });
    return result;
}

/// Pixels that are judged on this sun, and the pictures with it and without.
struct Truth {
    Truth(const ChartScene& scene) : maps(SceneTruth(*scene.content, Clear::PASSES).maps(scene.camera, scene.light)) {
        StageViewer viewer(std::make_unique<PlainStaging>(scene, Look::SHADED), scene.camera,
                           StageViewer::Colour::FLOATS);
        viewer.draw();
        lit = greys(*viewer.image());
        viewer.staging().setShining(false);
        viewer.draw();
        dark = greys(*viewer.image());
    }

    metrics::TruthMaps maps;
    metrics::Picture lit, dark;
};

nlohmann::json judgement(const ChartScene& scene, const Truth& truth, const std::string& technique) {
    StageViewer viewer(gnomonContender(technique, Receives::EVERYTHING).stage(scene, Look::SHADED), scene.camera,
                       StageViewer::Colour::FLOATS);
    for (int frame = 0; frame < 3; ++frame) viewer.draw();
    const metrics::Picture seen = metrics::visibility(greys(*viewer.image()), truth.lit, truth.dark).value;
    const metrics::PixelSets sets = metrics::pixelSets(truth.maps, seen);
    const StabilityJudgement judged = judge(seen, truth.maps, sets, sets.agreeing);
    return {{"technique", technique},
            {"wrong", judged.wrong},
            {"shadow", judged.shadow},
            {"judged", std::count(sets.certain.cells.begin(), sets.certain.cells.end(), 1)},
            {"said", viewer.staging().diagnose()}};
}

} // namespace

void judgeModel(const ChartOptions& options) {
    const std::vector<std::string> asked =
        options.techniques.empty() ? std::vector<std::string>(std::begin(usual), std::end(usual)) : options.techniques;
    const osg::ref_ptr<osg::Node> model = readScene(options.view.files, "gnomonchart");
    for (int sun = 0; sun < 2; ++sun) {
        ViewOptions view = options.view;
        view.lights = {suns[sun]};
        const ChartScene scene = chartSceneOf(*model, view);
        const Truth truth(scene);
        for (const std::string& technique : asked) {
            nlohmann::json line = judgement(scene, truth, technique);
            line["sun"] = sun;
            std::cout << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
        }
    }
}

} // namespace gnomon::examples
