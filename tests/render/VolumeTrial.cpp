// SPDX-License-Identifier: MIT
#include "VolumeTrial.h"

#include <gnomon/ShadowVolumeTechnique.h>
#include <gtest/gtest.h>

#include <iostream>

namespace test {

CaseTrial drawVolume(const TracedCase& given) { return drawnBy(new gnomon::ShadowVolumeTechnique, given); }

void expectFloor(const TracedCase& given, int least) {
    const CaseTrial trial = drawVolume(given);
    const TruthComparison& found = trial.comparison;
    std::cout << given.name << ": " << found << "\n";
    EXPECT_LE(found.wrong, 1.10 * found.floor + 5) << given.name << ": " << found;
    EXPECT_EQ(found.certain, 0) << given.name << ": " << found;
    EXPECT_EQ(found.neither, 0) << given.name << ": " << found;
    EXPECT_GT(found.shadowed, least) << given.name;
    EXPECT_GT(found.edges, least / 5) << given.name;
    EXPECT_EQ(trial.causes, std::vector<std::string>()) << given.name;
}

TracedCase sized(TracedCase given, int width, int height) {
    given.view.width = width;
    given.view.height = height;
    return given;
}

} // namespace test
