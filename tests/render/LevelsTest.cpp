// SPDX-License-Identifier: MIT
// Levels of detail: what is drawn casts, in each view. Each picture equals that of the same drawables without levels.
#include "Hills.h"

#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <osg/LOD>
#include <osg/MatrixTransform>

#include <gtest/gtest.h>

using namespace test;

namespace {

struct Technique {
    const char* name;
    osg::ref_ptr<gnomon::ShadowTechnique> (*make)(const Scene& scene);
};

const Technique techniques[] = {
    {"planar",
     [](const Scene& scene) -> osg::ref_ptr<gnomon::ShadowTechnique> { return planar(find(*scene.root, "ground")); }},
    {"map", [](const Scene&) -> osg::ref_ptr<gnomon::ShadowTechnique> { return new gnomon::ShadowMapTechnique; }},
    {"hull",
     [](const Scene& scene) -> osg::ref_ptr<gnomon::ShadowTechnique> {
         osg::ref_ptr<gnomon::TerrainShadowGeode> technique = new gnomon::TerrainShadowGeode;
         technique->setReceiver({find(*scene.root, "ground")});
         return technique;
     }},
    {"traced", [](const Scene&) -> osg::ref_ptr<gnomon::ShadowTechnique> { return new gnomon::TracedShadowTechnique; }},
};

const View view = perspective({0.0, -10.0, 6.0}, {0.0, 0.0, 1.0}, 320, 240, 30.0);
const Mesh fine = sphere({0.0, 0.0, 2.0}, 1.5, 48), coarse = sphere({0.0, 0.0, 2.0}, 1.5, 7);

/// Fine up to a distance, or to as many pixels, and coarse beyond.
osg::ref_ptr<osg::LOD> levels(const osg::ref_ptr<osg::Node>& near, const osg::ref_ptr<osg::Node>& distant, float cut,
                              const osg::Vec3& centre) {
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->setCenter(centre);
    lod->addChild(near, 0.0f, cut);
    lod->addChild(distant, cut, 1e9f);
    return lod;
}

Scene with(osg::Node* caster, const Technique& technique) {
    Scene scene = groundScene({}, 8.0, {1.0, -0.5, 1.5, 0.0});
    scene.content->addChild(caster);
    scene.addShadow(technique.make(scene));
    return scene;
}

const osg::Vec3d hilltop(-380.0, -380.0, 90.0);
const View overHills = perspective(hilltop, {0.0, 0.0, 0.0}, 400, 300, 45.0, 1.0, 2000.0);

/// @param withLevels  else the tiles that a view shows from `hilltop`, without levels of detail.
Scene hills(bool withLevels) {
    Scene scene = test::scene(sunOverHills());
    for (int column = 0; column < 8; ++column)
        for (int row = 0; row < 8; ++row) {
            const osg::Vec3 centre = centreOfTile(column, row);
            const bool isNear = (osg::Vec3d(centre) - hilltop).length() < 260.0;
            const osg::ref_ptr<osg::Node> near = hillTile(column, row, 20), distant = hillTile(column, row, 3);
            if (withLevels)
                scene.content->addChild(levels(near, distant, 260.0f, centre));
            else
                scene.content->addChild(isNear ? near : distant);
        }
    return scene;
}

} // namespace

TEST(Levels, ABallCastsAsTheLevelThatIsDrawn) {
    for (const Technique& technique : techniques)
        for (const bool near : {true, false}) {
            Scene plain = with(node(near ? fine : coarse), technique);
            Scene chosen = with(levels(node(fine), node(coarse), near ? 20.0f : 5.0f, {0, 0, 2}), technique);
            EXPECT_EQ(render(chosen.root, view).different(render(plain.root, view)), 0)
                << technique.name << (near ? " near" : " far");
        }
}

TEST(Levels, ByPixelsAndUnderATransformCastAsTheyAreDrawn) {
    for (const Technique& technique : techniques) {
        const auto placed = [](osg::Node* caster) {
            osg::ref_ptr<osg::MatrixTransform> place =
                new osg::MatrixTransform(osg::Matrixd::scale(0.5, 0.5, 0.5) * osg::Matrixd::translate(1.0, 2.0, 0.0));
            place->addChild(caster);
            return place;
        };
        osg::ref_ptr<osg::LOD> lod = levels(node(coarse), node(fine), 2000.0f, {0, 0, 2});
        lod->setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
        Scene plain = with(placed(node(coarse)), technique), chosen = with(placed(lod), technique);
        EXPECT_EQ(render(chosen.root, view).different(render(plain.root, view)), 0) << technique.name;
    }
}

TEST(Levels, OutOfViewCastAsTheViewWouldShowThem) {
    const View ground = perspective({-3.0, -4.0, 3.0}, {-3.0, 0.0, 0.0}, 320, 240, 30.0); // the ball is to the right
    for (const Technique& technique : techniques) {
        Scene plain = with(node(coarse), technique);
        Scene chosen = with(levels(node(fine), node(coarse), 2.0f, {0, 0, 2}), technique);
        EXPECT_EQ(render(chosen.root, ground).different(render(plain.root, ground)), 0) << technique.name;
    }
}

TEST(Levels, OfHillsCastNoShadowOnCoarserOnes) {
    for (const Technique& technique : {techniques[1], techniques[3]}) {
        Scene plain = hills(false), chosen = hills(true);
        for (Scene* scene : {&plain, &chosen}) scene->addShadow(technique.make(*scene));
        const Picture expected = render(plain.root, overHills);
        EXPECT_EQ(render(chosen.root, overHills).different(expected), 0) << technique.name;
        EXPECT_GT(expected.different(render(hills(false).root, overHills)), 200) << "there are shadows";
    }
}

/// Two views of one graph take turns; the ball is fine in one of them alone.
TEST(Levels, OfTwoViewsAreEachViewsOwn) {
    const View away = perspective({0.0, -30.0, 18.0}, {0.0, 0.0, 1.0}, 320, 240, 10.0);
    for (const Technique& technique : techniques) {
        Scene chosen = with(levels(node(fine), node(coarse), 20.0f, {0, 0, 2}), technique);
        Camera near(chosen.root, view), far(chosen.root, away);
        const Picture expectedNear = render(with(node(fine), technique).root, view),
                      expectedFar = render(with(node(coarse), technique).root, away);
        for (int frame = 0; frame < 3; ++frame) {
            EXPECT_EQ(near.frame().different(expectedNear), 0) << technique.name << frame;
            EXPECT_LE(far.frame().different(expectedFar), 50)
                << technique.name << frame; // texels of maps lie elsewhere
        }
        EXPECT_EQ(chosen.group->revision(), 2u) << technique.name;
    }
}
