// SPDX-License-Identifier: MIT
// A whole scene's shadows by one string: what the suffix of file names holds.
#include <gnomon/SceneProps.h>
#include <gnomon/SceneSpec.h>
#include <gnomon/ShadowMapTechnique.h>

#include <gtest/gtest.h>

#include <osg/DisplaySettings>
#include <osg/Geode>
#include <osg/LightSource>
#include <osg/ShapeDrawable>

#include <stdexcept>

namespace {

using namespace gnomon;

std::string refusal(const std::string& text) {
    try {
        parseSceneSpec(text);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

/// A box from -1 to 1 in x and y, from 2 to 4 in z.
osg::ref_ptr<osg::Group> boxScene() {
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box({0, 0, 3}, 2)));
    scene->addChild(geode);
    return scene;
}

osg::ref_ptr<ShadowCasterGroup> shadowed(osg::Node& scene, const std::string& text) {
    return shadowedScene(scene, parseSceneSpec(text));
}

} // namespace

TEST(SceneSpec, IsAutoWithASunWhereNothingIsTold) {
    for (const char* text : {"", "auto", "ground", "nosun"}) {
        const SceneSpec spec = parseSceneSpec(text);
        ASSERT_EQ(spec.shadows.size(), 1u) << text;
        EXPECT_EQ(spec.shadows.front().technique, "auto") << text;
        EXPECT_EQ(spec.hasGround, std::string(text) == "ground") << text;
        EXPECT_EQ(spec.addsSun, std::string(text) != "nosun") << text;
        EXPECT_FALSE(spec.hasSun) << text;
    }
}

TEST(SceneSpec, HoldsItemsWithAPlusBetweenThem) {
    const SceneSpec spec = parseSceneSpec(
        "map:lamp-size=1e+2;receiver=hill+map:edges=soft,size=2048+sun:azimuth=-7.5;elevation=30+ground:side=9");
    ASSERT_EQ(spec.shadows.size(), 2u);
    EXPECT_EQ(spec.shadows[0].technique, "map");
    EXPECT_EQ(spec.shadows[0].map.lampSize, 100.0);
    EXPECT_EQ(spec.shadows[0].receiver, "hill");
    EXPECT_EQ(spec.shadows[1].map.edges, ShadowMapOptions::SOFT);
    EXPECT_EQ(spec.shadows[1].map.size, 2048);
    EXPECT_TRUE(spec.hasSun);
    EXPECT_EQ(spec.sunAzimuth, -7.5);
    EXPECT_EQ(spec.sunElevation, 30.0);
    EXPECT_TRUE(spec.hasGround);
    EXPECT_EQ(spec.groundSide, 9.0);
}

TEST(SceneSpec, RefusesWithThePartThatIsWrongAndWhatIsAllowed) {
    const std::string names = "none, planar, ";
    EXPECT_EQ(refusal("mapp").find("\"mapp\" is neither a shadow technique nor a part of a scene. Allowed: " + names),
              0u);
    EXPECT_NE(refusal("mapp").find(", ground, sun, nosun."), std::string::npos);
    EXPECT_EQ(refusal("map+sun:height=3"), "the item sun has no key \"height\". Allowed: azimuth, elevation.");
    EXPECT_EQ(refusal("nosun:height=3"), "the item nosun has no key \"height\". Allowed: none.");
    EXPECT_EQ(refusal("sun:elevation=91"), "elevation=91 cannot be used. Allowed: -90 to 90.");
    EXPECT_EQ(refusal("sun:elevation"), "elevation= cannot be used. Allowed: -90 to 90.");
    EXPECT_EQ(refusal("ground:side=nan"), "side=nan cannot be used. Allowed: 1e-09 to 1e9.");
    EXPECT_EQ(refusal("sun+map+sun"), "the item \"sun\" is given twice. Give it once.");
    EXPECT_EQ(refusal("sun+nosun"), "sun and nosun cannot be mixed. Give one of them.");
    EXPECT_EQ(refusal("map:edge=smooth").find("the technique map has no key \"edge\"."), 0u);
    EXPECT_EQ(refusal("map+").find("\"\" is neither"), 0u);
}

TEST(ShadowedScene, GivesASceneWithoutLightASunInThePlaceOfTheHeadlight) {
    const auto group = shadowed(*boxScene(), "map+nosun");
    EXPECT_TRUE(lightSourcesIn(*group).empty());
    const auto sunny = shadowed(*boxScene(), "map");
    const auto lights = lightSourcesIn(*sunny);
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0]->getLight()->getLightNum(), 0);
    const osg::Vec4 towards = lights[0]->getLight()->getPosition();
    EXPECT_LT((towards - osg::Vec4(0.5f, -0.5f, float(std::sqrt(0.5)), 0.0f)).length(), 1e-6) << "south-east at 45°";
    EXPECT_EQ(sunny->getStateSet()->getMode(GL_LIGHT0), unsigned(osg::StateAttribute::ON));
    EXPECT_EQ(sunny->getLightSources().size(), 1u);
}

TEST(ShadowedScene, LetsTheScenesOwnLightsCastAlone) {
    const osg::ref_ptr<osg::Group> scene = boxScene();
    osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
    lamp->getLight()->setLightNum(0);
    scene->addChild(lamp);
    const auto group = shadowed(*scene, "map");
    EXPECT_EQ(lightSourcesIn(*group), std::vector<osg::ref_ptr<osg::LightSource>>{lamp});
    ASSERT_EQ(group->getLightSources().size(), 1u);
    const auto both = lightSourcesIn(*shadowed(*scene, "map+sun"));
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[1]->getLight()->getLightNum(), 1) << "the lamp has number 0";
}

TEST(ShadowedScene, HasRoomForASunBesideSevenLights) {
    const osg::ref_ptr<osg::Group> scene = boxScene();
    for (int number = 0; number < 7; ++number) {
        osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
        lamp->getLight()->setLightNum(number);
        scene->addChild(lamp);
    }
    EXPECT_EQ(lightSourcesIn(*shadowed(*scene, "map+sun")).back()->getLight()->getLightNum(), 7);
    osg::ref_ptr<osg::LightSource> eighth = new osg::LightSource;
    eighth->getLight()->setLightNum(7);
    scene->addChild(eighth);
    EXPECT_THROW(shadowed(*scene, "map+sun"), std::invalid_argument);
}

TEST(ShadowedScene, StandsOnAGroundOfFourRadiiWhereOneIsAskedFor) {
    const osg::BoundingBoxd bounds = sceneBounds(*boxScene());
    EXPECT_EQ(bounds._min, osg::Vec3d(-1, -1, 2));
    EXPECT_EQ(sceneBounds(*shadowed(*boxScene(), "map"))._max, osg::Vec3d(1, 1, 4));
    EXPECT_NEAR(sceneBounds(*shadowed(*boxScene(), "planar+ground"))._max.x(), 2.0 * std::sqrt(3.0), 1e-6);
    const osg::Vec3d corner(-3, -3,
                            2 - 1e-4 * std::sqrt(3.0)); // of the radius below the box, so that nothing fights with it
    EXPECT_LT((sceneBounds(*shadowed(*boxScene(), "planar+ground:side=6"))._min - corner).length(), 1e-9);
    EXPECT_THROW(shadowed(*boxScene(), "planar"), std::invalid_argument) << "no ground, no receiver";
}

TEST(ShadowedScene, AsksForTheBitsThatItsShadowsNeed) {
    osg::DisplaySettings& settings = *osg::DisplaySettings::instance();
    settings.setMinimumNumStencilBits(0);
    settings.setMinimumNumAlphaBits(0);
    for (const char* hard : {"map", "map:edges=smooth,filter=nearest", "volume"}) {
        shadowed(*boxScene(), hard);
        EXPECT_EQ(settings.getMinimumNumStencilBits(), 8u);
        EXPECT_EQ(settings.getMinimumNumAlphaBits(), 0u) << hard;
    }
    for (const char* fading : {"map:edges=smooth", "map:edges=soft,filter=nearest", "auto"}) {
        settings.setMinimumNumAlphaBits(0);
        shadowed(*boxScene(), fading);
        EXPECT_EQ(settings.getMinimumNumAlphaBits(), 8u) << fading;
    }
}
