// SPDX-License-Identifier: MIT
// Suns and lamps where planar shadows are known to fail: in the plane, under it, as high as the caster, within it.
#include "Trial.h"

#include <cmath>

using namespace test;

namespace {

const Mesh tower = box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0});

osg::Vec4d sunAt(double degrees) {
    const double elevation = osg::DegreesToRadians(degrees);
    return osg::Vec4d(osg::Vec4(static_cast<float>(std::cos(elevation)), 0.0f, // as osg::Light holds it
                                static_cast<float>(std::sin(elevation)), 0.0f));
}

Trial lit(const osg::Vec4d& light, const Mesh& caster = tower) {
    Trial trial;
    trial.casters = {caster};
    trial.light = light;
    return trial;
}

/// From the side, the eye 3 above the ground: sees both the shadow and what an inverted one would reach.
View fromTheSide() { return perspective({-6.0, -7.0, 3.0}, {0.0, 0.0, 0.5}, 160, 120); }

GNOMON_BY_TECHNIQUE(Sun);
GNOMON_BY_TECHNIQUE(Lamp);
GNOMON_BY_TECHNIQUE(HomogeneousLight);

} // namespace

TEST_P(Sun, InThePlaneOrUnderItCastsNothing) {
    for (const double degrees : {0.0, -1e-6, -1e-3, -0.01, -5.0, -90.0}) {
        SCOPED_TRACE(degrees);
        EXPECT_TRUE(isUnshadowed(lit(sunAt(degrees))));
    }
}

TEST(PlanarSun, LowerThanSixThousandthsOfADegreeCountsAsInThePlane) { // see planarShadowMatrix()
    for (const double degrees : {1e-6, 1e-3}) {
        SCOPED_TRACE(degrees);
        EXPECT_TRUE(isUnshadowed(lit(sunAt(degrees))));
    }
}

TEST_P(Sun, GrazingThePlaneCastsWhatRaysSay) {
    for (const double degrees : {0.01, 0.5, 2.0}) {
        SCOPED_TRACE(degrees);
        Trial trial = lit(sunAt(degrees));
        if (degrees < 0.1) trial.mapEdge = 5; // 4 steps of depth, 99/2²⁴ each, are 2.2 pixels along the ground
        EXPECT_EQ(truthOf(trial).shadowPixels(), 56 * 16); // 3.5 long and 1 wide, at 16 pixels a unit
        EXPECT_TRUE(isRight(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Sun, OverheadCastsTheFootprintWhateverTheRestOfItsDirection) {
    for (const double sideways : {0.0, 1e-12, 1e-6}) {
        SCOPED_TRACE(sideways);
        Trial trial = lit({sideways, 0.0, 1.0, 0.0}, box({-0.5, -0.5, 1.0}, {0.5, 0.5, 2.0}));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Lamp, OverAtAndUnderACastersTopCastsWhatRaysSay) {
    for (const double height : {2.0, 1.001, 1.0, 0.999, 0.5}) {
        SCOPED_TRACE(height);
        Trial trial = lit({2.0, 0.25, height, 1.0});
        EXPECT_GT(truthOf(trial).shadowPixels(), 1000); // at least the cone behind the tower, to the ground's edge
        EXPECT_TRUE(isRight(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Lamp, StraightOverOrInTheTopOfACasterCastsWhatRaysSay) {
    for (const double height : {2.0, 1.001, 1.0}) {
        SCOPED_TRACE(height);
        Trial trial = lit({0.0, 0.0, height, 1.0});
        EXPECT_TRUE(isRight(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Lamp, UnderAFloatingCasterCastsNoInvertedShadow) {
    const Mesh floating = box({-0.5, -0.5, 2.0}, {0.5, 0.5, 3.0});
    for (const double height : {2.0, 1.999, 1.0, 1e-3}) {
        SCOPED_TRACE(height);
        Trial trial = lit({1.5, 0.0, height, 1.0}, floating);
        EXPECT_TRUE(isUnshadowed(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isUnshadowed(trial));
    }
}

TEST_P(Lamp, InThePlaneOrUnderItCastsNothing) {
    for (const double height : {0.0, -1e-9, -0.5, -10.0}) {
        SCOPED_TRACE(height);
        EXPECT_TRUE(isUnshadowed(lit({2.0, 0.0, height, 1.0})));
    }
}

TEST_P(Lamp, InsideASolidBoxDarkensAllTheGroundAround) {
    const Trial trial = lit({0.125, 0.0, 0.5, 1.0});
    const Truth truth = truthOf(trial);
    EXPECT_EQ(truth.mask.count(Seen::LitReceiver), 0);
    EXPECT_EQ(truth.shadowPixels(), 128 * 128 - 16 * 16); // all but the tower
    EXPECT_TRUE(isRight(trial));
}

TEST_P(Lamp, InsideAnOpenRoomShinesThroughItsDoor) {
    Trial room;
    room.casters = {box({-2.0, -2.0, 0.0}, {-1.75, 2.0, 1.5}), box({1.75, -2.0, 0.0}, {2.0, 2.0, 1.5}),
                    box({-1.75, 1.75, 0.0}, {1.75, 2.0, 1.5}), box({-1.75, -2.0, 0.0}, {-0.5, -1.75, 1.5}),
                    box({0.5, -2.0, 0.0}, {1.75, -1.75, 1.5})};
    for (const double height : {0.75, 1.5, 3.0}) {
        SCOPED_TRACE(height);
        room.light = {0.25, 0.0, height, 1.0};
        const Truth truth = truthOf(room);
        EXPECT_GT(truth.mask.count(Seen::LitReceiver), 3500); // the floor inside alone: 3.5 of 8, squared
        EXPECT_GT(truth.shadowPixels(), 1000);
        EXPECT_TRUE(isRight(room));
    }
}

TEST_P(HomogeneousLight, RecedingToASunCastsAsTheSunDoes) {
    for (const double w : {0.0, 1e-12, 1e-9, 1e-6}) { // at 10⁻⁶ a shadow is off by 10⁻⁶ of its length
        SCOPED_TRACE(w);
        const Trial trial = lit(osg::Vec4d(osg::Vec4(1.0f, 0.5f, 1.0f, static_cast<float>(w))));
        Scene scene = trial.buildWithShadow();
        EXPECT_TRUE(isRight(scene, trial.view, truthOf(trial, {1.0, 0.5, 1.0, 0.0})));
    }
}

TEST_P(HomogeneousLight, IsThePointDividedByItsWeight) {
    for (const double w : {1e-3, 1.0, 2.0}) {
        SCOPED_TRACE(w);
        const Trial trial = lit(osg::Vec4d(osg::Vec4(3.0f, 1.0f, 4.0f, static_cast<float>(w))));
        EXPECT_GT(truthOf(trial).shadowPixels(), 200);
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(HomogeneousLight, OfNegativeWeightIsTheSamePoint) {
    const Trial plain = lit({3.0, 1.0, 4.0, 1.0});
    for (const double factor : {-1.0, -1e-3, -2.0}) {
        SCOPED_TRACE(factor);
        Scene scene = plain.buildWithShadow();
        scene.group->addLight({0, plain.light * factor});
        EXPECT_TRUE(isRight(scene, plain.view, truthOf(plain)));
    }
}

TEST(PlanarLight, OfNegativeWeightMayBeUnderThePlane) {
    const Trial plain = lit({3.0, 1.0, 4.0, 1.0});
    Scene under = plain.buildWithShadow(); // (3, 1, 4) / -1
    under.group->addLight({0, osg::Vec4d(3.0, 1.0, 4.0, -1.0)});
    EXPECT_TRUE(isUnshadowed(under, plain.view, render(plain.build().root, plain.view)));
}
