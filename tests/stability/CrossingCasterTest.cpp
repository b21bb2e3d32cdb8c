// SPDX-License-Identifier: MIT
// Casters that cross the ground, stand in it or lie on it.
#include "Trial.h"

using namespace test;

namespace {

Trial casting(const Mesh& caster, const osg::Vec4d& light = {1.0, 0.0, 1.0, 0.0}) {
    Trial trial;
    trial.casters = {caster};
    trial.light = light;
    trial.view = fromAbove(4.0, 96);
    return trial;
}

View nearTheGround() { return perspective({-5.0, -6.0, 2.0}, {0.0, 0.0, 0.0}, 128, 96); }

GNOMON_BY_TECHNIQUE(SunkenSphere);
GNOMON_BY_TECHNIQUE(CutSphere);
GNOMON_BY_TECHNIQUE(Pole);
GNOMON_BY_TECHNIQUE(Rug);

} // namespace

TEST_P(CutSphere, CastsOnlyWhatIsAboveTheGround) {
    for (const double height : {-0.75, -0.5, 0.0, 0.5, 1.0})
        for (const osg::Vec4d& light : {osg::Vec4d(2.0, 0.0, 1.0, 0.0), osg::Vec4d(4.0, 1.0, 2.0, 1.0)}) {
            SCOPED_TRACE(testing::Message() << "centre at " << height << ", w " << light.w());
            Trial trial = casting(sphere({0.0, 0.0, height}, 1.0, 24), light);
            trial.view = fromAbove(2.5, 96);
            EXPECT_GT(truthOf(trial).shadowPixels(), 15);
            EXPECT_TRUE(isRight(trial));
            trial.view = nearTheGround();
            EXPECT_TRUE(isRight(trial));
        }
}

TEST_P(SunkenSphere, UnderTheGroundOrTouchingItFromBelowCastsNothing) {
    for (const double height : {-1.0, -1.5, -20.0}) {
        SCOPED_TRACE(height);
        Trial trial = casting(sphere({0.0, 0.0, height}, 1.0, 24));
        EXPECT_TRUE(isUnshadowed(trial));
        trial.view = nearTheGround();
        EXPECT_TRUE(isUnshadowed(trial));
    }
}

TEST_P(SunkenSphere, WithTheLampInsideDarkensWhatIsOutside) {
    const Trial trial = casting(sphere({0.0, 0.0, 0.0}, 1.0, 24), {0.01, 0.02, 0.25, 1.0}); // no ray along an edge
    EXPECT_EQ(truthOf(trial).mask.count(Seen::LitReceiver), 0);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(Pole, ThroughTheGroundCastsItsUpperHalf) {
    Trial trial = casting(box({-0.25, -0.25, -30.0}, {0.25, 0.25, 1.0}));
    EXPECT_EQ(truthOf(trial).shadowPixels(), 12 * 6); // 1 long, 0.5 wide, at 12 pixels a unit
    EXPECT_TRUE(isRight(trial));
    trial.light = {2.0, 0.0, 0.75, 1.0};
    EXPECT_TRUE(isRight(trial));
}

TEST_P(Rug, InTheGroundCastsNothingOnItselfNorAround) {
    Trial trial = casting(square(1.0, 0.0));
    EXPECT_TRUE(isUnshadowed(trial));
    trial.view = nearTheGround();
    EXPECT_TRUE(isUnshadowed(trial));
}

TEST_P(Rug, ACentimetreHighHasItsContactShadow) {
    Trial trial = casting(quad({0.0, -1.0, 0.01}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}));
    trial.view = fromAbove(0.03, 96);
    EXPECT_EQ(truthOf(trial).shadowPixels(), 16 * 96); // 1 cm of 6, along the whole edge
    EXPECT_TRUE(isRight(trial));
    trial.view = perspective({-0.6, -0.5, 0.4}, {0.0, 0.0, 0.0}, 128, 96, 10.0, 0.1, 10.0);
    EXPECT_GT(truthOf(trial).shadowPixels(), 500);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(Rug, ACentimetreThickOnTheGroundHasItsContactShadow) {
    Trial trial = casting(box({0.0, -1.0, 0.0}, {2.0, 1.0, 0.01}));
    trial.view = fromAbove(0.03, 96);
    EXPECT_TRUE(isRight(trial));
    trial.view = perspective({-0.6, -0.5, 0.4}, {0.0, 0.0, 0.0}, 128, 96, 10.0, 0.1, 10.0);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(Rug, FarFromTheEyeDarkensNeitherItselfNorWhatLiesInTheGround) {
    Trial trial = casting(square(1.0, 0.0));
    trial.casters.push_back(box({2.0, -0.5, 0.0}, {2.5, 0.5, 1.0}));
    trial.view = perspective({-60.0, -60.0, 6.0}, {0.0, 0.0, 0.0}, 128, 96, 5.0, 1.0, 200.0);
    EXPECT_TRUE(isRight(trial));
}
