// SPDX-License-Identifier: MIT
// Shadow maps in framebuffer objects: depths in floats, and several samples a pixel, one of which decides.
#include "DrawnInto.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>

#include <iostream>

using gnomon::ShadowMapTechnique;
using namespace test;

namespace {

/// A map of which a texel is less than a pixel in the cases here.
TruthComparison drawn(const TracedCase& given, const Target& target) {
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(2048);
    DrawnInto shadowed(given, target, technique);
    const TruthComparison found = compareWithRays(shadowed, given, target);
    std::cout << given.name << ": " << found << "\n";
    EXPECT_EQ(found.neither, 0) << given.name;
    EXPECT_GT(found.shadowed, 2000) << given.name;
    EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
    EXPECT_EQ(shadowed.into->complaints->all(), std::vector<std::string>());
    return found;
}

TEST(MapBuffers, OfFloatDepthsAreAsRightAsOthers) {
    for (const TracedCase& given : {labEight(), townOfHouses(), room()}) {
        const TruthComparison found = drawn(given, withDepth(depth32));
        EXPECT_EQ(found.certain, 0) << given.name;
        EXPECT_LE(found.wrong - found.floor, found.edges / 8) << given.name << ", as Map has it";
    }
}

// A pixel may be wrong if an edge runs through it or, by what a map's edges are off, beside it: 17 of 92,000 in the town.
TEST(MapBuffers, OfFourSamplesAreRightAwayFromEdges) {
    for (const auto& [given, format] :
         {std::pair(labEight(), depth24), {townOfHouses(), depth24}, {room(), depth32}, {labEight(), depth32}}) {
        const TruthComparison found = drawn(given, fourSamples(format));
        EXPECT_LE(found.certain, found.pixels / 4000) << given.name;
    }
}

} // namespace
