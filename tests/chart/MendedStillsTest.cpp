// SPDX-License-Identifier: MIT
// Faults of techniques in still pictures that the stability table has found.
#include "StabilityResults.h"
#include "StabilityScene.h"
#include "Yardstick.h"

#include <metrics/PixelSets.h>

#include <gtest/gtest.h>

#include <algorithm>
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
