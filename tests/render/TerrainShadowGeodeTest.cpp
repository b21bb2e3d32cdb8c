// SPDX-License-Identifier: MIT
// Box and hull as a node: what is found anew and when, what is drawn with a group above and without.
// What box and hull say of shadows that they cannot draw, or not where they belong.
#include <gnomon/BoxShadow.h>
#include <gnomon/TerrainGround.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>

#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/PolygonOffset>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osg/Stencil>
#include <support/Causes.h>
#include <support/DiscShadow.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// A house of 2 × 2 and 3 high.
osg::ref_ptr<osg::Node> house() { return test::node(test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0}), "house"); }

/// On a ground of 40 × 40.
osg::ref_ptr<osg::Geometry> boxAlone(const gnomon::BoxShadowObject& object, const osg::Vec4d& light,
                                     double half = 20.0) {
    const osg::ref_ptr<osg::Node> ground = test::node(test::square(half), "ground");
    return gnomon::boxShadow(object, *gnomon::groundOf(*ground), light);
}

const osg::Vec3Array& cornersOf(const osg::Geometry& geometry) {
    return static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
}

double areaOf(const osg::Geometry& shadow) {
    double sum = 0.0;
    const osg::Vec3Array& t = cornersOf(shadow);
    for (std::size_t i = 0; i + 2 < t.size(); i += 3) sum += 0.5 * double(((t[i + 1] - t[i]) ^ (t[i + 2] - t[i])).z());
    return sum;
}

const test::View above = test::fromAbove(8.0, 160); // ten pixels a unit

int darkened(const test::Picture& with, const test::Picture& without) { return with.different(without); }

} // namespace

TEST(BoxShadowAlone, IsTwelveTrianglesAndKeepsItsLifts) {
    const auto shadow = boxAlone({house()}, sun);
    ASSERT_TRUE(shadow);
    EXPECT_EQ(cornersOf(*shadow).size(), 36u);
    EXPECT_NEAR(shadow->getBoundingBox().zMax(), 0.1, 1e-6) << "midpoints, as published";
    const auto higher = boxAlone({house(), {}, 0.0, {{-1.0, -1.0, 0.0}, {1.0, 1.0, 6.0}}}, sun);
    EXPECT_GT(areaOf(*higher), areaOf(*shadow) + 2.0) << "bounds that were given count";
}

TEST(BoxShadowAlone, IsWhereItsObjectStands) {
    const auto shadow = boxAlone({house(), {5.0, -7.0, 0.0}, 90.0}, sun);
    ASSERT_TRUE(shadow);
    EXPECT_NEAR(shadow->getBoundingBox().xMin(), 5.0 - 1.0 - 3.0, 1e-5);
    EXPECT_NEAR(shadow->getBoundingBox().center().y(), -7.0, 1e-5);
}

/// ARL-TN-156's class ignores transforms in the caster, drops vertices by sign and divides by their coordinates, skips the
/// last of each range: a house beside its own origin, under a transform, one corner at 0.
TEST(BoxShadowAlone, TakesEveryVertexWhereItStands) {
    const osg::Vec4d light(1.0, 0.5, 1.0, 0.0);
    const auto still = boxAlone({house()}, light);
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(-5.0, -5.0, 0.0));
    moved->addChild(test::node(test::box({5.0, 5.0, 0.0}, {7.0, 7.0, 3.0})));
    const auto shadow = boxAlone({moved, {-1.0, -1.0, 0.0}}, light);
    ASSERT_TRUE(still && shadow);
    ASSERT_EQ(cornersOf(*shadow).size(), cornersOf(*still).size());
    for (std::size_t i = 0; i < cornersOf(*still).size(); ++i)
        EXPECT_LT((cornersOf(*shadow)[i] - cornersOf(*still)[i]).length(), 1e-5) << i;
}

/// Its rays are 500 long whatever the scene.
TEST(BoxShadowAlone, ReachesAsFarAsTheLightDoes) {
    const auto shadow = boxAlone({house()}, {500.0, 0.0, 1.0, 0.0}, 2000.0);
    ASSERT_TRUE(shadow);
    EXPECT_NEAR(shadow->getBoundingBox().xMin(), -1.0 - 1500.0, 1e-2);
}

/// It clones the caster and never frees the clone.
TEST(BoxShadowAlone, DoesNotKeepItsObject) {
    const osg::ref_ptr<osg::Node> object = house();
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(boxAlone({object}, {1.0, 0.01 * i, 1.0, 0.0}));
    EXPECT_EQ(object->referenceCount(), 1);
    EXPECT_EQ(object->getNumParents(), 0u);
}

TEST(BoxShadowAlone, IsDrawnAsTransparentGeometryWithoutAGroup) {
    Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
    const test::Picture plain = test::render(scene.root, above);
    osg::ref_ptr<osg::Geode> shadow = new osg::Geode;
    shadow->addDrawable(boxAlone({house()}, sun));
    scene.content->addChild(shadow);
    const test::Picture picture = test::render(scene.root, above);
    EXPECT_EQ(darkened(picture, plain), 30 * 20) << "3 by 2 are seen beside the house";
    const unsigned dark = picture.at(80 - 30, 80) & 0xff;
    EXPECT_NEAR(dark, 0.5 * test::litGround, 1.0);
}

TEST(BoxShadowAlone, IsNoneWithoutALightAnObjectOrGround) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(boxAlone({house()}, {nan, 0.0, 1.0, 0.0}));
    EXPECT_FALSE(boxAlone({house()}, {1.0, 0.0, -1.0, 0.0}));
    EXPECT_FALSE(boxAlone({}, sun));
    EXPECT_FALSE(boxAlone({house(), {100.0, 0.0, 0.0}}, sun)) << "beside the ground";
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

/// Against rays. What a ridge hides does not shine through it.
TEST(TerrainShadowGeode, IsHiddenBehindARidge) {
    const test::View low = test::perspective({60.0, -60.0, 14.0}, {60.0, 60.0, 4.0}, 400, 200, 40.0, 1.0, 400.0);
    osg::ref_ptr<TerrainShadowGeode> hull = new TerrainShadowGeode;
    osg::ref_ptr<gnomon::TracedShadowTechnique> rays = new gnomon::TracedShadowTechnique;
    Scene plain = behindARidge(nullptr), traced = behindARidge(nullptr);
    rays->setReceiver({traced.content->getChild(0)});
    traced.addShadow(rays);
    const test::Picture right = test::render(traced.root, low);
    const int dark = right.different(test::render(plain.root, low));
    EXPECT_GT(dark, 1000);
    EXPECT_LE(test::render(behindARidge(hull).root, low).different(right), dark / 50); // edges through a pixel's middle
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

/// The shadow is found on the finest ground, a slope, and falls on whichever is drawn, where that is.
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
    // 3 high over x = 1 … -1, where the slope is x / 5: it ends at x = -1 - (3 - x / 5), that is at -5.
    EXPECT_EQ(std::count(fine.begin(), fine.end(), true), 40 * 20);
    EXPECT_EQ(std::count(coarse.begin(), coarse.end(), true), 50 * 20) << "5 over the level of -2";
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
        scene.addShadow(shadowOn(storeys, TerrainShadowGeode::HULL));
        Scene plain = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
        EXPECT_EQ(darkened(test::render(test::reserving(scene.root, reserved), above), test::render(plain.root, above)),
                  30 * 20)
            << reserved;
    }
}

// Solids end a twentieth of a shadow's size below the ground, and half of it where what is drawn may lie deeper.
TEST(TerrainShadowGeode, ReachesAGroundThatIsPushedBackBetweenTwoFrames) {
    Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})}, 20.0, sun);
    const test::Picture plain = test::render(scene.root, above);
    osg::Node* ground = test::find(*scene.root, "ground");
    scene.addShadow(shadowOn(ground, TerrainShadowGeode::HULL));
    test::Camera camera(scene.root, above);
    EXPECT_EQ(darkened(camera.frame(), plain), 30 * 20) << "3 by 2 are seen beside the house";
    // As far as a unit, or two, for a driver's step may be two of the depth buffer's, as llvmpipe's is.
    const float steps = float(1 << 24) / 99.0f; // of a view from 1 to 100
    ground->getOrCreateStateSet()->setAttributeAndModes(new osg::PolygonOffset(0.0f, steps));
    const int deeper = darkened(camera.frame(), plain);
    EXPECT_TRUE(deeper == 40 * 20 || deeper == 50 * 20) << deeper << ": so much lower it is as much longer";
    ground->getStateSet()->removeAttribute(osg::StateAttribute::POLYGONOFFSET);
    EXPECT_EQ(darkened(camera.frame(), plain), 30 * 20);
}

/// A deck 0.8 over the ground, beside a box 2 high in a sun of 45 degrees: the shadow ends at x = -3 on the ground, on the deck
/// at x = -2.2. Seen from above.
TEST(TerrainShadowGeode, OnADeckIsTheDecks) {
    const auto darkIn = [&](double deck) {
        Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})}, 20.0, sun);
        osg::ref_ptr<osg::Group> storeys = new osg::Group;
        osg::Node* ground = test::find(*scene.root, "ground");
        storeys->addChild(ground);
        storeys->addChild(test::node(test::quad({-6.0, -0.9, deck}, {3.7, 0.0, 0.0}, {0.0, 1.8, 0.0})));
        scene.content->replaceChild(ground, storeys);
        const test::Picture plain = test::render(scene.root, above);
        scene.addShadow(shadowOn(storeys, TerrainShadowGeode::HULL));
        const test::Picture picture = test::render(scene.root, above);
        int dark = 0;
        for (int x = 0; x < 80 - 23; ++x) dark += picture.at(x, 80) != plain.at(x, 80); // to x = -2.3
        return dark;
    };
    EXPECT_EQ(darkIn(-0.5), 7) << "under the ground: from -3 to -2.3, ten pixels a unit";
    EXPECT_EQ(darkIn(0.8), 0);
    EXPECT_EQ(darkIn(0.2), 5) << "to -2.8";
}

namespace {

std::vector<std::string> causesOf(Scene& scene, osg::Node* terrain, TerrainShadowGeode::Method method) {
    osg::ref_ptr<TerrainShadowGeode> shadow = new TerrainShadowGeode;
    shadow->setMethod(method);
    shadow->setReceiver({terrain});
    scene.addShadow(shadow);
    test::render(scene.root, above);
    return test::causesButLitSurfaces(*shadow);
}

/// Two slopes of 40 by 40 that meet in a ridge, and a house on them or out of sight.
std::vector<std::string> causesOnRoof(double degrees, const osg::Vec4d& light, double house = 0.0) {
    Scene scene = test::scene(light);
    osg::ref_ptr<osg::Group> roof = new osg::Group;
    roof->setName("ground");
    for (const double side : {-1.0, 1.0}) {
        osg::ref_ptr<osg::MatrixTransform> slope =
            new osg::MatrixTransform(osg::Matrixd::translate(20.0 * side, 0.0, 0.0) *
                                     osg::Matrixd::rotate(osg::DegreesToRadians(degrees * side), osg::Y_AXIS));
        slope->addChild(test::node(test::square(20.0)));
        roof->addChild(slope);
    }
    scene.content->addChild(roof);
    scene.content->addChild(test::node(test::box({-1.0, house - 1.0, -3.0}, {1.0, house + 1.0, 3.0})));
    return causesOf(scene, roof, TerrainShadowGeode::HULL);
}

bool saysThatTheTerrainMayBeTurnedAway(const std::vector<std::string>& causes) {
    return causes.size() == 1 && causes[0].find("the terrain may be turned away from the light") != std::string::npos;
}

/// A roof of 30° may be in its own shadow below 30° alone; a slope that looks at the sun is told of, too.
TEST(TerrainCauses, SaysWhereTheTerrainsShadowOnItselfMayBeMissing) {
    const auto sunAt = [](double x, double y, double degrees) {
        const double elevation = osg::DegreesToRadians(degrees);
        return osg::Vec4d(3.0 * x * std::cos(elevation), 3.0 * y * std::cos(elevation), 3.0 * std::sin(elevation), 0.0);
    };
    for (const osg::Vec4d& light : {sunAt(1.0, 0.0, 28.0), sunAt(0.0, 1.0, 28.0)}) {
        EXPECT_TRUE(saysThatTheTerrainMayBeTurnedAway(causesOnRoof(30.0, light))) << light.x();
        EXPECT_TRUE(saysThatTheTerrainMayBeTurnedAway(causesOnRoof(30.0, light, 300.0))) << "the house is out of sight";
        EXPECT_TRUE(causesOnRoof(0.0, light).empty()) << "flat";
    }
    for (const osg::Vec4d& light : {sunAt(1.0, 0.0, 32.0), sunAt(0.0, 1.0, 32.0)})
        EXPECT_TRUE(causesOnRoof(30.0, light).empty()) << light.x();
}

/// From a lamp 9 above a ridge at 30° no slope is turned away nearer than 9 / tan 30° = 15.6; the roof ends at 20 and 34.6.
TEST(TerrainCauses, SaysThatALampMayBeTooFarFromSteepTerrain) {
    EXPECT_TRUE(saysThatTheTerrainMayBeTurnedAway(causesOnRoof(30.0, {0.0, 0.0, 9.0, 1.0})));
    EXPECT_TRUE(causesOnRoof(0.0, {0.0, 0.0, 9.0, 1.0}).empty()) << "flat";
    EXPECT_TRUE(causesOnRoof(30.0, {0.0, 0.0, 36.0, 1.0}).empty()) << "36 / tan 30° = 62, and a corner is at 40";
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
