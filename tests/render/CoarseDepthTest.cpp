// SPDX-License-Identifier: MIT
// Where a depth buffer's steps are longer than pixels are wide, techniques that read depths say so. Others do not.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/group/LitCauses.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <cmath>
#include <string>
#include <vector>

using namespace test;

namespace {

using Causes = std::vector<std::string>;

constexpr int width = 160, height = 120;
const Mesh tower = box({-20.0, 780.0, 0.0}, {20.0, 820.0, 60.0});

/// At the tower, 800 m away.
View fromAfar(double near) {
    return perspective({-480.0, 300.0, 420.0}, {-20.0, 800.0, 10.0}, width, height, 30.0, near, 1000.0);
}

Causes said(gnomon::ShadowTechnique& technique, const Scene& scene, const View& view) {
    Camera camera(scene.root, view);
    camera.frame();
    return technique.diagnose();
}

/// Vertices about their middle: near the origin OpenGL draws them where they are.
osg::ref_ptr<osg::Node> placed(const Mesh& mesh) {
    const glm::dvec3 at = mesh.front();
    const osg::ref_ptr<osg::MatrixTransform> result =
        new osg::MatrixTransform(osg::Matrixd::translate(at.x, at.y, at.z));
    result->addChild(node(moved(mesh, -at), "tower"));
    return result;
}

/// A tower on a wide ground.
struct Trial {
    explicit Trial(osg::ref_ptr<gnomon::ShadowTechnique> with, const Mesh& caster = tower)
        : technique(std::move(with)) {
        scene = test::scene({1.0, 0.0, 1.0, 0.0});
        scene.content->addChild(node(square(1200.0), "ground"));
        scene.content->addChild(placed(caster));
        scene.addShadow(technique);
    }
    Causes seen(const View& view) { return said(*technique, scene, view); }

    Scene scene;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
};

std::vector<osg::ref_ptr<gnomon::ShadowTechnique>> thatReadDepths() {
    return {new gnomon::ShadowMapTechnique, new gnomon::ShadowVolumeTechnique, planar()};
}

Causes tooCoarse(const Trial& trial) {
    return {trial.technique->describe() +
            ": depths cannot tell where the shadow of 'tower' falls, because their steps are too long there. "
            "Move the near plane out, or let OpenSceneGraph compute it."};
}

/// Depth in the buffer, 0 … 1, of a point so far from the eye.
long double depthAt(const osg::Matrixd& projection, long double distance) {
    const long double z = projection(2, 2) * -distance + projection(3, 2),
                      w = projection(2, 3) * -distance + projection(3, 3);
    return (z / w + 1.0L) / 2.0L;
}

const Causes nothing;

} // namespace

TEST(CoarseDepth, BeginsWhereAStepIsAsLongAsAPixelIsWide) {
    for (const double near : {0.001, 0.1, 10.0}) {
        const osg::Matrixd lens = osg::Matrixd::perspective(30.0, double(width) / height, near, 1000.0);
        const long double distance = gnomon::coarseDepthFrom(lens, {{width, height}});
        const long double pixel =
            2.0L * distance * static_cast<long double>(std::tan(osg::DegreesToRadians(15.0))) / height;
        const long double step = std::ldexp(1.0L, -24);
        // Over a small part of that pixel, for depth is no straight line there.
        const long double part = 1e-4L * pixel;
        EXPECT_NEAR(double((depthAt(lens, distance + part) - depthAt(lens, distance)) / part * pixel / step), 1.0, 1e-3)
            << near;
    }
}

TEST(CoarseDepth, BeginsNowhereOrEverywhereInAnOrthographicView) {
    // 100 m high in 120 pixels: steps are as long as a pixel if 2^24 of them are 14 million metres.
    const auto from = [](double far) {
        return gnomon::coarseDepthFrom(osg::Matrixd::ortho(-50.0, 50.0, -50.0, 50.0, 0.0, far), {{height, height}});
    };
    EXPECT_GT(from(1.3e7), 1.0) << "w is 1 everywhere";
    EXPECT_LT(from(1.5e7), 1.0);
}

TEST(CoarseDepth, IsToldByTechniquesThatReadDepths) {
    for (const auto& technique : thatReadDepths()) {
        Trial trial(technique);
        EXPECT_EQ(trial.seen(fromAfar(0.001)), tooCoarse(trial)) << technique->className();
        EXPECT_EQ(trial.seen(fromAfar(1.0)), nothing) << technique->className();
    }
}

/// What lies 32 steps off the plane is dark, too: 12 m up a tower here, where a pixel is 4 m wide.
TEST(CoarseDepth, IsToldEarlierByPlanar) {
    Trial flat(planar()), map(new gnomon::ShadowMapTechnique);
    EXPECT_EQ(flat.seen(fromAfar(0.1)), tooCoarse(flat));
    EXPECT_EQ(map.seen(fromAfar(0.1)), nothing);
}

TEST(CoarseDepth, IsNotToldByOthers) {
    Trial flat(planar());
    flat.technique->setReceiver({find(*flat.scene.root, "ground")});
    EXPECT_EQ(flat.seen(fromAfar(0.001)), nothing);
    Trial traced(new gnomon::TracedShadowTechnique);
    EXPECT_EQ(traced.seen(fromAfar(0.001)), nothing);
}

TEST(CoarseDepth, DoesNotMatterWhereNothingCasts) {
    const Mesh post = box({-471.0, 309.0, 413.0}, {-470.5, 309.5, 415.0});
    Trial trial(new gnomon::ShadowMapTechnique, post);
    EXPECT_EQ(trial.seen(fromAfar(0.001)), nothing) << "the caster stands close to the eye";
}

/// As far away as the tower of the other tests.
TEST(CoarseDepth, DoesNotMatterWhereTheCasterIsNotSeen) {
    const auto seen = [](const Mesh& caster) {
        Trial trial(new gnomon::ShadowMapTechnique, caster);
        return trial.seen(fromAfar(0.001));
    };
    EXPECT_EQ(seen(box({-20.2, 799.8, 10.0}, {-19.8, 800.2, 10.4})), nothing) << "smaller than a pixel, which is 3 m";
    EXPECT_EQ(seen(box({580.0, 380.0, 0.0}, {620.0, 420.0, 60.0})), nothing) << "beside the view";
    EXPECT_EQ(seen(box({300.0, 1130.0, 0.0}, {340.0, 1170.0, 60.0})), nothing) << "beyond the far plane";
}

// A plate 40 m before the eye throws its shadow into the middle of the view, so that the technique has work there.
TEST(CoarseDepth, DoesNotMatterForACasterBeyondTheFarPlane) {
    Trial trial(new gnomon::ShadowMapTechnique, box({-452.0, 323.0, 404.0}, {-448.0, 327.0, 405.0}));
    trial.scene.light->getLight()->setPosition({-0.46f, -0.6f, 0.5f, 0.0f});
    trial.scene.content->addChild(placed(box({300.0, 1130.0, 0.0}, {340.0, 1170.0, 60.0})));
    EXPECT_EQ(trial.seen(fromAfar(0.001)), nothing);
    trial.scene.content->addChild(placed(tower));
    EXPECT_EQ(trial.seen(fromAfar(0.001)), tooCoarse(trial)) << "one in view";
}
