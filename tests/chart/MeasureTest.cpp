// SPDX-License-Identifier: MIT
// Costs, flicker, sweeps and the white copy: what gnomonchart measures beside still pictures.
#include "SmallScene.h"

#include "ChartScene.h"
#include "Contender.h"
#include "FlickerRun.h"
#include "ImageFile.h"
#include "Race.h"
#include "StageViewer.h"
#include "Staging.h"
#include "Sweep.h"

#include <gtest/gtest.h>

#include <osg/AlphaFunc>
#include <osg/Fog>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Texture2D>
#include <osgUtil/TransformCallback>
#include <support/Mesh.h>

#include <cmath>
#include <ctime>
#include <memory>

namespace {

using namespace gnomon::examples;
using gnomon::metrics::FlickerMeter;
using test::peerNamed;
using test::smallYardstick;

/// For the whole process: Mesa asks where it is once.
const ShaderCache& shaders() {
    static const ShaderCache cache;
    return cache;
}

Contender defaultsOf(const std::string& name) { return peerContender(peerNamed(name), "defaults", {}); }

bool never() { return false; }

/// A race to its end.
RaceResults raced(const ChartScene& scene, const std::vector<Contender>& contenders, int frames = 2) {
    return race(scene, contenders, frames, shaders(), [](int, int) { return true; });
}

/// The ground, the house, the sphere: three draws of 2, 12 and more triangles. A map draws them again, analysis of what
/// is drawn once more; ShadowTexture draws all but its receiver again.
TEST(Race, CountsDrawsAndPassesByWhatReachesOpenGL) {
    const std::vector<Contender> all = {defaultsOf("ShadowMap"), defaultsOf("MinimalDrawBounds"),
                                        defaultsOf("ShadowTexture"), plainContender()};
    const RaceResults results = raced(test::smallScene(), all);
    ASSERT_EQ(results.contenders.size(), 4u);
    const unsigned draws[] = {6, 9, 5, 3}, passes[] = {2, 3, 2, 1};
    const std::size_t all3 = smallYardstick().truth().triangles(),
                      triangles[] = {2 * all3, 3 * all3, 2 * all3 - 2, all3};
    for (std::size_t i = 0; i < 4; ++i) {
        ASSERT_TRUE(results.contenders[i].cost) << results.contenders[i].failure;
        EXPECT_EQ(results.contenders[i].cost->draws, draws[i]) << all[i].technique;
        EXPECT_EQ(results.contenders[i].cost->passes, passes[i]) << all[i].technique;
        EXPECT_EQ(results.contenders[i].cost->triangles, triangles[i]) << all[i].technique;
    }
    EXPECT_GT(results.frame, 0.0);
}

/// Without display lists: one quad by its array, one by indices.
TEST(Race, CountsArraysAndElementsToo) {
    ChartScene scene = test::smallScene();
    scene.content = new osg::Group;
    for (const float x : {-3.0f, 1.0f}) {
        osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry({x, 0, 0}, {2, 0, 0}, {0, 2, 0});
        quad->setUseDisplayList(false);
        if (x < 0.0f) quad->setPrimitiveSet(0, new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4)); // else it has indices
        scene.content->addChild(quad);
    }
    const RaceResults results = raced(scene, {plainContender()});
    ASSERT_TRUE(results.contenders[0].cost);
    EXPECT_EQ(results.contenders[0].cost->draws, 2u);
    EXPECT_EQ(results.contenders[0].cost->triangles, 4u);
}

/// A sun's marks, and what takes the light from them, are two calls at least.
TEST(Race, CountsWhatTheMarksOfGnomonDrawToo) {
    const auto begins = [](const std::string& text, const char* with) { return text.rfind(with, 0) == 0; };
    std::vector<Contender> all = {plainContender()};
    for (const Contender& contender : gnomonContenders()) // a technique's first way to relight, and to blend
        if (contender.technique != all.back().technique || begins(contender.setting, "blend")) all.push_back(contender);
    const RaceResults results = raced(test::smallScene(), all);
    const unsigned plain = results.contenders[0].cost->draws;
    for (std::size_t i = 1; i < all.size(); ++i) {
        const bool maps = begins(all[i].technique, "map") || begins(all[i].technique, "auto"); // which takes maps here
        const bool atOnce = maps && begins(all[i].setting, "blend");                           // marks by darkening
        EXPECT_GT(results.contenders[i].cost->draws, plain + (atOnce ? 0 : 1))
            << all[i].technique << ", " << all[i].setting;
    }
}

/// The scene without shadows, and twice in its first frames.
class RepeatingStaging : public PlainStaging {
public:
    RepeatingStaging(const ChartScene& scene, Look look, unsigned learning) : PlainStaging(scene, look) {
        const osg::ref_ptr<osg::Group> again = new osg::Group;
        again->addChild(_content);
        again->setCullCallback(new OnlyFirst(learning));
        _root->addChild(again);
    }

private:
    struct OnlyFirst : osg::NodeCallback {
        explicit OnlyFirst(unsigned frames) : left(frames) {}
        void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
            if (left > 0) --left, traverse(node, visitor);
        }
        unsigned left;
    };
};

/// What is drawn until auto has chosen is not what a user gets.
TEST(Race, CountsDrawsOnlyOnceTwelveFramesAreDrawn) {
    const auto twiceIn = [](unsigned frames) {
        Contender contender = plainContender();
        contender.stage = [frames](const ChartScene& scene, Look look) {
            return std::make_unique<RepeatingStaging>(scene, look, frames);
        };
        return contender;
    };
    const RaceResults results = raced(test::smallScene(), {plainContender(), twiceIn(60), twiceIn(12)});
    const unsigned plain = results.contenders[0].cost->draws;
    EXPECT_EQ(results.contenders[1].cost->draws, 2 * plain);
    EXPECT_EQ(results.contenders[2].cost->draws, plain);
    EXPECT_EQ(results.contenders[2].cost->triangles, results.contenders[0].cost->triangles);
}

/// Takes so much of the processor, whatever else the machine does.
void workFor(double milliseconds) {
    const auto spent = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
    };
    for (const double end = spent() + milliseconds; spent() < end;) {
    }
}

/// The scene without shadows, and work in each frame: more of it once the light has moved.
class LaboriousStaging : public PlainStaging {
public:
    LaboriousStaging(const ChartScene& scene, Look look, double steady, double moving)
        : PlainStaging(scene, look), _work(new Work(steady)), _moving(moving) {
        _root->setCullCallback(_work);
    }
    void setLight(const osg::Vec4d& light) override {
        _work->milliseconds = _moving;
        PlainStaging::setLight(light);
    }

private:
    struct Work : osg::NodeCallback {
        explicit Work(double time) : milliseconds(time) {}
        void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
            workFor(milliseconds);
            traverse(node, visitor);
        }
        double milliseconds;
    };
    const osg::ref_ptr<Work> _work;
    const double _moving;
};

Contender laborious(double steady, double moving) {
    return {"Gnomon", "laborious", "", {}, [=](const ChartScene& scene, Look look) {
                return std::make_unique<LaboriousStaging>(scene, look, steady, moving);
            }};
}

/// Of 20 and 60 ms of work, which a machine may take longer for but never less long. A frame of the scene takes a few.
TEST(Race, TellsWhatEachContenderAddsToThePlainFrameWhileTheLightStandsAndMoves) {
    const std::vector<Contender> all = {plainContender(), laborious(20.0, 60.0), laborious(60.0, 20.0)};
    const RaceResults results = raced(test::smallScene(), all, 3);
    const auto costOf = [&](std::size_t i) { return *results.contenders[i].cost; };
    EXPECT_LT(std::abs(costOf(0).steadyProcessor.median), 20.0) << "the plain scene against itself";
    EXPECT_LT(std::abs(costOf(0).movingProcessor.median), 20.0);
    for (const double time : {costOf(1).steadyProcessor.median, costOf(2).movingProcessor.median}) {
        EXPECT_GT(time, 10.0);
        EXPECT_LT(time, 40.0);
    }
    for (const double time : {costOf(1).movingProcessor.median, costOf(2).steadyProcessor.median})
        EXPECT_GT(time, 50.0);
    for (const AddedTime& time : {costOf(1).steadyWall, costOf(1).movingWall}) {
        EXPECT_LE(time.q1, time.median);
        EXPECT_LE(time.median, time.q3);
    }
}

TEST(Race, StoppedEarlyItKeepsWhatItHas) {
    const auto until = [](int last) { return [last](int done, int) { return done < last; }; };
    const std::vector<Contender> one = {defaultsOf("ShadowMap")};
    EXPECT_FALSE(race(test::smallScene(), one, 4, shaders(), until(0)).contenders[0].cost);
    EXPECT_TRUE(race(test::smallScene(), one, 4, shaders(), until(19)).contenders[0].cost);
}

TEST(Race, AContenderThatFailsIsOutAndTheOthersRun) {
    ChartScene scene = test::smallScene();
    scene.receiver.clear();
    scene.terrain.clear();
    const std::vector<Contender> all = {defaultsOf("ShadowTexture"), defaultsOf("ShadowMap")};
    const RaceResults results = raced(scene, all);
    EXPECT_FALSE(results.contenders[0].cost);
    EXPECT_NE(results.contenders[0].failure.find("names none"), std::string::npos);
    EXPECT_TRUE(results.contenders[1].cost);
}

/// Rays are still wherever the truth is; the map of ViewDependentShadowMap slides over the scene as the camera moves, that
/// of ShadowMap, laid about the whole scene, does not. 1e-3 of energy is a thousandth of the picture's lit range.
TEST(Film, MapsThatFollowTheCameraFlicker) {
    const Film film(smallYardstick(), Film::Motion::CAMERA, 4, never);
    const auto energy = [&](const Contender& contender) {
        Sight sight(contender, smallYardstick().scene());
        return film.measure(sight, never).energy().value();
    };
    EXPECT_LT(energy(gnomonContenders().front()), 1e-3);
    EXPECT_LT(energy(defaultsOf("ShadowMap")), 1e-3);
    EXPECT_GT(energy(defaultsOf("ViewDependent perspective")), 5e-3);
}

/// Edges of Gnomon's map stand still while the camera goes on and turns; those of a coarse ParallelSplitShadowMap swim.
TEST(Film, InEighthsOfAPixelTellsASwimmingMapFromASteadyOne) {
    const Film film(smallYardstick(), Film::Motion::PIXELS, 17, never);
    const auto crawl = [&](const Contender& contender) {
        Sight sight(contender, smallYardstick().scene());
        return film.measure(sight, never).crawlBeyondRays().value();
    };
    EXPECT_LT(crawl(gnomonContender("traced", Receives::EVERYTHING)), 1e-9);
    EXPECT_LT(crawl(gnomonContender("map", Receives::EVERYTHING)), 0.02); // px; as MapStabilityTest has it
    EXPECT_GT(crawl(peerContender(peerNamed("ParallelSplit"), "256", {{"size", "256"}})), 0.05);
}

/// The first object is the ground.
TEST(Film, LooksAtTheFirstObjectsAlone) {
    const Film film(smallYardstick(), Film::Motion::PIXELS, 3, never);
    Sight sight(defaultsOf("ViewDependent perspective"), smallYardstick().scene());
    EXPECT_FALSE(film.measure(sight, never, 0).energy());
    EXPECT_GT(film.measure(sight, never, 1).energy().value(), 0.0);
}

TEST(Sweep, FindsSettingsThatAreNoWorseThanTheDefaults) {
    const Peer& peer = peerNamed("ShadowMap");
    const Settings best = bestSettings(peer, smallYardstick(), SweepWidth::WIDE, [] { return true; });
    const auto scoreOf = [&](const Settings& settings) {
        return score(test::errorsOf(peerContender(peer, "", settings), smallYardstick().scene(), smallYardstick()));
    };
    EXPECT_LE(scoreOf(best), scoreOf({}));
    EXPECT_LT(scoreOf(best), scoreOf({{"size", "512"}, {"polygonOffset", "4,16"}}));
    for (const auto& [name, value] : best) {
        if (name == "ambientBias") continue;
        EXPECT_NE(knobOf(peer, name).fallback, value) << name;
    }
}

TEST(Sweep, StoppedItReturnsTheDefaults) {
    const Settings best = bestSettings(peerNamed("Standard"), smallYardstick(), SweepWidth::WIDE, never);
    EXPECT_TRUE(best.empty());
}

TEST(Sweep, ACatastropheIsNeverBest) {
    gnomon::metrics::ShadowMetrics metrics;
    EXPECT_TRUE(std::isfinite(score(metrics)));
    metrics.catastrophes.allLit = true;
    EXPECT_TRUE(std::isinf(score(metrics)));
}

/// A quad whose texture lets the left half through an alpha test, in red under fog.
ChartScene halfQuad() {
    ChartScene scene = test::smallScene();
    scene.content = new osg::Group;
    osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    const unsigned char texels[] = {255, 255, 255, 255, 255, 255, 255, 0};
    std::copy(texels, texels + 8, image->data());
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    osg::ref_ptr<osg::Material> red = new osg::Material;
    red->setDiffuse(osg::Material::FRONT_AND_BACK, {1, 0, 0, 1});
    osg::StateSet* state = quad->getOrCreateStateSet();
    state->setAttributeAndModes(red);
    state->setAttributeAndModes(new osg::Fog);
    state->setTextureAttributeAndModes(0, texture);
    scene.content->getOrCreateStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    scene.content->addChild(quad);
    return scene;
}

void expectTheLeftHalfWhite(const ChartScene& scene) {
    StageViewer viewer(plainContender().stage(scene, Look::VISIBILITY), scene.camera, StageViewer::Colour::FLOATS);
    viewer.draw();
    const osg::ref_ptr<osg::Image> image = viewer.image();
    const auto at = [&](double x, double y) {
        const osg::Vec3d clip = osg::Vec3d(x, y, 0.0) * scene.camera.view * scene.camera.projection;
        return image->getColor(static_cast<unsigned>((clip.x() * 0.5 + 0.5) * 320.0),
                               static_cast<unsigned>((clip.y() * 0.5 + 0.5) * 240.0));
    };
    const float cosine = static_cast<float>(1.2 / std::sqrt(1.0 + 0.09 + 1.44)); // of the light on level ground
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(at(-2.0, 0.0)[channel], cosine, 1e-5);
        EXPECT_EQ(at(2.0, 0.0)[channel], 0.0f);
    }
}

/// Moves on a step each frame, whatever the clock says.
struct Walk : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        static_cast<osg::MatrixTransform&>(*node).postMult(osg::Matrixd::translate(0.5, 0.0, 0.0));
        traverse(node, visitor);
    }
};

/// OpenSceneGraph's rotor, as a windmill has it, turns by a second's worth in its first frame; the other thing never stops.
TEST(ChartScene, WhatAnimatesStandsStillWhileItIsMeasured) {
    const auto moved = [](osg::NodeCallback* callback, const glm::dvec2& place) {
        const osg::ref_ptr<osg::MatrixTransform> mount = new osg::MatrixTransform;
        mount->addChild(test::node(test::house(place, {3.0, 0.8, 3.0}, 0.0)));
        mount->setUpdateCallback(callback);
        return mount;
    };
    osg::ref_ptr<osg::Group> files = new osg::Group;
    files->addChild(test::node(test::square(5.0), "ground"));
    files->addChild(moved(new osgUtil::TransformCallback({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.9f), {0.0, 0.0}));
    files->addChild(moved(new Walk, {-3.0, 2.0}));
    ViewOptions options;
    options.width = 240;
    options.height = 180;
    const ChartScene scene = chartSceneOf(*files, options);
    const Yardstick yardstick(scene, false);
    Sight sight(gnomonContender("traced", Receives::EVERYTHING), scene);
    for (int frame = 0; frame < 3; ++frame) {
        const auto errors = gnomon::metrics::shadowMetrics(sight.visibility(), yardstick.maps(), yardstick.limits());
        EXPECT_GT(errors.headline.shadow, 100u);
        EXPECT_EQ(errors.headline.falseShadow + errors.headline.falseLit, 0u) << "pair of frames " << frame;
    }
}

TEST(WhiteCopy, KeepsTheShapeAndNothingOfTheLook) {
    const ChartScene scene = halfQuad();
    expectTheLeftHalfWhite(scene);
    EXPECT_TRUE(scene.content->getChild(0)->getStateSet()->getAttribute(osg::StateAttribute::MATERIAL));
}

/// As files have it that texture once what lies below a group, of which only some is cut out.
TEST(WhiteCopy, KeepsATextureThatStandsAboveTheAlphaTest) {
    const ChartScene scene = halfQuad();
    osg::StateSet &above = *scene.content->getStateSet(), &below = *scene.content->getChild(0)->getStateSet();
    const osg::ref_ptr<osg::StateAttribute> texture = below.getTextureAttribute(0, osg::StateAttribute::TEXTURE);
    const osg::ref_ptr<osg::StateAttribute> test = above.getAttribute(osg::StateAttribute::ALPHAFUNC);
    below.removeTextureAttribute(0, osg::StateAttribute::TEXTURE);
    below.removeTextureMode(0, GL_TEXTURE_2D);
    above.removeAttribute(osg::StateAttribute::ALPHAFUNC);
    above.removeMode(GL_ALPHA_TEST);
    above.setTextureAttributeAndModes(0, texture);
    below.setAttributeAndModes(test);
    osg::ref_ptr<osg::Group> beside = new osg::Group; // visited first: its texture is not the quad's
    beside->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D);
    scene.content->insertChild(0, beside);
    expectTheLeftHalfWhite(scene);
}

TEST(WhiteCopy, GivesNormalsToWhatHasNone) {
    ChartScene scene = test::smallScene();
    osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
    quad->setNormalArray(nullptr);
    scene.content = new osg::Group;
    scene.content->addChild(quad);
    const osg::ref_ptr<osg::Group> copy = whiteCopy(*scene.content);
    EXPECT_TRUE(copy->getChild(0)->asGeometry()->getNormalArray());
    EXPECT_FALSE(quad->getNormalArray());
}

} // namespace
