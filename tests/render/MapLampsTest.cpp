// SPDX-License-Identifier: MIT
// Lamps among casters, below their tops and under them, against the truth image.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>

#include <iostream>

using gnomon::ShadowMapTechnique;
using gnomon::TruthImage;
using namespace test;

namespace {

/// Things of half a metre to four, a table among them, on a ground, from above.
TracedCase amongThings(const osg::Vec3d& lamp) {
    return {"among things",
            {square(8.0), house({2.0, 0.0}, {2.0, 2.0, 2.0}, 30.0), house({-2.0, 1.0}, {1.0, 1.5, 1.2}, -20.0),
             house({0.5, -2.5}, {1.2, 0.8, 0.5}, 10.0), box({-0.3, 2.2, 0.0}, {0.1, 2.6, 4.0}),
             sphere({-1.5, -2.0, 1.2}, 0.7, 32), box({3.2, -3.0, 0.7}, {5.0, -1.8, 0.8}),
             box({-5.0, -4.0, 0.0}, {-4.9, 0.0, 3.0})},
            osg::Vec4d(lamp, 1.0),
            perspective({-7.0, -11.0, 13.0}, {0.0, 0.0, 0.0}, 400, 300)};
}

struct Place {
    const char* name;
    osg::Vec3d lamp;
};

const Place places[] = {{"below their tops", {0.0, 0.0, 0.4}}, {"higher, but below the highest", {0.3, 0.2, 1.5}},
                        {"beside a wall", {-4.6, -2.0, 1.0}},  {"near the ground", {-3.2, -1.0, 0.1}},
                        {"under a table", {4.0, -2.4, 0.4}},   {"close to a house", {0.9, -1.0, 1.0}},
                        {"outside", {7.0, 6.0, 1.5}},          {"over them", {0.5, 0.5, 6.0}}};

// The goal.
constexpr double mostWrong = 0.005; // of the pixels away from edges

TEST(MapLamps, AmongCastersAndBelowTheirTopsAreWrongInNoMoreThanAHalfPercentAwayFromEdges) {
    for (const Place& place : places) {
        const TracedCase given = amongThings(place.lamp);
        Scene lit = given.build(), dark = given.build(), shadowed = given.build();
        dark.takeLightAway();
        const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
        shadowed.addShadow(technique);
        const Picture asLit = render(lit.root, given.view), asDark = render(dark.root, given.view);
        const TruthImage truth = given.truth();
        Camera camera(shadowed.root, given.view);
        for (const int size : {512, 1024, 2048}) {
            technique->setSize(size);
            const TruthComparison found = compare(camera.frame(), asLit, asDark, truth);
            std::cout << place.name << ", size " << size << ": " << found << "\n";
            EXPECT_LE(found.certain, mostWrong * (found.pixels - found.edges)) << place.name << ", size " << size;
            EXPECT_EQ(found.neither, 0) << place.name;
            EXPECT_GT(found.shadowed, 300) << place.name; // a lamp near the ground lights little of it
        }
        EXPECT_EQ(technique->diagnose(), std::vector<std::string>()) << place.name;
    }
}

/// A box 6 m from a lamp that hangs 6 m up, and a stick 0.2 m from it, on a ground so long.
TracedCase onALargeGround(double half) {
    return {"large ground",
            {square(half), box({5.0, -1.0, 0.0}, {6.0, 1.0, 2.0}), box({-0.2, -0.05, 4.0}, {-0.1, 0.05, 6.5}),
             box({-2.0, -3.0, 0.0}, {-1.0, -2.0, 5.5})},
            {0.0, 0.0, 6.0, 1.0},
            perspective({-6.0, -12.0, 5.0}, {3.0, 6.0, 2.0}, 400, 300, 50.0, 1.0, 4.0 * half)};
}

// A ground that is seen far away is in the same maps as what is near the lamp.
TEST(MapLamps, KeepTheShadowsOfWhatIsNearThemHoweverLargeTheGroundIs) {
    for (const double half : {10.0, 400.0, 1000.0, 1500.0}) {
        const TracedCase given = onALargeGround(half);
        Scene lit = given.build(), dark = given.build(), shadowed = given.build();
        dark.takeLightAway();
        const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
        shadowed.addShadow(technique);
        const TruthComparison found = compare(render(shadowed.root, given.view), render(lit.root, given.view),
                                              render(dark.root, given.view), given.truth());
        std::cout << "ground of " << 2.0 * half << " m: " << found << "\n";
        EXPECT_LE(found.certain, mostWrong * found.shadowed) << half;
        EXPECT_GT(found.shadowed, 3000) << half;
        EXPECT_EQ(technique->diagnose(), std::vector<std::string>()) << half;
    }
}

} // namespace
