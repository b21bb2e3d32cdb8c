// SPDX-License-Identifier: MIT
// Box, hull and drape as a node: what is found anew and when, what is drawn with a group above and without.
#include <support/Causes.h>
#include <support/Scene.h>

#include <gnomon/TerrainShadowGeode.h>
#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osg/Stencil>
#include <support/DiscShadow.h>
#include <support/Picture.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

using gnomon::TerrainShadowGeode;
using test::Scene;

namespace {

const osg::Vec4d sun(1.0, 0.0, 1.0, 0.0); // as far to -x as high

osg::ref_ptr<TerrainShadowGeode> shadowOn(osg::Node* terrain, TerrainShadowGeode::Method method) {
    osg::ref_ptr<TerrainShadowGeode> shadow = new TerrainShadowGeode;
    shadow->setMethod(method);
    shadow->setReceiver({terrain});
    return shadow;
}

/// A house of 2 × 2 and 3 high on a ground of 40 × 40, by itself.
osg::ref_ptr<TerrainShadowGeode> alone(TerrainShadowGeode::Method method) {
    const osg::ref_ptr<osg::Node> ground = test::node(test::square(20.0), "ground");
    osg::ref_ptr<TerrainShadowGeode> shadow = shadowOn(ground, method);
    shadow->setUserData(ground); // else nothing keeps it
    shadow->setObjectGraphic(test::node(test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0}), "house"));
    return shadow;
}

double areaOf(const TerrainShadowGeode& shadow) {
    double sum = 0.0;
    const std::vector<osg::Vec3d>& t = shadow.getTriangles();
    for (std::size_t i = 0; i + 2 < t.size(); i += 3) sum += 0.5 * ((t[i + 1] - t[i]) ^ (t[i + 2] - t[i])).z();
    return sum;
}

osg::BoundingBoxd boundsOf(const TerrainShadowGeode& shadow) {
    osg::BoundingBoxd bounds;
    for (const osg::Vec3d& corner : shadow.getTriangles()) bounds.expandBy(corner);
    return bounds;
}

const test::View above = test::fromAbove(8.0, 160); // ten pixels a unit

int darkened(const test::Picture& with, const test::Picture& without) { return with.different(without); }

} // namespace

TEST(TerrainShadowGeodeAlone, FindsTheShadowOfItsObjectWhereverItStands) {
    for (const auto method : {TerrainShadowGeode::HULL, TerrainShadowGeode::DRAPE}) {
        const auto shadow = alone(method);
        ASSERT_TRUE(shadow->compute(sun));
        EXPECT_NEAR(areaOf(*shadow), 2.0 * 2.0 + 2.0 * 3.0, 1e-9) << "under the house, and as long as it is high";
        EXPECT_NEAR(boundsOf(*shadow).xMin(), -4.0, 1e-9);
        shadow->setObjectPos({5.0, -7.0, 0.0});
        shadow->setObjectOrientation(45.0);
        ASSERT_TRUE(shadow->compute(sun));
        EXPECT_NEAR(areaOf(*shadow), 4.0 + 2.0 * std::sqrt(2.0) * 3.0, 1e-6) << "a square's diagonal wide";
        EXPECT_NEAR(boundsOf(*shadow).xMin(), 5.0 - std::sqrt(2.0) - 3.0, 1e-6);
        EXPECT_NEAR(boundsOf(*shadow).center().y(), -7.0, 1e-6);
        EXPECT_TRUE(shadow->diagnose().empty());
    }
}

TEST(TerrainShadowGeodeAlone, BoxIsTwelveTrianglesAndKeepsItsLifts) {
    const auto shadow = alone(TerrainShadowGeode::BOX);
    ASSERT_TRUE(shadow->compute(sun));
    EXPECT_EQ(shadow->getTriangles().size(), 36u);
    EXPECT_NEAR(boundsOf(*shadow).zMax(), 0.1, 1e-9) << "midpoints, as published";
    shadow->setObjectBounds({{-1.0, -1.0, 0.0}, {1.0, 1.0, 6.0}});
    const double before = areaOf(*shadow);
    ASSERT_TRUE(shadow->compute(sun));
    EXPECT_GT(areaOf(*shadow), before + 2.0) << "bounds that were given count";
}

/// ARL-TN-156's class ignores transforms in the caster, drops vertices by sign and divides by their coordinates, skips the
/// last of each range: a house beside its own origin, under a transform, one corner at 0.
TEST(TerrainShadowGeodeAlone, BoxTakesEveryVertexWhereItStands) {
    const auto still = alone(TerrainShadowGeode::BOX);
    ASSERT_TRUE(still->compute({1.0, 0.5, 1.0, 0.0}));
    const auto shadow = alone(TerrainShadowGeode::BOX);
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(-5.0, -5.0, 0.0));
    moved->addChild(test::node(test::box({5.0, 5.0, 0.0}, {7.0, 7.0, 3.0})));
    shadow->setObjectGraphic(moved);
    shadow->setObjectPos({-1.0, -1.0, 0.0});
    ASSERT_TRUE(shadow->compute({1.0, 0.5, 1.0, 0.0}));
    ASSERT_EQ(shadow->getTriangles().size(), still->getTriangles().size());
    for (std::size_t i = 0; i < still->getTriangles().size(); ++i)
        EXPECT_LT((shadow->getTriangles()[i] - still->getTriangles()[i]).length(), 1e-6) << i;
}

/// Its rays are 500 long whatever the scene.
TEST(TerrainShadowGeodeAlone, BoxReachesAsFarAsTheLightDoes) {
    const auto shadow = alone(TerrainShadowGeode::BOX);
    const osg::ref_ptr<osg::Node> ground = test::node(test::square(2000.0), "ground");
    shadow->setReceiver({ground});
    ASSERT_TRUE(shadow->compute({500.0, 0.0, 1.0, 0.0}));
    EXPECT_NEAR(boundsOf(*shadow).xMin(), -1.0 - 1500.0, 1e-3);
}

/// It clones the caster and never frees the clone.
TEST(TerrainShadowGeodeAlone, HoldsItsObjectOnceHoweverOftenItComputes) {
    const auto shadow = alone(TerrainShadowGeode::BOX);
    const int before = shadow->getObjectGraphic()->referenceCount();
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(shadow->compute({1.0, 0.01 * i, 1.0, 0.0}));
    EXPECT_EQ(shadow->getObjectGraphic()->referenceCount(), before);
    EXPECT_EQ(shadow->getObjectGraphic()->getNumParents(), 0u);
    EXPECT_EQ(shadow->getNumDrawables(), 1u);
}

TEST(TerrainShadowGeodeAlone, IsDrawnAsTransparentGeometryWithoutAGroup) {
    Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
    const test::Picture plain = test::render(scene.root, above);
    const auto shadow = shadowOn(test::find(*scene.root, "ground"), TerrainShadowGeode::HULL);
    shadow->setObjectGraphic(test::node(test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})));
    ASSERT_TRUE(shadow->compute(sun));
    scene.content->addChild(shadow);
    const test::Picture picture = test::render(scene.root, above);
    EXPECT_EQ(darkened(picture, plain), 30 * 20) << "3 by 2 are seen beside the house";
    const unsigned dark = picture.at(80 - 30, 80) & 0xff;
    EXPECT_NEAR(dark, 0.5 * test::litGround, 1.0);
}

TEST(TerrainShadowGeodeAlone, SaysThatItsTerrainIsGone) {
    const auto shadow = alone(TerrainShadowGeode::HULL);
    shadow->setUserData(nullptr);
    EXPECT_FALSE(shadow->compute(sun));
    ASSERT_EQ(shadow->diagnose().size(), 1u);
    EXPECT_NE(shadow->diagnose()[0].find("the terrain given to setReceiver() is gone"), std::string::npos);
}

TEST(TerrainShadowGeodeAlone, SaysWhatIsMissingAndDrawsNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refusal = [](TerrainShadowGeode& shadow, const osg::Vec4d& light) {
        EXPECT_FALSE(shadow.compute(light));
        EXPECT_EQ(shadow.getNumDrawables(), 0u);
        EXPECT_EQ(shadow.diagnose().size(), 1u);
        return shadow.diagnose().empty() ? "" : shadow.diagnose().front();
    };
    const osg::ref_ptr<TerrainShadowGeode> empty = new TerrainShadowGeode;
    EXPECT_NE(refusal(*empty, sun).find("setReceiver()"), std::string::npos);
    const osg::ref_ptr<osg::Node> ground = test::node(test::square(20.0)), nothing = new osg::Group;
    empty->setReceiver({ground});
    EXPECT_NE(refusal(*empty, sun).find("setObjectGraphic()"), std::string::npos);
    const auto shadow = alone(TerrainShadowGeode::HULL);
    EXPECT_TRUE(shadow->compute(sun));
    EXPECT_NE(refusal(*shadow, {nan, 0.0, 1.0, 0.0}).find("no finite position or direction"), std::string::npos);
    EXPECT_NE(refusal(*shadow, {1.0, 0.0, -1.0, 0.0}).find("below the horizon"), std::string::npos);
    shadow->setReceiver({nothing});
    EXPECT_NE(refusal(*shadow, sun).find("meets no ground"), std::string::npos);
    shadow->setError(nan);
    shadow->setError(-1.0);
    EXPECT_EQ(shadow->getError(), 0.1);
}

TEST(TerrainShadowGeodeAlone, UpdateFindsNothingAnewUnlessSomethingChanged) {
    const auto shadow = alone(TerrainShadowGeode::HULL);
    ASSERT_TRUE(shadow->update(sun));
    const unsigned first = shadow->builds();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(shadow->update(sun));
    EXPECT_EQ(shadow->builds(), first);
    EXPECT_TRUE(shadow->update({1.0, 1.0, 1.0, 0.0}));
    EXPECT_EQ(shadow->builds(), first + 1);
    shadow->setObjectPos({1.0, 0.0, 0.0});
    EXPECT_TRUE(shadow->update({1.0, 1.0, 1.0, 0.0}));
    EXPECT_EQ(shadow->builds(), first + 2);
    shadow->setMethod(TerrainShadowGeode::DRAPE);
    EXPECT_TRUE(shadow->update({1.0, 1.0, 1.0, 0.0}));
    EXPECT_EQ(shadow->builds(), first + 3);
}

TEST(TerrainShadowGeodeAlone, PrintsWhatItFound) {
    const auto shadow = alone(TerrainShadowGeode::HULL);
    shadow->setObjectPos({5.0, -7.0, 0.0});
    ASSERT_TRUE(shadow->compute(sun));
    std::ostringstream out;
    shadow->print(out);
    for (const char* part : {"HULL", "5 -7 0", "light 0.707107 0 0.707107 0", " triangles\n    ("})
        EXPECT_NE(out.str().find(part), std::string::npos) << part << " in " << out.str();
}

TEST(TerrainShadowGeode, IsFoundOnceALightUntilSomethingChanges) {
    Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
    osg::Node* house = scene.content->getChild(1);
    const auto shadow = shadowOn(test::find(*scene.root, "ground"), TerrainShadowGeode::HULL);
    scene.addShadow(shadow);
    test::Camera camera(scene.root, above);
    for (int i = 0; i < 3; ++i) camera.frame();
    EXPECT_EQ(shadow->builds(), 1u);
    scene.light->getLight()->setPosition({1.0f, 1.0f, 1.0f, 0.0f});
    for (int i = 0; i < 3; ++i) camera.frame();
    EXPECT_EQ(shadow->builds(), 2u);
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(3.0, 0.0, 0.0));
    moved->addChild(house);
    scene.content->replaceChild(house, moved);
    for (int i = 0; i < 3; ++i) camera.frame();
    EXPECT_EQ(shadow->builds(), 3u);
}

TEST(TerrainShadowGeode, TerrainCastsNothingOnItself) {
    Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
    const test::Picture plain = test::render(scene.root, above);
    const auto shadow = shadowOn(scene.content, TerrainShadowGeode::HULL); // house and ground
    scene.addShadow(shadow);
    EXPECT_EQ(darkened(test::render(scene.root, above), plain), 0);
    ASSERT_EQ(shadow->diagnose().size(), 1u);
    EXPECT_NE(shadow->diagnose().front().find("every caster is part of the receiver"), std::string::npos);
}

/// Fifteen shadows over one place, whichever way the bits that are left count them.
TEST(TerrainShadowGeode, MarksOnceWhateverLiesOverOneAnotherAndHoweverFewBitsAreLeft) {
    std::vector<test::Mesh> houses;
    for (int i = 0; i < 15; ++i) houses.push_back(test::box({3.0, -2.0, 0.4 * i}, {3.5 + 0.1 * i, 2.0, 0.4 * i + 0.3}));
    const auto picture = [&](unsigned reserved, std::string& cause) {
        Scene scene = test::groundScene(houses, 20.0, sun);
        const auto shadow = shadowOn(test::find(*scene.root, "ground"), TerrainShadowGeode::DRAPE); // prisms
        scene.addShadow(shadow);
        test::Picture result = test::render(test::reserving(scene.root, reserved), above);
        const std::vector<std::string> causes =
            test::causesButLitSurfaces(*shadow); // the houses stand in each other's shadow
        cause = causes.empty() ? "" : causes.front();
        return result;
    };
    Scene unshadowed = test::groundScene(houses, 20.0, sun);
    const test::Picture plain = test::render(unshadowed.root, above);
    std::string cause;
    const test::Picture all = picture(0, cause);
    EXPECT_EQ(cause, "");
    EXPECT_GT(darkened(all, plain), 1500);
    EXPECT_EQ(picture(0x03, cause).different(all), 0) << "one counter: odd from even";
    EXPECT_EQ(cause, "");
    EXPECT_EQ(picture(0xf0, cause).different(all), 0) << "two counters";
    EXPECT_EQ(picture(0x1f, cause).different(all), 0) << "three bits";
    EXPECT_EQ(cause, "");
    EXPECT_EQ(picture(0x3f, cause).different(plain), 0);
    EXPECT_NE(cause.find("need another stencil bit"), std::string::npos) << cause;
}

namespace {

/// A ridge of 12 m along y = 60 between the eye and half of 200 boxes.
/// @param shadow  null: none.
Scene behindARidge(TerrainShadowGeode* shadow) {
    Scene scene = test::scene(sun);
    osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    field->allocate(41, 41);
    field->setXInterval(3.0f);
    field->setYInterval(3.0f);
    for (unsigned y = 0; y < 41; ++y)
        for (unsigned x = 0; x < 41; ++x)
            field->setHeight(x, y, float(12.0 * std::exp(-0.01 * (3.0 * y - 60.0) * (3.0 * y - 60.0))));
    osg::ref_ptr<osg::Geode> ground = new osg::Geode;
    ground->addDrawable(new osg::ShapeDrawable(field));
    scene.content->addChild(ground);
    for (int i = 0; i < 200; ++i) {
        const double x = 10.0 + 10.0 * (i % 10), y = 10.0 + 5.0 * (i / 10);
        scene.content->addChild(test::node(test::box({x, y, -1.0}, {x + 2.0, y + 2.0, 14.0})));
    }
    if (!shadow) return scene;
    shadow->setReceiver({ground});
    scene.addShadow(shadow);
    return scene;
}

} // namespace

/// Decals against prisms, which stand on their own. What a ridge hides does not shine through it.
TEST(TerrainShadowGeode, IsHiddenBehindARidge) {
    const test::View low = test::perspective({60.0, -60.0, 14.0}, {60.0, 60.0, 4.0}, 400, 200, 40.0, 1.0, 400.0);
    osg::ref_ptr<TerrainShadowGeode> hull = new TerrainShadowGeode, exact = new TerrainShadowGeode;
    exact->setMethod(TerrainShadowGeode::DRAPE);
    exact->setError(0.0);
    const test::Picture right = test::render(behindARidge(exact).root, low);
    const int dark = right.different(test::render(behindARidge(nullptr).root, low));
    EXPECT_GT(dark, 1000);
    EXPECT_LE(test::render(behindARidge(hull).root, low).different(right), 6); // edges through a pixel's middle
}

/// Its counters are bits that nobody else takes and nobody left anything in.
TEST(TerrainShadowGeode, MarksAsPlanarDoesBesideSoftEdgesAndOverWhatOthersLeftInTheStencilBuffer) {
    const auto picture = [&](gnomon::ShadowTechnique& technique, bool soft) {
        Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
        osg::Node* ground = test::find(*scene.root, "ground");
        technique.setReceiver({ground});
        scene.addShadow(&technique);
        if (soft) {
            scene.group->addChild(new test::DiscShadow({130.0, 130.0}, 5.0, 15.0));
            return test::render(scene.root, above);
        }
        osg::ref_ptr<osg::Stencil> writes = new osg::Stencil;
        writes->setFunction(osg::Stencil::ALWAYS, 1, ~0u);
        writes->setOperation(osg::Stencil::KEEP, osg::Stencil::KEEP, osg::Stencil::REPLACE);
        ground->getOrCreateStateSet()->setAttributeAndModes(writes);
        scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        return test::render(scene.root, above);
    };
    for (const bool soft : {true, false}) {
        const osg::ref_ptr<gnomon::ShadowTechnique> planar = test::planar(), hull = new TerrainShadowGeode;
        EXPECT_EQ(picture(*hull, soft).different(picture(*planar, soft)), 0) << (soft ? "soft" : "left");
    }
}

TEST(TerrainShadowGeodeAlone, KeepsItsReasonWhileItIsDrawn) {
    const auto shadow = alone(TerrainShadowGeode::HULL);
    EXPECT_FALSE(shadow->compute({1.0, 0.0, -1.0, 0.0}));
    const auto said = shadow->diagnose();
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(shadow);
    test::render(root, above);
    EXPECT_EQ(shadow->diagnose(), said);
    ASSERT_TRUE(shadow->compute(sun));
    shadow->setObjectPos({0.0, 0.0, -10.0});
    EXPECT_FALSE(shadow->compute(sun));
    ASSERT_EQ(shadow->diagnose().size(), 1u);
    EXPECT_NE(shadow->diagnose().front().find("in the ground"), std::string::npos);
}

/// The shadow is found on the finest ground, a slope, and falls on whichever is drawn: in plan the same.
TEST(TerrainShadowGeode, FallsOnTheLevelOfDetailThatIsDrawn) {
    const auto shadowIn = [&](float fineUpTo) {
        Scene scene = test::groundScene({test::box({-1.0, -1.0, -2.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
        osg::ref_ptr<osg::LOD> lod = new osg::LOD;
        lod->addChild(test::node(test::quad({-20.0, -20.0, -4.0}, {40.0, 0.0, 8.0}, {0.0, 40.0, 0.0})), 0.0f, fineUpTo);
        lod->addChild(test::node(test::square(20.0, -2.0)), fineUpTo, 1e9f); // below all corners of the shadow
        scene.content->replaceChild(test::find(*scene.root, "ground"), lod);
        const test::Picture plain = test::render(scene.root, above);
        scene.addShadow(shadowOn(lod, TerrainShadowGeode::HULL));
        const test::Picture picture = test::render(scene.root, above);
        std::vector<bool> dark;
        for (int y = 0; y < plain.height; ++y)
            for (int x = 0; x < plain.width; ++x) dark.push_back(picture.at(x, y) != plain.at(x, y));
        return std::make_pair(dark, plain.at(20, 20));
    };
    const auto [fine, fineGround] = shadowIn(1e9f);
    const auto [coarse, coarseGround] = shadowIn(0.1f);
    EXPECT_NE(fineGround, coarseGround) << "another ground is drawn, of another slope";
    EXPECT_EQ(fine, coarse);
    // 3 high over x = 1 … -1, where the slope is x / 5: it ends at x = -1 - (3 - x / 5), that is at -5.
    EXPECT_EQ(std::count(fine.begin(), fine.end(), true), 40 * 20);
}

/// A bridge and the ground under it: each is in shadow once.
TEST(TerrainShadowGeode, FallsOnAllStoreys) {
    for (const unsigned reserved : {0x00u, 0x03u}) {
        Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
        osg::ref_ptr<osg::Group> storeys = new osg::Group;
        osg::Node* ground = test::find(*scene.root, "ground");
        storeys->addChild(ground);
        storeys->addChild(test::node(test::square(20.0, -0.01)));
        scene.content->replaceChild(ground, storeys);
        scene.addShadow(shadowOn(storeys, TerrainShadowGeode::DRAPE));
        Scene plain = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
        EXPECT_EQ(darkened(test::render(test::reserving(scene.root, reserved), above), test::render(plain.root, above)),
                  30 * 20)
            << reserved;
    }
}
