// SPDX-License-Identifier: MIT
// Cascades: how far edges are off in a long view, seams, what is drawn again.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

using gnomon::ShadowMapTechnique;
using test::longStreet;
using test::Picture;
using test::Scene;
using test::TracedCase;

namespace {

osg::ref_ptr<ShadowMapTechnique> cascadesOf(int cascades, int size) {
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(size);
    technique->setCascades(cascades);
    return technique;
}

Picture pictureOf(const TracedCase& given, ShadowMapTechnique* technique) {
    Scene scene = given.build();
    if (technique) scene.addShadow(technique);
    return test::render(scene.root, given.view);
}

// The goal: 1 pixel. A perfect ray through each pixel's centre comes to 0.4.
TEST(MapCascades, ThreeKeepTheEdgesOfALongStreetWithinAPixelWhereverTheSunStands) {
    for (const double azimuth : {0.0, 45.0, 90.0, 135.0, 180.0}) {
        const test::Judge judge(longStreet(azimuth));
        const auto off = [&](int cascades, int size) { return judge.edgesOff(judge.with(cascadesOf(cascades, size))); };
        const double one = off(1, 2048), two = off(2, 2048), three = off(3, 2048), small = off(3, 1024),
                     unasked = off(0, 1024);
        std::cout << "sun at " << azimuth << "°: " << one << " px with 1, " << two << " with 2, " << three
                  << " with 3; with 3 of half the size " << small << ", as many as it takes " << unasked << "\n";
        EXPECT_LE(three, 1.0) << azimuth;
        EXPECT_GE(one, 2.0 * two) << azimuth;
        EXPECT_LE(unasked, 1.0) << azimuth << ": as many of half the size as it takes";
        EXPECT_LE(small, one / 2.0) << azimuth << ": three of them have fewer texels than the one";
    }
}

/// What one sees of a ground from where one stands on it, under a roof or the sky.
TracedCase plain(bool roofed) {
    std::vector<test::Mesh> meshes{test::square(1000.0)};
    if (roofed) meshes.push_back(test::quad({-3000.0, -3000.0, 40.0}, {6000.0, 0.0, 0.0}, {0.0, 6000.0, 0.0}));
    meshes.push_back(test::sphere({30.0, 0.0, 300.0}, 1.0, 16)); // something that is not flat
    return {"plain",
            meshes,
            {0.3, 0.2, 1.0, 0.0},
            test::perspective({-900.0, 0.0, 2.0}, {0.0, 0.0, 2.0}, 320, 240, 40.0, 0.5, 4000.0)};
}

// All of the ground is in the roof's shadow, and none of it without the roof: a seam would show in either.
TEST(MapCascades, HaveNoSeamsInShadowAndNoneInLight) {
    const TracedCase open = plain(false), roofed = plain(true);
    const Picture lit = pictureOf(open, nullptr);
    Scene without = roofed.build();
    without.takeLightAway();
    const Picture dark = test::render(without.root, roofed.view);
    for (const auto edges : {ShadowMapTechnique::HARD, ShadowMapTechnique::SOFT}) {
        const auto inLight = cascadesOf(4, 512), inShadow = cascadesOf(4, 512);
        inLight->setEdges(edges);
        inShadow->setEdges(edges);
        EXPECT_LE(pictureOf(open, inLight).different(lit), 0) << edges;
        const Picture shadowed = pictureOf(roofed, inShadow);
        EXPECT_EQ(inShadow->passes(), 4u);
        int ground = 0, wrong = 0;
        for (int y = 0; y < 110; ++y) // below the horizon
            for (int x = 0; x < 320; ++x) {
                ground += dark.at(x, y) == test::grey(test::shadowedGround);
                wrong += shadowed.at(x, y) != dark.at(x, y);
            }
        EXPECT_EQ(wrong, 0) << edges;
        EXPECT_EQ(ground, 110 * 320);
    }
}

TEST(MapCascades, AreOneMapWhereAllIsAboutAsFar) {
    TracedCase across = longStreet(45.0);
    across.view.projection = osg::Matrixd::ortho(-40.0, 40.0, -30.0, 30.0, 0.2, 3000.0);
    for (const TracedCase& given : {across, test::labEight(), test::room()}) {
        const auto one = cascadesOf(1, 512), four = cascadesOf(4, 512);
        EXPECT_EQ(pictureOf(given, four).different(pictureOf(given, one)), 0) << given.name;
        EXPECT_EQ(four->passes(), one->passes()) << given.name;
    }
}

// The sun stands behind the eye: houses near by and a wall far away lie in one part of the light's view, and what stands
// before the wall is deeper than what the map of the near part holds.
TEST(MapCascades, ThatAreFineDoNotAnswerForWhatIsBeyondThem) {
    const TracedCase given{
        "behind",
        {test::quad({-50.0, -60.0, 0.0}, {460.0, 0.0, 0.0}, {0.0, 120.0, 0.0}),
         test::box({20.0, -12.0, 0.0}, {24.0, -4.0, 10.0}), test::box({20.0, 4.0, 0.0}, {24.0, 12.0, 10.0}),
         test::box({380.0, -3.0, 0.0}, {384.0, 3.0, 6.0}), test::box({400.0, -50.0, 0.0}, {401.0, 50.0, 40.0})},
        {-1.0, 0.05, 0.01, 0.0},
        test::perspective({-10.0, 0.0, 2.0}, {100.0, 0.0, 2.0}, 640, 480, 20.0, 0.2, 1000.0)};
    const auto technique = cascadesOf(2, 1024);
    const test::TruthComparison result = test::CaseTrial(technique, given).comparison;
    EXPECT_EQ(technique->passes(), 2u);
    EXPECT_EQ(result.certain, 0) << result;
    EXPECT_GT(result.shadowed, 100) << result;
}

struct Street : test::MovingCase {
    Street() : MovingCase(longStreet(45.0), test::box({300.0, -3.0, 0.0}, {304.0, 0.0, 2.0}), cascadesOf(3, 512)) {}
};

TEST(MapCascades, AreAllDrawnAgainWhenACasterMovesAndNoneWhileAllIsStill) {
    Street street;
    EXPECT_EQ(street.passesInFrame(), 3u);
    EXPECT_EQ(street.passesInFrame(), 0u);
    street.mover->setMatrix(osg::Matrixd::translate(2.0, 0.0, 0.0));
    EXPECT_EQ(street.passesInFrame(), 3u);
    EXPECT_EQ(street.passesInFrame(), 3u) << "once more, as if there had been no frames before";
    EXPECT_EQ(street.passesInFrame(), 0u);
    street.technique->setCascades(2);
    EXPECT_EQ(street.passesInFrame(), 2u);
}

TEST(MapCascades, AreNotDrawnWhileTheCameraTurnsALittle) {
    Street street;
    street.passesInFrame();
    for (int step = 1; step <= 4; ++step) {
        street.look(osg::Matrixd::rotate(osg::DegreesToRadians(0.25 * step), 0.0, 1.0, 0.0));
        EXPECT_EQ(street.passesInFrame(), 0u) << step;
    }
}

// One who walks 100 steps of half a metre leaves what the nearest map holds soonest; the others stay as they are.
TEST(MapCascades, AreDrawnAgainOneByOne) {
    Street street;
    street.passesInFrame();
    unsigned most = 0, all = 0;
    for (int step = 1; step <= 100; ++step) {
        street.look(osg::Matrixd::translate(0.0, 0.0, 0.5 * step));
        const unsigned passes = street.passesInFrame();
        all += passes;
        most += passes == 3;
    }
    std::cout << all << " maps in 100 frames, all three in " << most << "\n";
    EXPECT_LE(all, 40u);
    EXPECT_LE(most, 3u);
    EXPECT_GE(all, 2u);
}

TEST(MapCascades, ThatAreDrawnAgainOneByOneAreAsGoodAsNew) {
    Street street;
    for (int step = 0; step <= 40; ++step) {
        street.look(osg::Matrixd::translate(0.0, 0.0, 0.5 * step));
        street.camera.frame();
    }
    Street fresh;
    fresh.look(osg::Matrixd::translate(0.0, 0.0, 20.0));
    const Picture walked = street.camera.frame(), arrived = fresh.camera.frame();
    // Maps of other fits have their edges elsewhere by less than a texel, which is less than a pixel but for the farthest.
    EXPECT_LE(walked.different(arrived), 640 * 480 / 200);
}

// What is seen from the ground up is divided at a few metres; from 60 m above it, that would leave one map to all.
TEST(MapCascades, AreDividedAnewForACameraThatHasGoneElsewhere) {
    const osg::Matrixd above =
        test::perspective({-60.0, 0.0, 60.0}, {300.0, 0.0, 0.0}, 640, 480, 40.0, 0.2, 3000.0).view;
    Street street, fresh;
    street.passesInFrame();
    street.given.view.view = fresh.given.view.view = above;
    street.look({});
    fresh.look({});
    EXPECT_GE(street.passesInFrame(), 2u);
    EXPECT_LE(street.camera.frame().different(fresh.camera.frame()), 640 * 480 / 1000);
}

/// 300 walls and blocks at 12 to 1200 m, seen from among them, as near and far as depths of 24 bits allow.
TracedCase wallsNearAndFar() {
    std::mt19937 random(5);
    const auto between = [&random](double low, double high) {
        return low + (high - low) * double(random()) / 4294967296.0;
    };
    std::vector<test::Mesh> meshes{test::square(1500.0)};
    for (int i = 0; i < 300; ++i) {
        const double far = 12.0 * std::pow(100.0, between(0.0, 1.0)), turn = between(-0.6, 0.6);
        const glm::dvec3 low(far * std::sin(turn), far * std::cos(turn), 0.0);
        const double wide = between(0.2, 8.0), deep = between(0.2, 8.0), high = between(2.0, 9.0);
        meshes.push_back(test::box(low, low + glm::dvec3(wide, deep, high)));
    }
    return {"walls",
            meshes,
            {0.0, 0.0, 1.0, 0.0},
            test::perspective({0.0, 0.0, 6.0}, {0.0, 40.0, 0.0}, 400, 300, 50.0, 0.1, 1e5)};
}

// A map's bias is up to ten texels where the light grazes a wall: beside what stands before it that much would be lit.
TEST(MapCascades, KeepWallsDarkBesideWhatBlocksTheirLight) {
    int pixels = 0, one = 0, unasked = 0;
    for (const double azimuth : {-6.0, -15.0, 186.0, 195.0, 250.0}) {
        TracedCase given = wallsNearAndFar();
        given.light = test::sunAt(azimuth, 30.0);
        const test::Judge judge(given);
        const auto wrong = [&judge](int cascades) { return judge.compare(judge.with(cascadesOf(cascades, 1024))); };
        const test::TruthComparison found = wrong(0);
        std::cout << azimuth << ": " << found << "\n";
        pixels += found.pixels;
        unasked += found.certain;
        one += wrong(1).certain;
    }
    std::cout << "wrong away from edges: " << unasked << " of " << pixels << ", " << one << " with one map\n";
    EXPECT_LE(unasked, pixels / 1500);
    EXPECT_GT(one, 5 * unasked);
}

} // namespace
