// SPDX-License-Identifier: MIT
// What box and hull say of shadows that they cannot draw, or not where they belong.
#include <support/Causes.h>
#include <support/Scene.h>

#include <gnomon/TerrainShadowGeode.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <support/Picture.h>

#include <cmath>

using gnomon::TerrainShadowGeode;
using test::Scene;

namespace {

const osg::Vec4d sun(1.0, 0.0, 1.0, 0.0);
const test::View above = test::fromAbove(8.0, 160);

std::vector<std::string> causesOf(Scene& scene, osg::Node* terrain, TerrainShadowGeode::Method method) {
    osg::ref_ptr<TerrainShadowGeode> shadow = new TerrainShadowGeode;
    shadow->setMethod(method);
    shadow->setReceiver({terrain});
    scene.addShadow(shadow);
    test::render(scene.root, above);
    return test::causesButLitSurfaces(*shadow);
}

/// A roof of 30°, and suns and lamps over one side of it: the other side is in its shadow below 30° alone.
TEST(TerrainCauses, SaysWhereTheTerrainsShadowOnItselfIsMissing) {
    const auto causes = [](const osg::Vec4d& light, double house = 0.0) {
        Scene scene = test::scene(light);
        osg::ref_ptr<osg::Group> roof = new osg::Group;
        roof->setName("ground");
        for (const double side : {-1.0, 1.0}) {
            osg::ref_ptr<osg::MatrixTransform> slope =
                new osg::MatrixTransform(osg::Matrixd::translate(20.0 * side, 0.0, 0.0) *
                                         osg::Matrixd::rotate(osg::DegreesToRadians(30.0 * side), osg::Y_AXIS));
            slope->addChild(test::node(test::square(20.0)));
            roof->addChild(slope);
        }
        scene.content->addChild(roof);
        scene.content->addChild(test::node(test::box({-1.0, house - 1.0, -3.0}, {1.0, house + 1.0, 3.0})));
        return causesOf(scene, roof, TerrainShadowGeode::HULL);
    };
    const auto sunAt = [](double x, double y, double degrees) {
        const double elevation = osg::DegreesToRadians(degrees);
        return osg::Vec4d(3.0 * x * std::cos(elevation), 3.0 * y * std::cos(elevation), 3.0 * std::sin(elevation), 0.0);
    };
    for (const osg::Vec4d& light : {sunAt(1.0, 0.0, 28.0), osg::Vec4d(9.0, 0.0, 4.0, 1.0)}) {
        ASSERT_EQ(causes(light).size(), 1u) << light.x();
        EXPECT_NE(causes(light).front().find("what it throws on itself is not drawn"), std::string::npos);
    }
    EXPECT_EQ(causes(sunAt(1.0, 0.0, 28.0), 300.0).size(), 1u) << "the house is out of sight, the roof is not";
    for (const osg::Vec4d& light : {sunAt(1.0, 0.0, 32.0), sunAt(0.0, 1.0, 28.0), osg::Vec4d(9.0, 0.0, 6.0, 1.0)})
        EXPECT_TRUE(causes(light).empty()) << light.x() << ' ' << light.y() << ' ' << light.z();
}

TEST(TerrainCauses, AsBoxSaysHowManyCastersAreNoBoxes) {
    const auto causes = [](TerrainShadowGeode::Method method) {
        Scene scene = test::groundScene(
            {test::box({-1.0, -1.0, -1.0}, {1.0, 1.0, 3.0}), test::box({4.0, -1.0, 0.5}, {6.0, 1.0, 3.0})}, // floats
            20.0, sun);
        return causesOf(scene, test::find(*scene.root, "ground"), method);
    };
    EXPECT_TRUE(causes(TerrainShadowGeode::HULL).empty());
    const std::vector<std::string> box = causes(TerrainShadowGeode::BOX);
    ASSERT_EQ(box.size(), 1u);
    EXPECT_NE(box[0].find("1 of 2 casters: its shadow is that of its bounding box"), std::string::npos) << box[0];
}

} // namespace
