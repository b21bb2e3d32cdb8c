// SPDX-License-Identifier: MIT
// Simple casters by volume and the others by a map, in one shadow.
#include "AutoTrial.h"

#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/Texture2D>

#include <algorithm>

using test::Camera;
using test::Picture;
using test::Scene;

namespace {

constexpr double half = 18.0;  // of the ground's side
constexpr double error = 0.42; // pixels: a map of all needs smooth edges for it
const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0);

test::View view() { return test::perspective({-20.0, -28.0, 20.0}, {0.0, 0.0, 0.0}, 320, 240); }

/// A board above the houses, whose shadow falls on them and on theirs. As triangles, and as what an alpha test cuts: a hole
/// of a centimetre, which no pixel shows.
struct Board {
    const osg::Vec3 corner{-1.5f, -1.5f, 5.0f}, side{3.0f, 0.0f, 0.0f}, up{0.0f, 3.0f, 0.0f};

    test::Mesh mesh() const {
        test::Mesh result;
        for (const osg::Vec3& vertex :
             {corner, corner + side, corner + side + up, corner, corner + side + up, corner + up})
            result.emplace_back(vertex.x(), vertex.y(), vertex.z());
        return result;
    }
    osg::ref_ptr<osg::Geode> node(bool tested) const {
        const osg::ref_ptr<osg::Image> white = new osg::Image;
        white->allocateImage(256, 256, 1, GL_RGBA, GL_UNSIGNED_BYTE);
        std::fill_n(white->data(), white->getTotalSizeInBytes(), 255);
        white->setColor({1.0f, 1.0f, 1.0f, 0.0f}, 64u, 64u);
        const osg::ref_ptr<osg::Geometry> geometry = osg::createTexturedQuadGeometry(corner, side, up);
        osg::StateSet& set = *geometry->getOrCreateStateSet();
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(white);
        for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
            texture->setWrap(wrap, osg::Texture::REPEAT); // else its border of no alpha rounds the corners
        set.setTextureAttributeAndModes(0, texture);
        if (tested) set.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
        const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(geometry);
        return geode;
    }
};

struct Town : test::AutoTrial {
    explicit Town(gnomon::ShadowCasterGroup::Composite composite = gnomon::ShadowCasterGroup::RELIGHT)
        : AutoTrial(test::town(6), {error, 0.0}, half, sun) {
        mover->addChild(Board().node(true));
        mover->setDataVariance(osg::Object::DYNAMIC);
        scene.content->addChild(mover);
        scene.group->setComposite(composite);
    }
    bool isMixed() const { return decision().chosen.mixed; }

    const osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
};

osg::ref_ptr<osg::LightSource> secondSun() {
    const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setLightNum(1);
    source->getLight()->setPosition({-1.0f, 0.2f, 1.4f, 0.0f});
    source->getLight()->setDiffuse({0.2f, 0.2f, 0.2f, 1.0f});
    return source;
}

} // namespace

TEST(AutoMixed, KeepsTheErrorWhereAnAlphaTestLeavesMapsOrBoth) {
    std::vector<test::Mesh> casters = test::town(6);
    casters.push_back(Board().mesh());
    const test::GroundTruth truth(casters, half, sun, view());
    Town town;
    const Picture picture = test::render(town.scene.root, view());
    EXPECT_TRUE(town.isMixed()) << town.chosen();
    EXPECT_EQ(town.chosen().rfind("volume+map", 0), 0u) << town.chosen();
    // 1.5: how well errors of maps are predicted
    EXPECT_LE(truth.edgesOffBy(picture), 1.5 * error) << town.chosen();
    EXPECT_EQ(town.technique->diagnose(), std::vector<std::string>());
}

// The board's shadow lies on houses, on the ground and on other shadows.
TEST(AutoMixed, DarkensNothingTwiceAndLeavesNoSeam) {
    Town town(gnomon::ShadowCasterGroup::BLEND);
    const Picture mixed = test::render(town.scene.root, view());
    ASSERT_TRUE(town.isMixed()) << town.chosen();
    town.scene.group->removeChildren(1, 1); // the technique
    const Picture lit = test::render(town.scene.root, view());
    Scene all = test::groundScene(test::town(6), half, sun);
    all.content->addChild(Board().node(false));
    const Picture allLit = test::render(all.root, view());
    all.addShadow("volume:composite=blend");
    const Picture volume = test::render(all.root, view());
    int edges = 0, dark = 0;
    const auto isDark = [](std::uint32_t shadowed, std::uint32_t plain) {
        return 4u * (shadowed & 0xffu) < 3u * (plain & 0xffu); // an edge may be anywhere between a half and all
    };
    for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
        const int before = int(lit.pixels[i] & 0xffu), after = int(mixed.pixels[i] & 0xffu);
        EXPECT_GE(2 * after, before - 2) << i << ": it is darkened twice";
        const bool shadowed = isDark(mixed.pixels[i], lit.pixels[i]);
        dark += shadowed;
        edges += shadowed != isDark(volume.pixels[i], allLit.pixels[i]);
    }
    EXPECT_GT(dark, 3000);
    EXPECT_LE(edges, 60) << "half a pixel along the outline of the board's shadow, some 120 long";
}

TEST(AutoMixed, DrawsItsMapAgainOnlyWhereThingsMove) {
    Town town;
    Camera camera(town.scene.root, view());
    camera.frame();
    const auto passesOf = [&](double step) {
        const unsigned before = town.technique->passes();
        for (int i = 0; i < 5; ++i) {
            town.mover->setMatrix(town.mover->getMatrix() * osg::Matrixd::translate(0.0, step, 0.0));
            camera.frame();
        }
        return town.technique->passes() - before;
    };
    EXPECT_EQ(passesOf(0.0), 0u);
    EXPECT_GE(passesOf(0.05), 5u);
    EXPECT_TRUE(town.isMixed()) << town.chosen();
}

TEST(AutoMixed, EndsAtOnceWhereNoCasterNeedsTheMap) {
    Town town;
    Camera camera(town.scene.root, view());
    for (int i = 0; i < 5; ++i) camera.frame(); // the first ones are compared anyway
    ASSERT_TRUE(town.isMixed()) << town.chosen();
    osg::Geode& board = *town.mover->getChild(0)->asGeode();
    board.getDrawable(0)->getStateSet()->removeAttribute(osg::StateAttribute::ALPHAFUNC);
    const Picture untested = camera.frame();
    EXPECT_EQ(town.chosen(), "volume") << "in the frame in which the test is gone";
    Scene all = test::groundScene(test::town(6), half, sun);
    all.content->addChild(Board().node(false));
    all.addShadow("volume");
    EXPECT_LE(untested.different(test::render(all.root, view())), 4)
        << "meshes keep their origin, and so round otherwise";
}

// Volumes and soft edges of several lights would take more stencil bits than there are.
TEST(AutoMixed, LeavesNoLightWithoutShadow) {
    Town town;
    Camera camera(town.scene.root, view());
    camera.frame();
    ASSERT_TRUE(town.isMixed()) << town.chosen();
    town.scene.root->addChild(secondSun());
    town.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    for (int i = 0; i < 2; ++i) {
        camera.frame();
        EXPECT_EQ(town.technique->lastDecision().size(), 2u);
        EXPECT_EQ(town.technique->diagnose(), std::vector<std::string>());
    }
}

TEST(AutoMixed, IsNotTakenWhereTooFewStencilBitsAreFree) {
    for (const unsigned reserved : {0x80u, 0xe0u, 0xfcu, 0xfeu}) {
        Town town;
        test::reserving(town.scene.root, reserved);
        test::render(town.scene.root, view());
        EXPECT_EQ(town.technique->diagnose(), std::vector<std::string>()) << reserved << ", " << town.chosen();
    }
}

TEST(AutoMixed, BeginsAtOnceWhereACasterNeedsTheMap) {
    Town town;
    osg::Geode& board = *town.mover->getChild(0)->asGeode();
    osg::StateSet& set = *board.getDrawable(0)->getStateSet();
    const osg::ref_ptr<osg::StateAttribute> test = set.getAttribute(osg::StateAttribute::ALPHAFUNC);
    set.removeAttribute(osg::StateAttribute::ALPHAFUNC);
    Camera camera(town.scene.root, view());
    for (int i = 0; i < 5; ++i) camera.frame(); // the first ones are compared anyway
    ASSERT_EQ(town.chosen(), "volume");
    set.setAttributeAndModes(test);
    camera.frame();
    EXPECT_TRUE(town.isMixed()) << town.chosen() << " in the frame in which the test is there";
}
