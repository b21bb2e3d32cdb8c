// SPDX-License-Identifier: MIT
// A program that was written for osgShadow::ShadowedScene, with one include and one name changed.
#include <gnomon/ShadowedScene.h>

#include <gtest/gtest.h>
#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowedScene>
#include <osgShadow/SoftShadowMap>
#include <support/Picture.h>
#include <support/Scene.h>

namespace {

constexpr unsigned receives = 0x1, casts = 0x2; // as in OSG's own example

const test::View view = test::fromAbove(8.0, 128);

/// A box over a ground, with a second box over it that casts none. The light comes from +x at 45°.
template <class ShadowedScene>
osg::ref_ptr<ShadowedScene> written(test::Scene& parts) {
    osg::ref_ptr<ShadowedScene> shadowedScene = new ShadowedScene;
    osgShadow::ShadowSettings* settings = shadowedScene->getShadowSettings();
    settings->setReceivesShadowTraversalMask(receives);
    settings->setCastsShadowTraversalMask(casts);
    osg::ref_ptr<osgShadow::ShadowMap> sm = new osgShadow::ShadowMap;
    sm->setTextureSize(osg::Vec2s(1024, 1024));
    shadowedScene->setShadowTechnique(sm.get());
    shadowedScene->addChild(parts.root.get());
    test::find(*parts.root, "ground")->setNodeMask(receives);
    return shadowedScene;
}

test::Scene boxes(unsigned secondMask) {
    test::Scene parts = test::groundScene({test::box({-3, -1, 1}, {-1, 1, 2}), test::box({3, -1, 1}, {5, 1, 2})});
    osg::Group& content = *parts.content;
    content.getChild(1)->setNodeMask(casts);
    content.getChild(2)->setNodeMask(secondMask);
    return parts;
}

} // namespace

TEST(ShadowedScene, DrawsTheShadowThatTheMasksOfOsgShadowAskFor) {
    test::Scene parts = boxes(receives);
    const test::Picture picture = test::render(written<gnomon::ShadowedScene>(parts), view);
    // 8 pixels a unit. The shadow of the first box lies from x = -5 to -2, of which the box hides -3 to -1.
    EXPECT_EQ(picture.at(64 - 32, 64) & 0xff, test::shadowedGround) << "x = -4";
    EXPECT_EQ(picture.at(64 - 44, 64) & 0xff, test::litGround) << "x = -5.5";
    EXPECT_EQ(picture.at(64 + 20, 64) & 0xff, test::litGround) << "x = 2.5, where the second box would cast";
}

TEST(ShadowedScene, LetsBothBoxesCastOnceTheirMasksSaySo) {
    test::Scene parts = boxes(casts);
    const auto scene = written<gnomon::ShadowedScene>(parts);
    EXPECT_EQ(test::render(scene, view).at(64 + 20, 64) & 0xff, test::shadowedGround);
    scene->setCastsShadowTraversalMask(0x4);
    EXPECT_EQ(test::render(scene, view).at(64 + 20, 64) & 0xff, test::litGround) << "masks count at once";
    scene->setCastsShadowTraversalMask(casts);
    scene->setReceivesShadowTraversalMask(0x4);
    EXPECT_EQ(test::render(scene, view).at(64 + 20, 64) & 0xff, test::litGround);
}

TEST(ShadowedScene, HasNoShadowWithoutATechnique) {
    test::Scene parts = boxes(casts);
    const auto scene = written<gnomon::ShadowedScene>(parts);
    scene->setShadowTechnique(nullptr);
    EXPECT_EQ(test::render(scene, view).at(64 - 32, 64) & 0xff, test::litGround);
    EXPECT_EQ(scene->getTechnique(), nullptr);
}

TEST(ShadowedScene, KeepsTheProgramsChildrenWhereTheyWere) {
    test::Scene parts = boxes(casts);
    const auto scene = written<gnomon::ShadowedScene>(parts);
    osg::ref_ptr<osg::Node> second = new osg::Node;
    scene->addChild(second);
    EXPECT_EQ(scene->getChild(0), parts.root);
    EXPECT_EQ(scene->getChild(1), second);
    EXPECT_EQ(scene->getChild(2), scene->getTechnique());
    osg::ref_ptr<osgShadow::SoftShadowMap> soft = new osgShadow::SoftShadowMap;
    scene->setShadowTechnique(soft);
    EXPECT_EQ(scene->getShadowTechnique(), soft);
    EXPECT_EQ(dynamic_cast<gnomon::ShadowMapTechnique&>(*scene->getChild(2)).getEdges(),
              gnomon::ShadowMapTechnique::SOFT);
}

/// The picture of osgShadow itself: the same shadow, away from the edges.
TEST(ShadowedScene, LooksAsItDidWithOsgShadow) {
    test::Scene before = boxes(casts), after = boxes(casts);
    const test::Picture old = test::render(written<osgShadow::ShadowedScene>(before), view);
    const test::Picture now = test::render(written<gnomon::ShadowedScene>(after), view);
    int alike = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) alike += ((old.at(x, y) & 0xff) < 180) == ((now.at(x, y) & 0xff) < 180);
    EXPECT_GT(alike, 0.97 * view.width * view.height);
}
