// SPDX-License-Identifier: MIT
// What an automatic choice once got wrong without a word: thin things, small things on vast grounds, sides that are turned away.
#include "AutoTrial.h"

#include <gnomon/TracedShadowTechnique.h>
#include <support/Oracle.h>

#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <set>

using namespace test;
using gnomon::AutoShadowTechnique;

namespace {

/// Upright laths in a row, and two rails.
struct Fence {
    std::vector<Mesh> laths;
    double half = 10.0;
    osg::Vec4d sun;
    View view;

    Fence(double lath, double gap, double height, double turn) {
        const double length = 8.0;
        for (double x = -length / 2.0; x < length / 2.0; x += lath + gap)
            laths.push_back(box({x, -lath / 2.0, 0.0}, {x + lath, lath / 2.0, height}));
        for (const double z : {0.25 * height, 0.8 * height})
            laths.push_back(box({-length / 2.0, lath / 2.0, z}, {length / 2.0, 1.5 * lath, z + lath}));
        for (Mesh& mesh : laths)
            for (auto& corner : mesh)
                corner = {corner.x * std::cos(turn) - corner.y * std::sin(turn),
                          corner.x * std::sin(turn) + corner.y * std::cos(turn), corner.z};
    }
};

Fence randomFence(unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 32>(random);
    };
    const double lath = between(0.02, 0.1);
    Fence fence(lath, lath * between(1.0, 4.0), between(0.8, 2.0), between(0.0, 3.0));
    const double azimuth = between(0.0, 6.28), up = between(0.4, 1.2), far = between(9.0, 20.0);
    fence.sun = {std::cos(azimuth), std::sin(azimuth), std::tan(up), 0.0};
    const double from = between(0.0, 6.28), raised = between(0.5, 1.1);
    fence.view = perspective(
        {far * std::cos(from) * std::cos(raised), far * std::sin(from) * std::cos(raised), far * std::sin(raised)},
        {0.0, 0.0, 0.4}, 320, 240);
    return fence;
}

/// What a cube shows where the light does not reach it, and a ground under a slanted sun.
Mesh smallBox(double side) { return box({-side / 2.0, -side / 2.0, 0.0}, {side / 2.0, side / 2.0, side}); }

int darker(const Picture& picture, const Picture& lit) {
    int count = 0;
    for (std::size_t i = 0; i < lit.pixels.size(); ++i)
        count += int(picture.pixels[i] & 0xffu) < int(lit.pixels[i] & 0xffu) - 2;
    return count;
}

} // namespace

// A map that is fine enough for the edges of what is left may have lost the laths themselves.
TEST(AutoThin, FencesThrowTheLinesThatRaysFind) {
    int worse = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const Fence fence = randomFence(seed);
        const std::vector<Mesh> casters = seed % 2 ? fence.laths : std::vector<Mesh>{joined(fence.laths)};
        const GroundTruth truth(casters, fence.half, fence.sun, fence.view);
        AutoTrial trial(casters, {}, fence.half, fence.sun);
        const TruthComparison found = compare(render(trial.scene.root, fence.view), truth.lit, truth.dark, truth.truth);
        std::cout << "fence " << seed << ": " << trial.decision().text() << "; wrong " << found.wrong << " of "
                  << found.pixels << ", one ray a pixel " << found.floor << "\n";
        // Edges of a map may be off by the pixel that is asked for, twice as far as those of one ray.
        EXPECT_LE(found.wrong, 2 * found.floor + 20) << trial.chosen();
        worse += found.wrong > 1.3 * found.floor + 20;
        ASSERT_NE(trial.chosen(), "") << "there is a decision";
        EXPECT_TRUE(trial.decision().keepsBudget) << trial.decision().text();
    }
    EXPECT_LE(worse, 4);
}

// The laths of a pergola seen from afar are narrower than a pixel: no candidate keeps an error of a fifth of one, and those that
// take one place a pixel lose least.
TEST(AutoThin, WhatIsExactToASampleIsNeverLessAccurateThanAMapThatLosesMore) {
    std::vector<Mesh> laths;
    for (int i = -20; i < 20; ++i) {
        laths.push_back(box({i * 0.25, -5.0, 4.0}, {i * 0.25 + 0.02, 5.0, 4.02}));
        laths.push_back(box({-5.0, i * 0.25, 4.0}, {5.0, i * 0.25 + 0.02, 4.02}));
    }
    AutoTrial trial({joined(laths)}, {}, 20.0, {-0.12, 0.24, 0.96, 0.0});
    render(trial.scene.root, perspective({-7.2, -15.6, 14.4}, {0.0, 0.0, 0.5}, 640, 480));
    double volume = 0.0;
    for (const gnomon::ShadowCandidate& each : trial.decision().candidates)
        if (each.spec == "volume") volume = each.error;
    EXPECT_GT(volume, 0.0);
    EXPECT_LE(volume, 1.0);
    for (const gnomon::ShadowCandidate& each : trial.decision().candidates)
        if (each.spec.rfind("map:size=512", 0) == 0 && each.spec.find("edges=smooth") == std::string::npos)
            EXPECT_GT(each.error, volume) << each.spec;
    EXPECT_TRUE(trial.decision().keepsBudget) << trial.decision().text();
}

/// A shallow bowl on the ground, all its triangles turned down and out.
Mesh bowl(double radius, double curvature) {
    constexpr int rings = 24, around = 96;
    const auto at = [&](int ring, int step) {
        const double r = radius * ring / rings, turn = 2.0 * osg::PI * step / around;
        return glm::dvec3(r * std::cos(turn), r * std::sin(turn), r * r / (2.0 * curvature));
    };
    Mesh result;
    for (int ring = 0; ring < rings; ++ring)
        for (int step = 0; step < around; ++step) {
            const glm::dvec3 a = at(ring, step), b = at(ring, step + 1), c = at(ring + 1, step),
                             d = at(ring + 1, step + 1);
            result.insert(result.end(), {a, b, d, a, d, c});
        }
    return result;
}

// One looks through it from above, for its back is culled, at ground that it nearly touches: a map lets light through there.
TEST(AutoThin, BowlsOnTheirGroundLetNoLightThrough) {
    const Mesh shell = bowl(2.0, 4.0);
    const osg::Vec4d sun(0.5, -0.6, 0.7, 0.0);
    const View view = perspective({-4.0, -7.0, 6.0}, {0.0, 0.0, 0.0}, 320, 240);
    const auto built = [&] {
        Scene scene = test::scene(sun);
        scene.content->addChild(node(square(8.0), "ground"));
        scene.content->addChild(node(shell));
        scene.content->getChild(1)->getOrCreateStateSet()->setMode(GL_CULL_FACE, osg::StateAttribute::ON);
        return scene;
    };
    Scene scene = built(), mapped = built(), dark = built();
    const osg::ref_ptr<AutoShadowTechnique> technique = new AutoShadowTechnique;
    scene.addShadow(technique);
    mapped.addShadow("map:size=512,filter=nearest,cascades=1");
    dark.takeLightAway();
    const Picture lit = render(built().root, view), unlit = render(dark.root, view);
    const Mask mask = castRays(square(8.0), {}, sun, view, {shell});
    const std::uint32_t ground = lit.at(1, 1); // not the outer side of the bowl
    const auto leaked = [&](const Picture& drawn) {
        int count = 0;
        for (int y = 0; y < mask.height; ++y)
            for (int x = 0; x < mask.width; ++x)
                if (mask.at(x, y) == Seen::ShadowedReceiver && !mask.atEdge(x, y, 2) && lit.at(x, y) == ground)
                    count += drawn.at(x, y) != unlit.at(x, y);
        return count;
    };
    EXPECT_LE(leaked(render(scene.root, view)), 8) << "within a pixel of where they touch";
    EXPECT_GT(leaked(render(mapped.root, view)), 200);
    const std::vector<gnomon::ShadowDecision> decisions = technique->lastDecision();
    for (const gnomon::ShadowCandidate& each : decisions.at(0).candidates)
        if (each.spec == "map:size=512,filter=nearest,cascades=1") EXPECT_GT(each.error, 10.0) << "across the hole";
}

// A box of 4 cm seen from 25, as a car on a terrain of 50 km. Its shadow by hand is 1,494 pixels of 320 × 240.
TEST(AutoVast, SmallThingsOnVastGroundsHaveTheirShadow) {
    View view = perspective({-0.12, -0.2, 0.16}, {0.0, 0.0, 0.0}, 320, 240, 40.0, 0.005, 5.0);
    for (const double half : {10.0, 100.0, 1e3, 1e4, 3e4, 1e5}) {
        Scene bare = groundScene({smallBox(0.04)}, half);
        AutoTrial trial({smallBox(0.04)}, {}, half, {1.0, 0.0, 1.0, 0.0});
        const int shadow = darker(render(trial.scene.root, view), render(bare.root, view));
        EXPECT_NEAR(shadow, 1494, 15) << half << " m: " << trial.decision().text();
        EXPECT_EQ(trial.technique->diagnose(), std::vector<std::string>());
    }
}

// The same thing with a plate beside it that lies a centimetre above the ground.
TEST(AutoVast, PlatesCloseAboveVastGroundsHaveTheirShadow) {
    const Mesh plate = quad({0.06, -0.05, 0.01}, {0.1, 0.0, 0.0}, {0.0, 0.1, 0.0});
    View view = perspective({-0.12, -0.2, 0.16}, {0.0, 0.0, 0.0}, 320, 240, 40.0, 0.005, 5.0);
    const osg::Vec4d sun(-1.0, 0.0, 0.4, 0.0);
    int expected = 0;
    for (const double half : {1.0, 1e5}) {
        Scene bare = groundScene({smallBox(0.04), plate}, half, sun);
        AutoTrial trial({smallBox(0.04), plate}, {}, half, sun);
        const int shadow = darker(render(trial.scene.root, view), render(bare.root, view));
        std::cout << half << ": " << trial.decision().text() << "; " << shadow << " pixels\n";
        if (!expected) expected = shadow;
        EXPECT_NEAR(shadow, expected, 0.1 * expected) << trial.decision().text();
    }
    EXPECT_GT(expected, 1000);
}

// A tower 940 m away under a near plane that comes closer, until OpenGL itself no longer tells the tower from the ground.
TEST(AutoVast, RaysAreCastWhereDepthsAreCoarse) {
    const std::vector<Mesh> casters = {box({-20.0, 780.0, 0.0}, {20.0, 820.0, 60.0})};
    const osg::Vec4d sun(-0.5, 0.866, 1.0, 0.0);
    for (const double near : {10.0, 1.0, 0.1, 0.01, 0.001}) {
        const View view = perspective({-480.0, 300.0, 420.0}, {-20.0, 800.0, 10.0}, 320, 240, 30.0, near, 1000.0);
        AutoTrial trial(casters, {}, 1200.0, sun);
        Scene rays = groundScene(casters, 1200.0, sun);
        rays.addShadow(new gnomon::TracedShadowTechnique);
        const Picture picture = render(trial.scene.root, view), right = render(rays.root, view);
        // Its edge is 97 pixels long. Rays start at rounded depths, volumes are snapped to parts of a pixel: one in 16 may differ.
        EXPECT_LE(picture.different(right), 6) << near << " m: " << trial.decision().text();
        EXPECT_EQ(trial.technique->diagnose(), std::vector<std::string>()) << near;
    }
}

TEST(AutoLights, ALightThatTakesLightAwayCasts) {
    const Mesh tall = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});
    const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 320, 240);
    const auto drawn = [&](bool shadow) {
        AutoTrial trial({tall}, {}, 8.0, {1.0, 0.0, 1.0, 0.0});
        trial.scene.light->getLight()->setAmbient({0.8f, 0.8f, 0.8f, 1.0f});
        trial.scene.light->getLight()->setDiffuse({-0.5f, -0.5f, -0.5f, 1.0f});
        trial.technique->setNodeMask(shadow ? ~0u : 0u);
        return render(trial.scene.root, view);
    };
    EXPECT_GT(drawn(true).different(drawn(false)), 1000);
}

// Another box comes, is in the first one's shadow, and goes: under BLEND the first one's unlit side must not change.
TEST(AutoLights, UnlitSidesDoNotJumpWhereAnotherObjectComesIntoTheShadow) {
    for (const bool blend : {true, false}) {
        const Mesh tall = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});
        AutoTrial trial({tall}, {}, 8.0, {1.0, 0.0, 1.0, 0.0});
        if (blend) trial.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        const osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
        mover->addChild(node(box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}), "other"));
        trial.scene.content->addChild(mover);
        Camera camera(trial.scene.root, perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 320, 240));
        std::set<std::uint32_t> shades;
        for (int i = 0; i < 40; ++i) {
            mover->setMatrix(osg::Matrixd::translate(3.0 - 0.1 * i, 2.1 - 0.04 * i, 0.0));
            shades.insert(camera.frame().at(140, 125));
        }
        EXPECT_EQ(shades.size(), 1u) << (blend ? "blend" : "relight");
    }
}

// All that is in shadow is the wall, which nobody sees.
TEST(AutoLights, AWallInTheGroundLeavesTheGroundLit) {
    const Mesh wall = quad({5.2, 0.96, -0.6}, {1.5, 0.0, 0.0}, {0.0, 0.0, 0.59});
    const View view = perspective({-4.7, -15.9, 6.1}, {-1.2, 1.6, 0.5}, 160, 120);
    const osg::Vec4d lamp(2.8, -3.0, 12.4, 1.0);
    AutoTrial trial({wall}, {}, 14.0, lamp);
    EXPECT_EQ(render(trial.scene.root, view).different(render(groundScene({wall}, 14.0, lamp).root, view)), 0)
        << trial.chosen();
}
