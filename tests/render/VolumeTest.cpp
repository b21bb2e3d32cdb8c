// SPDX-License-Identifier: MIT
// Shadow volumes against the truth image: hard scenes, views and lights.
#include "VolumeTrial.h"

#include <gnomon/ShadowVolumeTechnique.h>
#include <gtest/gtest.h>

using test::expectFloor;
using test::labEight;
using test::room;
using test::townOfHouses;
using test::TracedCase;

namespace {

TracedCase small(TracedCase given) { return test::sized(std::move(given), 320, 240); }

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

// What a light's place by the eye is rounded to changes with each view.
TEST(Volume, OfALightAtRestIsFoundOnceWhileTheCameraMoves) {
    for (const osg::Vec4d& light : {osg::Vec4d(1.0, 0.4, 1.2, 0.0), osg::Vec4d(2.3, 1.7, 6.1, 1.0)}) {
        test::Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})}, 8.0, light);
        const osg::ref_ptr<gnomon::ShadowVolumeTechnique> technique = new gnomon::ShadowVolumeTechnique;
        scene.addShadow(technique);
        const auto from = [](int step) {
            return test::perspective({-7.0 + 0.013 * step, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 96, 72);
        };
        test::Camera camera(scene.root, from(0));
        camera.frame();
        const unsigned before = technique->passes();
        EXPECT_GT(before, 0u);
        for (int step = 1; step <= 60; ++step) {
            camera.setView(from(step));
            camera.frame();
        }
        EXPECT_LE(technique->passes(), before + 1) << "once more, where it is known that what receives stands still";
    }
}

} // namespace
