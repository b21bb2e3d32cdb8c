// SPDX-License-Identifier: MIT
#include "SpecScene.h"

#include <gnomon/NamedNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>

#include <stdexcept>

namespace {

using namespace gnomon;
using test::groupOf;
using test::square;

/// What addShadows() says of specifications for a group; "accepted" if nothing.
std::string refusal(ShadowCasterGroup& group, const std::vector<std::string>& texts) {
    std::vector<ShadowSpec> specs;
    for (const std::string& text : texts) specs.push_back(parseShadowSpec(text));
    try {
        addShadows(group, specs);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

std::vector<osg::Vec4d> planesOf(ShadowCasterGroup& group, const std::string& text) {
    const auto added = addShadows(group, {parseShadowSpec(text)});
    return dynamic_cast<PlanarShadowNode&>(*added.at(0)).getPlanes();
}

void expectPlane(const osg::Vec4d& seen, const osg::Vec4d& expected) {
    EXPECT_LT((seen / seen.length() - expected / expected.length()).length(), 1e-6)
        << seen.x() << " " << seen.y() << " " << seen.z() << " " << seen.w();
}

TEST(AddShadows, NoneAddsNothing) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("ground", 1));
    EXPECT_TRUE(addShadows(*group, {parseShadowSpec("none")}).empty());
    EXPECT_EQ(group->getNumChildren(), 1u);
}

TEST(AddShadows, PlanarTakesThePlaneOfTheNodeNamedGround) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("ground", 10));
    const auto added = addShadows(*group, {parseShadowSpec("planar")});
    ASSERT_EQ(added.size(), 1u);
    EXPECT_EQ(group->getChild(1), added[0]);
    EXPECT_EQ(added[0]->getReceiver().node, group->getChild(0));
    ASSERT_EQ(dynamic_cast<PlanarShadowNode&>(*added[0]).getPlanes().size(), 1u);
    expectPlane(dynamic_cast<PlanarShadowNode&>(*added[0]).getPlanes()[0], osg::Vec4d(0, 0, 1, 0));
}

TEST(AddShadows, PlanarFindsTheReceiverWhereTransformsPutIt) {
    osg::ref_ptr<osg::MatrixTransform> above = new osg::MatrixTransform(
        osg::Matrixd::rotate(osg::PI_2, osg::Vec3d(1, 0, 0)) * osg::Matrixd::translate(0, 5, 0));
    osg::ref_ptr<osg::MatrixTransform> wall = new osg::MatrixTransform(osg::Matrixd::translate(0, 0, 2));
    wall->setName("wall"); // z = 2 in `above` is y = -2 after its turn, y = 3 after its step; faces -y
    wall->addChild(square("", 1));
    above->addChild(wall);
    const std::vector<osg::Vec4d> planes = planesOf(*groupOf(above), "planar:receiver=wall");
    ASSERT_EQ(planes.size(), 1u);
    expectPlane(planes[0], osg::Vec4d(0, -1, 0, 3));
}

TEST(AddShadows, PlanarTakesTheSixSidesOfABoxAndNoSliver) {
    osg::ref_ptr<osg::Geode> box = new osg::Geode;
    box->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 2.0f)));
    box->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(3, 0, 3), osg::Vec3(0.1f, 0, 0), osg::Vec3(0, 0.1f, 0)));
    box->setName("ground"); // the last quad is 0.01 square, less than 1 % of a side's 4
    EXPECT_EQ(planesOf(*groupOf(box), "planar").size(), 6u);
}

TEST(AddShadows, TracedReceivesEverywhereUnlessAReceiverIsNamed) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("floor", 1));
    const auto added = addShadows(*group, {parseShadowSpec("traced"), parseShadowSpec("traced:receiver=floor")});
    ASSERT_EQ(added.size(), 2u);
    EXPECT_FALSE(added[0]->hasReceiver());
    EXPECT_EQ(added[1]->getReceiver().node, group->getChild(0));
    EXPECT_STREQ(added[0]->className(), "TracedShadowTechnique");
    EXPECT_EQ(refusal(*groupOf(square("floor", 1)), {"traced:receiver=roof"}),
              "no node is named \"roof\" to receive the shadow. Names in the scene: floor.");
}

TEST(AddShadows, VolumeTakesItsViewAndReceivesEverywhere) {
    const auto added = addShadows(*groupOf(square("floor", 1)), {parseShadowSpec("volume:view=volumes")});
    EXPECT_FALSE(added.at(0)->hasReceiver());
    EXPECT_EQ(dynamic_cast<const gnomon::ShadowVolumeTechnique&>(*added.at(0)).getView(),
              gnomon::ShadowVolumeTechnique::VOLUMES);
}

TEST(AddShadows, AllNodesOfAReceiversNameReceive) {
    osg::ref_ptr<osg::Group> town = new osg::Group;
    for (int i = 0; i < 400; ++i) { // steps of 1 in height, 300 of the area of 1, 100 of the area of 4
        const double height = i < 300 ? i % 3 : 3;
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(3 * i, 0, height));
        place->addChild(square("building", i < 300 ? 1 : 2));
        town->addChild(place);
    }
    town->addChild(square("street", 1));
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(town);
    const auto added = addShadows(*group, {parseShadowSpec("map:receiver=building")});
    EXPECT_EQ(added[0]->getReceiver().roots().size(), 400u);
    EXPECT_EQ(planesOf(*group, "planar:receiver=building").size(), 4u);
}

TEST(AddShadows, AMissingReceiverIsRefusedWithTheNamesThereAre) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("floor", 1));
    EXPECT_EQ(refusal(*group, {"planar"}),
              "no node is named \"ground\" to receive the shadow. Names in the scene: floor.");
    EXPECT_EQ(group->getNumChildren(), 1u) << "nothing is added when something is refused";
}

TEST(AddShadows, AReceiverWithNothingFlatIsRefused) {
    osg::ref_ptr<osg::Group> empty = new osg::Group;
    empty->setName("ground");
    EXPECT_EQ(refusal(*groupOf(empty), {"planar"}),
              "the receiver \"ground\" has no flat part, which planar needs. Name another one with receiver=NAME.");
}

TEST(AddShadows, CompositeBelongsToTheWholeGroup) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("ground", 1));
    EXPECT_EQ(refusal(*group, {"planar", "planar:composite=blend"}),
              "composite=relight and composite=blend cannot be mixed. Give every shadow the same.");
    EXPECT_EQ(refusal(*group, {"planar:composite=blend,dark=0.3", "planar:composite=blend,dark=0.3"}), "accepted");
    EXPECT_EQ(group->getComposite(), ShadowCasterGroup::BLEND);
    EXPECT_FLOAT_EQ(group->getDark(), 0.3f);
}

TEST(NamedNode, IsTheFirstWithExactlyThatName) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(1, 2, 3));
    osg::ref_ptr<osg::Node> first = square("floor", 1);
    first->setNodeMask(0);
    moved->addChild(square("floor2", 1));
    moved->addChild(first);
    root->addChild(moved);
    root->addChild(square("floor", 1));
    const auto found = findNamed(*root, "floor");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->node, first);
    EXPECT_EQ(found->rootFromParent.getTrans(), osg::Vec3d(1, 2, 3));
    EXPECT_FALSE(findNamed(*root, "Floor"));
    EXPECT_FALSE(findNamed(*root, ""));
}

} // namespace
