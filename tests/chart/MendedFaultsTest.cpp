// SPDX-License-Identifier: MIT
// Faults of techniques that the stability table has found.
#include "StabilityRun.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace {

using namespace gnomon::examples;

/// Map in a scene at a value.
StabilityRow measured(const std::string& scene, double value) {
    StabilityPlan plan;
    plan.scenes = stabilityScenes(std::vector<std::string>{scene});
    plan.scenes[0].values = {value};
    plan.contenders = stabilityContenders({"map"}, false);
    plan.contenders.resize(1);
    return runStability(plan, [](std::size_t, const std::string&) { return true; }).rows.at(0);
}

/// A quad of pixels over two faces has the slope of neither.
TEST(MendedFaults, MapHasNoSpecksWhereTwoFacesMeet) {
    for (const auto& [scene, value] : {std::pair("R3", 6.0), {"S8", 20.0}, {"S9", 4.0}}) {
        const StabilityRow row = measured(scene, value);
        EXPECT_EQ(row.cells[0].everywhere.wrong, 0u) << scene;
        EXPECT_TRUE(row.cells[0].inBudget()) << scene;
    }
}

} // namespace
