// SPDX-License-Identifier: MIT
// Casters that the view does not hold, or holds in part; mirrored ones; views of no size.
#include "Trial.h"

#include <osg/MatrixTransform>

using namespace test;

namespace {

/// x of the caster becomes -2 x, by a transform 9 deep.
void mirror(const Scene& scene) {
    osg::ref_ptr<osg::Node> all = scene.content->getChild(1);
    for (const double x : {-2.0, 4.0, 0.25, 0.5, 2.0, -1.0, -1.0, 8.0, 0.125}) {
        osg::ref_ptr<osg::MatrixTransform> over = new osg::MatrixTransform(osg::Matrixd::scale(x, 1.0, 1.0));
        over->addChild(all);
        all = over;
    }
    scene.content->setChild(1, all);
}

GNOMON_BY_TECHNIQUE(HardView);
GNOMON_BY_TECHNIQUE(MirroredCaster);

} // namespace

TEST_P(HardView, BesideACasterShowsItsShadow) {
    Trial trial;
    trial.casters = {box({9.0, -1.0, 0.0}, {10.0, 1.0, 3.0})};
    trial.light = {4.0, 0.0, 1.0, 0.0};
    trial.half = 30.0;
    const Truth truth = truthOf(trial);
    EXPECT_EQ(truth.mask.count(Seen::Caster), 0);
    EXPECT_GT(truth.shadowPixels(), 128 * 20);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(HardView, BeforeACasterShowsItsShadow) {
    Trial trial;
    trial.casters = {box({-1.0, -7.0, 0.0}, {1.0, -6.0, 4.0})};
    trial.light = {0.0, -2.0, 1.0, 0.0};
    trial.view = perspective({1.5, -3.0, 1.5}, {0.0, 2.0, 0.0}, 128, 96);
    const Truth truth = truthOf(trial);
    EXPECT_EQ(truth.mask.count(Seen::Caster), 0);
    EXPECT_GT(truth.shadowPixels(), 1000);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(HardView, WhoseNearPlaneCutsACasterShowsItsShadow) {
    Trial trial;
    trial.casters = {box({-2.5, -0.5, -0.5}, {-1.5, 0.5, 0.75})};
    trial.light = {-1.0, 0.25, 0.5, 0.0};
    trial.view = perspective({-3.0, -0.25, 1.0}, {0.0, 0.0, 0.0}, 128, 96, 60.0);
    const Truth truth = truthOf(trial);
    EXPECT_GT(truth.mask.count(Seen::Caster), 100);
    EXPECT_GT(truth.shadowPixels(), 500);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(HardView, ThatNoShadowReachesIsUnshadowed) {
    Trial trial;
    trial.light = {4.0, 0.0, 1.0, 0.0};
    trial.half = 40.0;
    const Mesh beside = box({-12.0, -1.0, 0.0}, {-10.0, 1.0, 3.0}); // casts away from what is seen
    trial.casters = {beside};
    EXPECT_TRUE(isUnshadowed(trial));
    // One caster on either side of the light's way to what is seen, and nothing between: the box about both is all that
    // is known of it at first.
    trial.casters = {joined({box({9.0, -9.0, 0.0}, {10.0, -6.0, 3.0}), box({9.0, 6.0, 0.0}, {10.0, 9.0, 3.0})})};
    EXPECT_EQ(truthOf(trial).shadowPixels(), 0);
    EXPECT_TRUE(isUnshadowed(trial));
}

TEST_P(HardView, OfNoSizeIsNoHarmToTheNext) {
    Trial trial;
    trial.casters = {box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0})};
    const Truth truth = truthOf(trial);
    Scene scene = trial.buildWithShadow();
    Camera camera(scene.root, trial.view);
    const auto frame = [&camera](int size) {
        camera.viewer().getCamera()->setViewport(0, 0, size, size);
        return camera.frame();
    };
    for (const int size : {0, 1}) frame(size);
    EXPECT_TRUE(shows(frame(128), truth));
}

TEST_P(MirroredCaster, CastsAsMuchAsItsImage) {
    Trial given;
    given.light = {1.0, 0.5, 1.0, 0.0};
    given.casters = {house({0.75, 0.0}, {0.5, 1.0, 1.0}, 30.0)};
    Mesh image = given.casters[0];
    for (glm::dvec3& v : image) v.x *= -2.0;
    Scene lit = given.build(), dark = given.build(), shadowed = given.buildWithShadow();
    dark.takeLightAway();
    for (const Scene* scene : {&lit, &dark, &shadowed}) mirror(*scene);
    const Truth truth{render(lit.root, given.view), render(dark.root, given.view),
                      castRays(square(given.half), {image}, given.light, given.view)};
    EXPECT_GT(truth.shadowPixels(), 200);
    EXPECT_TRUE(isRight(shadowed, given.view, truth));
}
