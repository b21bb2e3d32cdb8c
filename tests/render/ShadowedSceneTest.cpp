// SPDX-License-Identifier: MIT
// A program written for osgShadow::ShadowedScene, compiled as it is and with the type of Gnomon in its place.
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/ShadowedScene.h>
#include <gtest/gtest.h>
#include <support/Oracle.h>
#include <support/Scene.h>

#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowedScene>

#include <algorithm>
#include <vector>

using namespace test;

namespace {

constexpr unsigned receivesMask = 0x1, castsMask = 0x2;
const Mesh tower = box({-0.5, -0.5, 0.0}, {0.5, 0.5, 2.0}), faraway = box({1.5, 1.5, 0.0}, {2.5, 2.5, 1.0});
const osg::Vec4d sun(1.0, 0.0, 1.0, 0.0);

/// As OpenSceneGraph's example osgshadow sets its scenes up: the ground only receives, one box only casts, and one does
/// neither.
template <class ShadowedScene>
osg::ref_ptr<ShadowedScene> program() {
    osg::ref_ptr<ShadowedScene> shadowedScene = new ShadowedScene;
    osgShadow::ShadowSettings* settings = shadowedScene->getShadowSettings();
    settings->setReceivesShadowTraversalMask(receivesMask);
    settings->setCastsShadowTraversalMask(castsMask);
    osg::ref_ptr<osgShadow::ShadowMap> map = new osgShadow::ShadowMap;
    map->setTextureSize(osg::Vec2s(1024, 1024));
    shadowedScene->setShadowTechnique(map.get());

    osg::ref_ptr<osg::Node> ground = node(square(8.0), "ground"), caster = node(tower, "tower"),
                            none = node(faraway, "none");
    ground->setNodeMask(receivesMask);
    caster->setNodeMask(castsMask);
    none->setNodeMask(0x4);
    for (const auto& part : {ground, caster, none}) shadowedScene->addChild(part);
    return shadowedScene;
}

osg::ref_ptr<osg::Group> lit(osg::Node* content) {
    const Scene around = scene(sun);
    around.content->addChild(content);
    return around.root;
}

View view() { return fromAbove(4.0, 128); }

Picture drawn(osg::Node* content) {
    const osg::ref_ptr<osg::Group> root = lit(content);
    return render(root, view());
}

Mask rays() {
    Mask mask = castRays(square(8.0), {tower}, sun, view());
    const Mask other = castRays(square(8.0), {faraway}, sun, view()); // is seen, and casts nothing
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
        if (other.pixels[i] == Seen::Caster) mask.pixels[i] = Seen::Caster;
    return mask;
}

/// Lit ground that is dark, and the other way round, off the edges.
int wrongGround(const Picture& picture, const Mask& mask) {
    int wrong = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const Seen seen = mask.at(x, y);
            if ((seen != Seen::LitReceiver && seen != Seen::ShadowedReceiver) || mask.atEdge(x, y, 2)) continue;
            wrong += picture.at(x, y) != grey(seen == Seen::LitReceiver ? litGround : shadowedGround);
        }
    return wrong;
}

/// Ground that is darker than the middle between its darkest and its brightest.
std::vector<bool> darkGround(const Picture& picture, const Mask& mask) {
    const auto isGround = [&](std::size_t i) {
        return mask.pixels[i] == Seen::LitReceiver || mask.pixels[i] == Seen::ShadowedReceiver;
    };
    unsigned darkest = 255, brightest = 0;
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
        if (!isGround(i)) continue;
        darkest = std::min(darkest, picture.pixels[i] & 0xff);
        brightest = std::max(brightest, picture.pixels[i] & 0xff);
    }
    std::vector<bool> dark(mask.pixels.size());
    for (std::size_t i = 0; i < dark.size(); ++i)
        dark[i] = isGround(i) && 2 * (picture.pixels[i] & 0xff) < darkest + brightest;
    return dark;
}

} // namespace

TEST(ShadowedScene, DrawsWhatAProgramOfOsgShadowAsksFor) {
    const Mask mask = rays();
    ASSERT_GT(mask.count(Seen::ShadowedReceiver), 200);
    EXPECT_EQ(wrongGround(drawn(program<gnomon::ShadowedScene>()), mask), 0);
}

/// osgShadow shows the shadow of that box and of no other, too: the masks mean the same. Its lit colours are others.
TEST(ShadowedScene, HasTheShadowWhereOsgShadowHasIt) {
    const Mask mask = rays();
    const std::vector<bool> theirs = darkGround(drawn(program<osgShadow::ShadowedScene>()), mask),
                            ours = darkGround(drawn(program<gnomon::ShadowedScene>()), mask);
    int both = 0, either = 0;
    for (std::size_t i = 0; i < theirs.size(); ++i) {
        both += theirs[i] && ours[i];
        either += theirs[i] || ours[i];
    }
    EXPECT_GT(both, 200);
    EXPECT_GT(both, 0.8 * either); // its map has 1024 texels over all of the scene
}

TEST(ShadowedScene, CastsNothingWithoutATechniqueAsThere) {
    const osg::ref_ptr<gnomon::ShadowedScene> scene = program<gnomon::ShadowedScene>();
    scene->setShadowTechnique(nullptr);
    const Picture without = drawn(scene);
    EXPECT_EQ(without.count(shadowedGround), 0);
    EXPECT_GT(without.count(litGround), 10000);
}

TEST(ShadowedScene, FollowsMasksThatChangeWhileItIsDrawn) {
    const osg::ref_ptr<gnomon::ShadowedScene> scene = program<gnomon::ShadowedScene>();
    const osg::ref_ptr<osg::Group> root = lit(scene);
    Camera camera(root, view());
    EXPECT_GT(camera.frame().count(shadowedGround), 200);
    scene->getShadowSettings()->setCastsShadowTraversalMask(0x8); // nobody has it
    EXPECT_EQ(camera.frame().count(shadowedGround), 0);
    scene->getShadowSettings()->setCastsShadowTraversalMask(castsMask);
    scene->getShadowSettings()->setReceivesShadowTraversalMask(0x8);
    EXPECT_EQ(camera.frame().count(shadowedGround), 0);
}

TEST(ShadowedScene, TakesAnotherTechniqueOfGnomon) {
    const osg::ref_ptr<gnomon::ShadowedScene> scene = program<gnomon::ShadowedScene>();
    scene->setShadow(new gnomon::PlanarShadowNode(osg::Vec4d(0.0, 0.0, 1.0, 0.0)));
    scene->setShadow(nullptr);
    ASSERT_NE(scene->getShadow(), nullptr);
    EXPECT_EQ(wrongGround(drawn(scene), rays()), 0);
}

TEST(ShadowedScene, ACopyDrawsTheSame) {
    const osg::ref_ptr<gnomon::ShadowedScene> scene = program<gnomon::ShadowedScene>();
    const Picture expected = drawn(scene);
    for (const auto& how : {osg::CopyOp::SHALLOW_COPY, osg::CopyOp::DEEP_COPY_NODES}) {
        const osg::ref_ptr<gnomon::ShadowedScene> copy = osg::clone(scene.get(), osg::CopyOp(how));
        ASSERT_TRUE(copy);
        EXPECT_EQ(drawn(copy).different(expected), 0);
    }
}

int techniquesOf(const osg::Group& group) {
    int count = 0;
    for (unsigned i = 0; i < group.getNumChildren(); ++i)
        count += dynamic_cast<const gnomon::ShadowTechnique*>(group.getChild(i)) != nullptr;
    return count;
}

/// The scene has a technique from the start, which is not to cast beside those that are asked for.
TEST(ShadowedScene, AddShadowsTakesThePlaceOfTheTechniqueThatItHas) {
    const osg::ref_ptr<gnomon::ShadowedScene> shadowed = program<gnomon::ShadowedScene>();
    for (const char* spec : {"volume", "map:size=512"}) {
        const auto made = gnomon::addShadows(*shadowed, {gnomon::parseShadowSpec(spec)});
        EXPECT_EQ(techniquesOf(*shadowed), 1) << spec;
        EXPECT_EQ(shadowed->getShadow(), made.front()) << spec;
        EXPECT_EQ(made.front()->getReceiver().mask, receivesMask) << spec;
        EXPECT_EQ(wrongGround(drawn(shadowed), rays()), 0) << spec;
    }
    const auto both = gnomon::addShadows(
        *shadowed, {gnomon::parseShadowSpec("traced:receiver=ground"), gnomon::parseShadowSpec("volume")});
    EXPECT_EQ(techniquesOf(*shadowed), 2);
    EXPECT_EQ(both.front()->getReceiver().node->getName(), "ground");
    shadowed->removeChild(both.back());
    gnomon::addShadows(*shadowed, {gnomon::parseShadowSpec("none")});
    EXPECT_EQ(techniquesOf(*shadowed), 0);
}
