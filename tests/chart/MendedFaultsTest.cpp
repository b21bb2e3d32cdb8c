// SPDX-License-Identifier: MIT
// Faults of techniques in motion that the stability table has found. Those of still pictures are in MendedStillsTest.
#include "StabilityScene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using namespace gnomon::examples;

using Rows = std::vector<StabilityRow>;

const Entrant withoutShadows{plainContender()};

Entrant named(const std::string& technique) { return stabilityContenders({technique}, false).front(); }

/// A scene at a value: a row each, in their order, against a truth that is made once.
Rows measured(const std::string& scene, double value, const std::vector<Entrant>& contenders) {
    StabilityPlan plan;
    plan.scenes = stabilityScenes(std::vector<std::string>{scene});
    plan.scenes[0].values = {value};
    plan.contenders = contenders;
    plan.width = 160;
    plan.height = 120;
    return runStability(plan, [](std::size_t, const std::string&) { return true; }).rows;
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
