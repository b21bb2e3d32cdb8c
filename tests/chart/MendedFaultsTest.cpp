// SPDX-License-Identifier: MIT
// Faults of techniques that the stability table has found.
#include "StabilityScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace gnomon::examples;

using Rows = std::vector<StabilityRow>;

const Entrant withoutShadows{plainContender()};

Entrant named(const std::string& technique) { return stabilityContenders({technique}, false).front(); }

/// A scene at a value: a row each, in their order, against a truth that is made once.
Rows measured(const std::string& scene, double value, const std::vector<Entrant>& contenders, int height = 120) {
    StabilityPlan plan;
    plan.scenes = stabilityScenes(std::vector<std::string>{scene});
    plan.scenes[0].values = {value};
    plan.contenders = contenders;
    plan.width = 4 * height / 3;
    plan.height = height;
    return runStability(plan, [](std::size_t, const std::string&) { return true; }).rows;
}

/// A quad of pixels over two faces has the slope of neither.
TEST(MendedFaults, MapHasNoSpecksWhereTwoFacesMeet) {
    for (const auto& [scene, value] : {std::pair("R3", 6.0), {"S8", 20.0}, {"S9", 4.0}, {"N1", 0.0}, {"S7O", 10.0}}) {
        const StabilityCell cell = measured(scene, value, {named("map")})[0].cells[0];
        EXPECT_EQ(cell.everywhere.wrong, 0u) << scene;
        EXPECT_TRUE(cell.inBudget()) << scene;
    }
}

/// Shadows thinner than a pixel, and shadows' edges along the edges of faces. A picture of one ray a pixel is no better; one
/// without shadows is out of its budget.
TEST(MendedFaults, MapAndAutoAreAsGoodAsARayAPixelWhereShadowsAreThin) {
    const Entrant map = named("map"), automatic = named("auto");
    const std::vector<std::tuple<const char*, double, std::vector<Entrant>>> thin = {{"S4", 0.0, {map}},
                                                                                     {"S4", 90.0, {map}},
                                                                                     {"S8", 3.0, {map}},
                                                                                     {"V6", 100.0, {map, automatic}},
                                                                                     {"S13", 256.0, {automatic}}};
    for (auto [scene, value, contenders] : thin) {
        contenders.push_back(withoutShadows);
        Rows rows = measured(scene, value, contenders);
        EXPECT_FALSE(rows.back().cells[0].inBudget()) << scene;
        rows.pop_back();
        for (const StabilityRow& row : rows) {
            const auto& judged = row.cells[0].everywhere;
            EXPECT_EQ(judged.wrong, 0u) << scene << ", " << row.technique;
            EXPECT_LE(judged.p95.value_or(0.0), std::max(1.0, judged.floor)) << scene << ", " << row.technique;
        }
    }
}

/// Rays began within the house where a pixel's neighbour is on another face; and under all that is seen, for OpenGL's floats
/// place it deeper.
TEST(MendedFaults, TracedIsRightThroughATelescope) {
    for (const int height : {120, 360}) {
        const StabilityCell cell = measured("S7N", 0.1, {named("traced")}, height)[0].cells[0];
        EXPECT_EQ(cell.everywhere.wrong, 0u) << height;
        EXPECT_TRUE(cell.inBudget()) << height;
    }
}

/// L12: walls that map hatched and rimmed, and that took ground behind a wall's rim for the round of a smooth body; and, at 0,
/// walls in which sides of another house's volume lie.
TEST(MendedFaults, NoTechniqueLeavesWallsBrightOrStripedThatAreTurnedAway) {
    for (const double degrees : {8.0, 1.0, 0.5, 0.0}) {
        const Rows rows =
            measured("L12", degrees, {named("map"), named("volume"), named("traced"), named("auto"), withoutShadows});
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
            const StabilityRow& row = rows[i];
            EXPECT_EQ(row.cells[0].everywhere.turnedAwayWrong, 0u) << row.technique << " " << degrees;
            // One pixel in two of the film's frames, with its neighbours: for map a wall of some pixels has no certain lie at 0.
            const std::size_t most = row.technique == "map" && degrees == 0.0 ? 8 : 0;
            EXPECT_LE(row.flicker.turnedAwayWrong, most) << row.technique << " " << degrees;
            EXPECT_TRUE(row.cells[0].inBudget()) << row.technique << " " << degrees;
        }
        if (degrees == 8.0) EXPECT_GT(rows.back().cells[0].everywhere.turnedAwayWrong, 500u); // or this shows nothing
    }
}

} // namespace
