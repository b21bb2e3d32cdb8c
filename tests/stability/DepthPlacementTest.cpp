// SPDX-License-Identifier: MIT
// Receivers with a depth range or a polygon offset of their own: a shadow is where their surface is, not their depth.
#include "Trial.h"

#include <osg/Depth>
#include <osg/PolygonOffset>

using namespace test;

namespace {

GNOMON_BY_TECHNIQUE(DepthPlacements);

/// What is pushed back hides nothing that it did not hide before.
::testing::AssertionResult isRightWith(const char* name, osg::StateAttribute* attribute) {
    Trial trial{{house({0.0, 0.0}, {2.0, 1.5, 1.0}, 30.0)}};
    trial.view = perspective({-6.0, -10.0, 6.0}, {0.0, 0.0, 0.0}, 200, 150);
    return isRight(trial, [&](Scene& scene) {
        (*name ? find(*scene.root, name) : scene.root.get())->getOrCreateStateSet()->setAttributeAndModes(attribute);
    });
}

} // namespace

TEST_P(DepthPlacements, AGroundInADepthRangeOfItsOwn) {
    EXPECT_TRUE(isRightWith("ground", new osg::Depth(osg::Depth::LESS, 0.2, 1.0)));
}

TEST_P(DepthPlacements, AGroundThatIsPushedBack) {
    EXPECT_TRUE(isRightWith("ground", new osg::PolygonOffset(1.0f, 1.0f)));
    if (GetParam() == By::Hull) return; // its edges move with the offset
    EXPECT_TRUE(isRightWith("ground", new osg::PolygonOffset(2.0f, 40.0f)));
}

TEST_P(DepthPlacements, AGroundThatIsPulledForward) {
    EXPECT_TRUE(isRightWith("ground", new osg::PolygonOffset(-1.0f, -1.0f)));
}

TEST_P(DepthPlacements, AWholeSceneThatIsPushedBack) {
    if (GetParam() == By::Hull) return; // its edges move with the offset
    EXPECT_TRUE(isRightWith("", new osg::PolygonOffset(2.0f, 40.0f)));
}

TEST_P(DepthPlacements, AWholeSceneInHalfOfTheDepths) {
    EXPECT_TRUE(isRightWith("", new osg::Depth(osg::Depth::LESS, 0.0, 0.5)));
}
