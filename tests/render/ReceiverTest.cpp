// SPDX-License-Identifier: MIT
// What receives and what does not: edges, things in front, other sides, several planes.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/group/ShadowBin.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>

using namespace test;

namespace {

const osg::Vec4d sun(1.0, 0.0, 1.0, 0.0);
const View slanted = perspective({-6.0, -10.0, 6.0}, {0.0, 0.0, 0.0});

/// A table top (a box whose upper face is z = 0) over a floor at z = -2, and a caster whose shadow runs over its edge.
const Mesh tableTop = box({-2.0, -2.0, -0.3}, {2.0, 2.0, 0.0});
const Mesh overEdge = box({-1.5, -0.5, 1.0}, {0.5, 0.5, 1.5});

Scene tableScene() {
    Scene scene = test::scene(sun);
    scene.content->addChild(node(square(6.0, -2.0), "floor"));
    scene.content->addChild(node(tableTop, "table"));
    scene.content->addChild(node(overEdge, "caster"));
    return scene;
}

class Receiver : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Planar, Receiver, testing::Bool(),
                         [](const auto& named) { return named.param ? "NamedReceiver" : "Unnamed"; });

} // namespace

TEST_P(Receiver, ShadowEndsAtTheTablesEdgeAndLeavesItsSidesAndTheFloorAlone) {
    Scene lit = tableScene(), dark = tableScene(), shadowed = tableScene();
    dark.takeLightAway();
    shadowed.addShadow(planar(GetParam() ? find(*shadowed.root, "table") : nullptr));
    shadowed.group->setCasters({find(*shadowed.root, "caster")});
    // Only the upper face can be "receiver"; table sides and floor hide it or lie behind, as any other thing.
    const Mesh upper = square(2.0);
    const Mask mask = castRays(upper, {overEdge, moved(tableTop, {0.0, 0.0, -1e-6}), square(6.0, -2.0)}, sun, slanted);
    ASSERT_GT(mask.count(Seen::ShadowedReceiver), 500);
    const Comparison found =
        compare(render(shadowed.root, slanted), render(lit.root, slanted), render(dark.root, slanted), mask);
    EXPECT_EQ(found.wrongInside + found.wrongAtEdge, 0);
    EXPECT_LE(found.flipped, found.edges / 50); // the rasteriser's choice on outlines
}

TEST_P(Receiver, IsNotDarkenedFromItsUnlitSide) {
    Scene scene = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})});
    const View below = perspective({-6.0, -10.0, -6.0}, {0.0, 0.0, 0.0});
    const Picture lit = render(scene.root, below);
    const auto technique = planar(GetParam() ? find(*scene.root, "ground") : nullptr);
    scene.addShadow(technique);
    EXPECT_EQ(render(scene.root, below).different(lit), 0);
    ASSERT_EQ(technique->diagnose().size(), 1u);
    EXPECT_NE(technique->diagnose()[0].find("the camera is behind the plane"), std::string::npos);
}

TEST_P(Receiver, ThingsInFrontHideTheShadowAndKeepTheirLight) {
    Scene scene = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})});
    scene.content->addChild(node(quad({-3.0, -2.0, 0.2}, {1.5, 0.0, 0.0}, {0.0, 0.0, 1.0}), "screen"));
    const Picture lit = render(scene.root, slanted);
    scene.addShadow(planar(GetParam() ? find(*scene.root, "ground") : nullptr));
    scene.group->setCasters({find(*scene.root, "caster")});
    const Mesh screen = quad({-3.0, -2.0, 0.2}, {1.5, 0.0, 0.0}, {0.0, 0.0, 1.0});
    const Mask mask =
        castRays(square(8.0), {box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0}), screen}, {0.0, 0.0, -1.0, 0.0}, slanted);
    const Picture picture = render(scene.root, slanted);
    int changed = 0, wrong = 0;
    for (int y = 0; y < slanted.height; ++y)
        for (int x = 0; x < slanted.width; ++x) {
            const bool same = picture.at(x, y) == lit.at(x, y);
            changed += !same;
            wrong += !same && mask.at(x, y) == Seen::Caster && !mask.atEdge(x, y);
        }
    EXPECT_GT(changed, 300);
    EXPECT_EQ(wrong, 0);
}

TEST_P(Receiver, FloorAndWallEachTakeTheirOwnPart) {
    const Mesh wall = quad({-3.0, -4.0, 0.0}, {0.0, 8.0, 0.0}, {0.0, 0.0, 5.0}); // x = -3, towards +x
    const Mesh caster = box({-1.0, -1.0, 1.0}, {0.0, 1.0, 2.5});
    const auto build = [&] {
        Scene scene = test::scene({1.0, 0.2, 0.6, 0.0});
        osg::ref_ptr<osg::Group> room = new osg::Group;
        room->setName("room");
        room->addChild(node(square(8.0), "ground"));
        room->addChild(node(wall, "wall"));
        scene.content->addChild(room);
        scene.content->addChild(node(caster, "caster"));
        return scene;
    };
    const View view = perspective({8.0, -10.0, 7.0}, {-2.0, 0.0, 1.0});
    Scene lit = build(), dark = build(), shadowed = build();
    dark.takeLightAway();
    const auto technique = planar(GetParam() ? find(*shadowed.root, "room") : nullptr);
    technique->addPlane({1.0, 0.0, 0.0, 3.0});
    shadowed.addShadow(technique);
    shadowed.group->setCasters({find(*shadowed.root, "caster")});
    const Mask mask = castRays(joined({square(8.0), wall}), {caster}, {1.0, 0.2, 0.6, 0.0}, view);
    const Picture actual = render(shadowed.root, view), litPicture = render(lit.root, view),
                  darkPicture = render(dark.root, view);
    const Comparison found = compare(actual, litPicture, darkPicture, mask);
    // The wall darkens the ground behind it, which is not the caster's doing; it stands at x < -3 and is not seen from
    // here.
    EXPECT_EQ(found.wrongInside + found.wrongAtEdge, 0);
    EXPECT_LE(found.flipped, found.edges / 30);
    EXPECT_GT(mask.count(Seen::ShadowedReceiver), 1000);
}

TEST(Receiver, NamedOneOfTwoInstancesReceivesAlone) {
    Scene scene = test::scene(sun);
    const osg::ref_ptr<osg::Geode> tile = node(square(2.0));
    osg::ref_ptr<osg::Group> left = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> here = new osg::MatrixTransform(osg::Matrixd::translate(-2.0, 0.0, 0.0));
    osg::ref_ptr<osg::MatrixTransform> there = new osg::MatrixTransform(osg::Matrixd::translate(2.0, 0.0, 0.0));
    here->addChild(tile);
    there->addChild(tile);
    left->addChild(here);
    scene.content->addChild(left);
    scene.content->addChild(there);
    scene.content->addChild(node(square(1.0, 1.0), "caster")); // its shadow is centred on x = -1
    scene.content->addChild(node(moved(square(0.5, 1.0), {3.0, 0.0, 0.0}), "caster"));
    scene.addShadow(planar(left));
    const Picture picture = render(scene.root, fromAbove(4.0, 256));
    // [-2, 0] × [-1, 1], without the part under the square [-1, 1]² that casts it: 1 × 2 m of 32 × 32 pixels each.
    EXPECT_EQ(picture.count(shadowedGround), 2 * 32 * 32);
}
