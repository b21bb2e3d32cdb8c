// SPDX-License-Identifier: MIT
// Faults of techniques in still pictures that the stability table has found.
#include "Mesh.h"
#include "StabilityResults.h"
#include "StabilityScene.h"
#include "Yardstick.h"

#include <gnomon/Convert.h>
#include <metrics/PixelSets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace gnomon::examples;

Entrant named(const std::string& technique) { return stabilityContenders({technique}, false).front(); }

/// A scene at a value: a cell each, in their order, as the table has it. Drawn by this process, and without a film, which is
/// sixteen truths more.
std::vector<StabilityCell> measured(const std::string& scene, double value, const std::vector<Entrant>& contenders,
                                    int height = 120) {
    const StabilityCase made = stabilityScenes(std::vector<std::string>{scene})[0].make(value, 4 * height / 3, height);
    const Yardstick yardstick(made.scene, false, made.truth.get());
    std::vector<StabilityCell> cells;
    for (const Entrant& each : contenders) {
        Sight sight(each.contender, yardstick.scene());
        const gnomon::metrics::Visibility seen = sight.visibility();
        const gnomon::metrics::PixelSets sets = gnomon::metrics::pixelSets(yardstick.maps(), seen.value);
        StabilityCell cell;
        cell.notFinite = seen.notFinite;
        cell.everywhere = judge(seen.value, yardstick.maps(), sets, sets.agreeing);
        cells.push_back(cell);
    }
    return cells;
}

/// V8: a sphere of few slices has teeth under a map that knows its facets alone, as osgShadow's does; a fine one has none, nor
/// has one without shadows. What is darker than that is not told from the shading.
TEST(MendedStills, TeethOfARoundBodyAreSeenOnAnyTechnique) {
    const Entrant peer = named("ShadowMap"), plain{plainContender()};
    const std::vector<StabilityCell> coarse = measured("V8", 16.0, {peer, plain}),
                                     fine = measured("V8", 200.0, {peer, plain});
    EXPECT_GT(coarse[0].everywhere.teeth.value(), 500u);
    EXPECT_FALSE(coarse[0].inBudget());
    EXPECT_LT(fine[0].everywhere.teeth.value(), 20u);
    for (const std::vector<StabilityCell>& cells : {coarse, fine}) {
        EXPECT_EQ(cells[1].everywhere.teeth.value(), 0u);
        EXPECT_TRUE(cells[1].inBudget());
    }
}

/// A sphere half in a box's shadow, above it. Only what is lit is judged: rays from below the box are no teeth.
TEST(MendedStills, TeethAreLookedForWhereNothingElseCasts) {
    ChartScene scene = stabilityScenes(std::vector<std::string>{"V8"})[0].make(48.0, 160, 120).scene;
    const auto judgedPixels = [&scene] {
        const std::vector<double> light = Yardstick(scene, false).maps().smoothLight.cells;
        return int(std::count_if(light.begin(), light.end(), [](double each) { return each > 0.0; }));
    };
    const int alone = judgedPixels();
    EXPECT_GT(alone, 1000);
    const osg::Vec3d above = osg::Vec3d(scene.light.x(), scene.light.y(), scene.light.z()) * 10.0;
    scene.content->addChild(
        node(box(gnomon::toGlm(above - osg::Vec3d(8.0, 8.0, 0.0)), gnomon::toGlm(above + osg::Vec3d(8.0, 0.0, 1.0)))));
    EXPECT_LT(judgedPixels(), 0.8 * alone);
    EXPECT_GT(judgedPixels(), 0.1 * alone);
    scene.round = "nobody";
    EXPECT_THROW(judgedPixels(), std::invalid_argument);
}

/// A quad of pixels over two faces has the slope of neither.
TEST(MendedStills, MapHasNoSpecksWhereTwoFacesMeet) {
    for (const auto& [scene, value] : {std::pair("R3", 6.0), {"S8", 20.0}, {"S9", 4.0}, {"N1", 0.0}, {"S7O", 10.0}}) {
        const StabilityCell cell = measured(scene, value, {named("map")})[0];
        EXPECT_EQ(cell.everywhere.wrong, 0u) << scene;
        EXPECT_TRUE(cell.inBudget()) << scene;
    }
}

/// Shadows thinner than a pixel, and shadows' edges along the edges of faces. A picture of one ray a pixel is no better; one
/// without shadows is out of its budget.
TEST(MendedStills, MapAndAutoAreAsGoodAsARayAPixelWhereShadowsAreThin) {
    const Entrant map = named("map"), automatic = named("auto");
    const std::vector<std::tuple<const char*, double, std::vector<Entrant>>> thin = {{"S4", 0.0, {map}},
                                                                                     {"S4", 90.0, {map}},
                                                                                     {"S8", 3.0, {map}},
                                                                                     {"V6", 100.0, {map, automatic}},
                                                                                     {"S13", 256.0, {automatic}}};
    for (auto [scene, value, contenders] : thin) {
        contenders.push_back({plainContender()});
        const std::vector<StabilityCell> cells = measured(scene, value, contenders);
        EXPECT_FALSE(cells.back().inBudget()) << scene;
        for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
            const StabilityJudgement& judged = cells[i].everywhere;
            EXPECT_EQ(judged.wrong, 0u) << scene << ", " << contenders[i].contender.technique;
            EXPECT_LE(judged.p95.value_or(0.0), std::max(1.0, judged.floor)) << scene;
        }
    }
}

/// The sun shines through no foot of a house from below its ground: a coarse map was taken for as exact as its edges.
TEST(MendedStills, AutoLightsNothingFromBelowTheGround) {
    for (const double elevation : {-30.0, -80.0}) {
        const StabilityCell cell = measured("L2", elevation, {named("auto")})[0];
        EXPECT_EQ(cell.everywhere.wrong, 0u) << elevation;
        EXPECT_TRUE(cell.inBudget()) << elevation;
    }
}

/// Rays began within the house where a pixel's neighbour is on another face; and under all that is seen, for OpenGL's floats
/// place it deeper.
TEST(MendedStills, TracedIsRightThroughATelescope) {
    for (const int height : {120, 360}) {
        const StabilityCell cell = measured("S7N", 0.1, {named("traced")}, height)[0];
        EXPECT_EQ(cell.everywhere.wrong, 0u) << height;
        EXPECT_TRUE(cell.inBudget()) << height;
    }
}

} // namespace
