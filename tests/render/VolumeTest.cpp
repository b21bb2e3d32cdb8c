// SPDX-License-Identifier: MIT
// Shadow volumes against the truth image: hard scenes, views and lights.
#include "TracedCases.h"

#include <gnomon/ShadowVolumeTechnique.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>

using test::labEight;
using test::Picture;
using test::room;
using test::Scene;
using test::townOfHouses;
using test::TracedCase;

namespace {

TracedCase small(TracedCase given, int width = 320, int height = 240) {
    given.view.width = width;
    given.view.height = height;
    return given;
}

struct Result {
    Picture lit, dark, cast;
    test::TruthComparison comparison;
    std::vector<std::string> causes;
};

Result draw(const TracedCase& given) {
    Result result;
    Scene lit = given.build(), dark = given.build(), shadowed = given.build();
    dark.takeLightAway();
    const osg::ref_ptr<gnomon::ShadowVolumeTechnique> technique = new gnomon::ShadowVolumeTechnique;
    shadowed.addShadow(technique);
    result.lit = test::render(lit.root, given.view);
    result.dark = test::render(dark.root, given.view);
    result.cast = test::render(shadowed.root, given.view);
    result.comparison = test::compare(result.cast, result.lit, result.dark, given.truth());
    result.causes = technique->diagnose();
    return result;
}

/// As good as one ray a pixel can be, but for a few pixels that the rasteriser decides.
void expectFloor(const TracedCase& given) {
    const Result result = draw(given);
    std::cout << given.name << ": " << result.comparison << "\n";
    EXPECT_LE(result.comparison.wrong, 1.10 * result.comparison.floor + 5) << given.name << ": " << result.comparison;
    EXPECT_EQ(result.comparison.certain, 0) << given.name << ": " << result.comparison;
    EXPECT_EQ(result.comparison.neither, 0) << given.name << ": " << result.comparison;
    EXPECT_GT(result.comparison.shadowed, 300) << given.name;
    EXPECT_GT(result.comparison.edges, 60) << given.name;
    EXPECT_EQ(result.causes, std::vector<std::string>()) << given.name;
}

TEST(Volume, IsAsGoodAsOneRayAPixelCanBe) {
    for (const TracedCase& given : {labEight(), townOfHouses(), room()}) expectFloor(small(given));
}

TEST(Volume, IsSoInTiltedScenesAndUnderLowSuns) {
    TracedCase low = small(townOfHouses());
    low.name = "town, low sun";
    low.light = test::sunAt(17.0, 15.0);
    for (const TracedCase& given : {small(tilted(labEight())), small(tilted(room())), low}) expectFloor(given);
}

TEST(Volume, CountsFromBehindWhereTheEyeIsInShadow) {
    TracedCase given = small(townOfHouses());
    given.name = "in a street";
    given.light = test::sunAt(-100.0, 25.0);
    given.view = test::perspective({1.0, -20.0, 1.7}, {4.0, 20.0, 1.5}, 320, 240, 60.0, 0.1, 300.0);
    expectFloor(given);
}

} // namespace
