// SPDX-License-Identifier: MIT
// Numbers that are none, planes without a normal, groups without casters: no shadow, and nothing else changes.
#include "Trial.h"

#include <osg/Geometry>
#include <osg/ShapeDrawable>

#include <cmath>
#include <limits>

using namespace test;

namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Trial boxOnGround() {
    Trial trial;
    trial.casters = {box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0})};
    trial.view = fromAbove(4.0, 96);
    return trial;
}

const osg::Vec4d badVectors[] = {{noNumber, 0.0, 1.0, 0.0}, {0.0, 0.0, noNumber, 0.0},
                                 {0.0, 0.0, 1.0, noNumber}, {infinity, 0.0, 1.0, 0.0},
                                 {0.0, 0.0, infinity, 0.0}, {0.0, 0.0, 1.0, -infinity},
                                 {0.0, 0.0, 0.0, 0.0},      {noNumber, noNumber, noNumber, noNumber}};

/// A triangle over the ground whose second corner is as given.
osg::ref_ptr<osg::Geode> triangleWith(const osg::Vec3& corner) {
    osg::ref_ptr<osg::Geode> geode = node({{1.0, 1.0, 1.0}, {2.0, 1.0, 1.0}, {1.0, 2.0, 1.0}}, "broken");
    auto* vertices = static_cast<osg::Vec3Array*>(geode->getDrawable(0)->asGeometry()->getVertexArray());
    (*vertices)[1] = corner;
    return geode;
}

/// No child hides the others by a bound that is no number: culling is off in both pictures that are compared.
void addUnculled(Scene& scene, osg::Node* child) {
    child->setCullingActive(false);
    for (osg::Node* above : {static_cast<osg::Node*>(scene.root), static_cast<osg::Node*>(scene.content)})
        above->setCullingActive(false);
    if (scene.group) scene.group->setCullingActive(false);
    scene.content->addChild(child);
}

GNOMON_BY_TECHNIQUE(BadLight);
GNOMON_BY_TECHNIQUE(BadVertex);
GNOMON_BY_TECHNIQUE(FlatCaster);
GNOMON_BY_TECHNIQUE(EmptyGroup);

} // namespace

TEST(BadPlane, GetsNoShadow) {
    const Trial trial = boxOnGround();
    const Picture lit = render(trial.build().root, trial.view);
    for (const osg::Vec4d& plane : badVectors) {
        SCOPED_TRACE(testing::Message() << plane.x() << ' ' << plane.y() << ' ' << plane.z() << ' ' << plane.w());
        Scene scene = trial.build();
        scene.addShadow(new gnomon::PlanarShadowNode(plane));
        EXPECT_TRUE(isUnshadowed(scene, trial.view, lit));
    }
}

TEST(BadPlane, LeavesTheShadowOnAGoodOneAlone) {
    const Trial trial = boxOnGround();
    Scene scene = trial.build();
    osg::ref_ptr<gnomon::PlanarShadowNode> technique = new gnomon::PlanarShadowNode;
    for (const osg::Vec4d& plane : badVectors) technique->addPlane(plane);
    technique->addPlane({0.0, 0.0, 1.0, 0.0});
    scene.addShadow(technique);
    EXPECT_TRUE(isRight(scene, trial.view, truthOf(trial)));
}

TEST(Plane, MayHaveANormalOfAnyLength) {
    const Trial trial = boxOnGround();
    const Truth truth = truthOf(trial);
    for (const double length : {1e-30, 1e-3, 7.0, 1e30}) {
        SCOPED_TRACE(length);
        Scene scene = trial.build();
        scene.addShadow(new gnomon::PlanarShadowNode(osg::Vec4d(0.0, 0.0, length, 0.0)));
        EXPECT_TRUE(isRight(scene, trial.view, truth));
    }
}

TEST_P(BadLight, SetOnTheGroupCastsNothing) {
    const Trial trial = boxOnGround();
    const Picture lit = render(trial.build().root, trial.view);
    for (const osg::Vec4d& light : badVectors) {
        SCOPED_TRACE(testing::Message() << light.x() << ' ' << light.y() << ' ' << light.z() << ' ' << light.w());
        Scene scene = trial.buildWithShadow();
        scene.group->addLight({0, light});
        EXPECT_TRUE(isUnshadowed(scene, trial.view, lit));
    }
}

TEST_P(BadLight, ThatShinesCastsNothing) {
    for (const osg::Vec4d& light : badVectors) {
        SCOPED_TRACE(testing::Message() << light.x() << ' ' << light.y() << ' ' << light.z() << ' ' << light.w());
        Trial trial = boxOnGround();
        trial.light = light;
        EXPECT_TRUE(isUnshadowed(trial));
    }
}

TEST_P(BadLight, LeavesTheShadowOfAGoodOneAlone) {
    const Trial trial = boxOnGround();
    Scene scene = trial.buildWithShadow();
    for (const osg::Vec4d& light : badVectors) scene.group->addLight({1, light});
    scene.group->addLight({0, trial.light});
    EXPECT_TRUE(isRight(scene, trial.view, truthOf(trial)));
}

TEST_P(BadVertex, LeavesTheShadowsOfGoodCastersAlone) {
    const float none = std::numeric_limits<float>::quiet_NaN(), far = std::numeric_limits<float>::infinity();
    const Trial trial = boxOnGround();
    for (const osg::Vec3& corner :
         {osg::Vec3(none, 0.0f, 1.0f), osg::Vec3(0.0f, 0.0f, none), osg::Vec3(none, none, none),
          osg::Vec3(far, 0.0f, 1.0f), osg::Vec3(0.0f, 0.0f, far), osg::Vec3(0.0f, -far, 1.0f)}) {
        SCOPED_TRACE(testing::Message() << corner.x() << ' ' << corner.y() << ' ' << corner.z());
        const Change change = [&corner](Scene& scene) { addUnculled(scene, triangleWith(corner)); };
        ASSERT_GT(truthOf(trial, change).lit.count(litGround), 96 * 96 / 2); // OpenGL draws the rest of the scene
        EXPECT_TRUE(isRight(trial, change));
    }
}

TEST_P(BadVertex, InEveryCasterMeansNoShadow) {
    Scene lit = scene(), shadowed = scene();
    for (Scene* each : {&lit, &shadowed}) {
        each->content->addChild(node(square(8.0), "ground"));
        addUnculled(*each, triangleWith({std::numeric_limits<float>::quiet_NaN(), 0.0f, 1.0f}));
    }
    shadowed.addShadow(castingTechnique());
    shadowed.group->setCullingActive(false);
    const View view = fromAbove(4.0, 96);
    const Picture expected = render(lit.root, view);
    ASSERT_GT(expected.count(litGround), 96 * 96 / 2);
    EXPECT_TRUE(isUnshadowed(shadowed, view, expected));
}

TEST_P(FlatCaster, OfNoAreaCastsNothing) {
    Trial trial = boxOnGround();
    trial.casters = {{{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.5, 0.0, 1.0}}, // three corners on a line
                     {{0.0, 1.0, 1.0}, {0.0, 1.0, 1.0}, {0.0, 1.0, 1.0}}};
    EXPECT_TRUE(isUnshadowed(trial));
}

TEST_P(EmptyGroup, DrawsLikeAnyGroup) {
    const View view = fromAbove(4.0, 96);
    Scene lit = scene(), empty = scene(), geodes = scene();
    lit.root->addChild(node(square(8.0)));
    const Picture expected = render(lit.root, view);
    for (Scene* each : {&empty, &geodes}) each->root->addChild(node(square(8.0)));
    geodes.content->addChild(new osg::Geode);
    osg::ref_ptr<osg::Geode> hollow = new osg::Geode;
    hollow->addDrawable(new osg::Geometry);
    geodes.content->addChild(hollow);
    empty.addShadow(castingTechnique());
    geodes.addShadow(castingTechnique());
    EXPECT_TRUE(isUnshadowed(empty, view, expected));
    EXPECT_TRUE(isUnshadowed(geodes, view, expected));
}

TEST_P(EmptyGroup, WithNothingInItAtAllIsDrawn) {
    Scene scene = test::scene();
    scene.root->addChild(new gnomon::ShadowCasterGroup);
    EXPECT_TRUE(same(render(scene.root, fromAbove(4.0, 32)), render(new osg::Group, fromAbove(4.0, 32))));
}
