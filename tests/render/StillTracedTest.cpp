// SPDX-License-Identifier: MIT
// Traced shadows cast rays only where depth, light or casters may have changed something since the frame before.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>

using gnomon::TracedShadowTechnique;
using test::Picture;
using test::Scene;

namespace {

test::View fromTheSide() { return test::perspective({-6.0, -9.0, 8.0}, {0.0, 0.0, 0.0}, 160, 120); }

/// A tower and a small box that moves, on a ground that fills the view.
struct Yard {
    explicit Yard(double place = 0.0) {
        scene.content->addChild(mover);
        mover->addChild(test::node(test::box({2.0, -2.0, 0.5}, {2.5, -1.5, 1.0})));
        move(place);
        scene.addShadow(technique);
    }
    void move(double place) { mover->setMatrix(osg::Matrixd::translate(0.0, place, 0.0)); }

    Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})}, 40.0, {1.0, 0.3, 1.2, 0.0});
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    osg::ref_ptr<TracedShadowTechnique> technique = new TracedShadowTechnique;
};

/// As a viewer that has drawn nothing before shows it.
Picture anew(double place) {
    Yard yard(place);
    return test::render(yard.scene.root, fromTheSide());
}

constexpr std::size_t allPixels = 160 * 120;

TEST(StillTraced, AFrameInWhichNothingChangesCastsNoRay) {
    Yard yard;
    test::Camera camera(yard.scene.root, fromTheSide());
    const Picture first = camera.frame();
    const std::size_t traced = tracedPixels(*yard.technique);
    EXPECT_GT(traced, allPixels / 2);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(camera.frame().different(first), 0);
    EXPECT_EQ(tracedPixels(*yard.technique), traced);
    EXPECT_GT(first.count(test::shadowedGround), 100);
}

TEST(StillTraced, LightCameraAndCompositeAreFollowed) {
    Yard yard;
    test::Camera camera(yard.scene.root, fromTheSide());
    const Picture first = camera.frame();
    yard.scene.light->getLight()->setPosition({-1.0f, 0.3f, 1.2f, 0.0f});
    const Picture turned = camera.frame();
    EXPECT_GT(turned.different(first), 500);
    yard.scene.light->getLight()->setPosition({1.0f, 0.3f, 1.2f, 0.0f});
    EXPECT_EQ(camera.frame().different(first), 0);
    camera.setView(test::perspective({6.0, -9.0, 8.0}, {0.0, 0.0, 0.0}, 160, 120));
    camera.frame();
    camera.setView(fromTheSide());
    EXPECT_EQ(camera.frame().different(first), 0);
}

TEST(StillTraced, WhereSomethingMovesOnlyPixelsThatCanHaveChangedAreTraced) {
    Yard yard;
    test::Camera camera(yard.scene.root, fromTheSide());
    camera.frame();
    std::size_t traced = tracedPixels(*yard.technique);
    for (const double place : {0.25, 0.5, 1.5}) {
        yard.move(place);
        EXPECT_EQ(camera.frame().different(anew(place)), 0) << place;
        EXPECT_LT(tracedPixels(*yard.technique) - traced, allPixels / 8) << place;
        EXPECT_GT(tracedPixels(*yard.technique) - traced, 50u) << place;
        traced = tracedPixels(*yard.technique);
    }
}

} // namespace
