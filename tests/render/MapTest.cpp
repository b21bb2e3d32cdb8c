// SPDX-License-Identifier: MIT
// Shadow maps against the truth image; acne, lights, passes, limits.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/map/DepthMap.h>
#include <gtest/gtest.h>
#include <osg/ContextData>
#include <osg/GLExtensions>

#include <cmath>
#include <iostream>
#include <tuple>

using gnomon::ShadowMapTechnique;
using test::labEight;
using test::Picture;
using test::room;
using test::Scene;
using test::townOfHouses;
using test::TracedCase;

namespace {

osg::ref_ptr<ShadowMapTechnique> mapOf(int size, ShadowMapTechnique::Filter filter = ShadowMapTechnique::BICUBIC) {
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(size);
    technique->setFilter(filter);
    return technique;
}

TEST(Map, IsWrongNowhereButAtEdgesAndThereByAFractionOfAPixel) {
    for (const TracedCase& given : {labEight(), townOfHouses(), room()}) {
        const test::CaseTrial trial(mapOf(2048), given);
        const test::TruthComparison& result = trial.comparison;
        std::cout << given.name << ": " << result << "\n";
        EXPECT_EQ(result.neither, 0) << given.name;
        EXPECT_EQ(result.certain, 0) << given.name << ": a texel is less than a pixel there";
        // An edge that is off by a share of a pixel decides that share of the pixels on it otherwise; a third of a texel
        // that is a third of a pixel is a ninth.
        EXPECT_LE(result.wrong - result.floor, result.edges / 8) << given.name;
        EXPECT_GT(result.shadowed, 5000) << given.name;
        EXPECT_EQ(trial.causes, std::vector<std::string>());
    }
}

/// Pixels of the picture's last column and row, and of the ones before them, that differ from the traced ones.
struct AtTheRim {
    int last = 0, before = 0;
};

AtTheRim differences(const Picture& a, const Picture& b) {
    const auto differ = [&](int x, int y) { return a.at(x, y) != b.at(x, y); };
    AtTheRim result;
    for (int y = 0; y < a.height; ++y) {
        result.last += differ(a.width - 1, y);
        result.before += differ(a.width - 2, y);
    }
    for (int x = 0; x < a.width; ++x) {
        result.last += differ(x, a.height - 1);
        result.before += differ(x, a.height - 2);
    }
    return result;
}

/// A quad of pixels sticks out of such a picture: what it finds there must not count.
TEST(Map, IsRightInTheLastColumnAndRowOfAPictureOfOddSize) {
    TracedCase town = townOfHouses();
    town.view.width = 641;
    town.view.height = 481;
    Scene byMap = town.build(), byRays = town.build();
    byMap.addShadow(mapOf(2048));
    byRays.addShadow(new gnomon::TracedShadowTechnique);
    const AtTheRim found = differences(test::render(byMap.root, town.view), test::render(byRays.root, town.view));
    EXPECT_LE(found.last, found.before + 10) << "before it: " << found.before;
}

int blits = 0;
decltype(osg::GLExtensions::glBlitFramebuffer) realBlit = nullptr;

void countedBlit(GLint x, GLint y, GLint right, GLint top, GLint toX, GLint toY, GLint toRight, GLint toTop,
                 GLbitfield mask, GLenum filter) {
    ++blits;
    realBlit(x, y, right, top, toX, toY, toRight, toTop, mask, filter);
}

/// Counts the blits of a camera's context in `blits`, from 0, while it lives.
struct CountedBlits {
    explicit CountedBlits(test::Camera& camera)
        : gl(*osg::GLExtensions::Get(camera.viewer().getCamera()->getGraphicsContext()->getState()->getContextID(),
                                     false)) {
        realBlit = gl.glBlitFramebuffer;
        gl.glBlitFramebuffer = countedBlit;
        blits = 0;
    }
    ~CountedBlits() { gl.glBlitFramebuffer = realBlit; }
    CountedBlits(const CountedBlits&) = delete;
    CountedBlits& operator=(const CountedBlits&) = delete;

    osg::GLExtensions& gl;
};

/// As an OpenGL without framebuffers to copy between does it.
TEST(Map, IsTheSameWhereDepthsAreNotCopiedMirrored) {
    const TracedCase given = labEight();
    Scene scene = given.build();
    scene.addShadow(mapOf(1024));
    test::Camera camera(scene.root, given.view);
    camera.frame(); // draws the map
    const CountedBlits counted(camera);
    ASSERT_NE(realBlit, nullptr);
    const Picture expected = camera.frame();
    EXPECT_EQ(blits, 1);
    counted.gl.glBlitFramebuffer = nullptr;
    EXPECT_EQ(camera.frame().different(expected), 0);
}

TEST(Map, OfSeveralLightsLookAtOneCopyOfTheDepths) {
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND})
        for (const auto edges : {ShadowMapTechnique::HARD, ShadowMapTechnique::SMOOTH}) {
            Scene scene = labEight().build();
            const osg::ref_ptr<osg::LightSource> second = new osg::LightSource;
            second->getLight()->setLightNum(1);
            second->getLight()->setPosition({0.8f, -0.4f, 1.2f, 0.0f});
            scene.root->addChild(second);
            scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
            const osg::ref_ptr<ShadowMapTechnique> map = mapOf(1024);
            map->setEdges(edges);
            scene.addShadow(map);
            scene.group->setComposite(composite);
            test::Camera camera(scene.root, labEight().view);
            camera.frame(); // draws the maps
            const CountedBlits counted(camera);
            ASSERT_NE(realBlit, nullptr);
            camera.frame();
            EXPECT_EQ(blits, 1) << composite << " " << edges;
        }
}

TEST(Map, EachFilterAndEachSizeIsBetterThanTheOneBefore) {
    const test::Judge town(townOfHouses());
    int before = town.given.view.width * town.given.view.height;
    for (const int size : {256, 1024})
        for (const auto filter :
             {ShadowMapTechnique::NEAREST, ShadowMapTechnique::BILINEAR, ShadowMapTechnique::BICUBIC}) {
            const int wrong = town.compare(town.with(mapOf(size, filter))).wrong;
            EXPECT_LT(wrong, before) << "size " << size << ", filter " << filter;
            before = wrong;
        }
}

// Level sheets beside a box, over it, larger than it is, and behind it as the sun sees them; the last darkens nothing that
// the box does not.
TEST(Map, WhatIsFlatCastsBesideOverAndBehindWhatIsNot) {
    TracedCase given = labEight();
    given.light = test::sunAt(30.0, 50.0);
    given.meshes = {test::square(40.0), test::box({-0.5, -0.5, 0.5}, {0.5, 0.5, 1.5}),
                    test::quad({-2.5, -0.5, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}),
                    test::quad({-0.4, -0.4, 2.0}, {1.6, 0.0, 0.0}, {0.0, 1.6, 0.0}),
                    test::quad({-0.6, -0.3, 0.4}, {0.5, 0.0, 0.0}, {0.0, 0.5, 0.0})};
    const test::TruthComparison result = test::CaseTrial(mapOf(1024), given).comparison;
    EXPECT_EQ(result.neither, 0);
    EXPECT_EQ(result.certain, 0) << "a texel is less than a pixel there";
    EXPECT_GT(result.shadowed, 3000);
}

// What is under a ground is in its shadow; but that takes no texels away from what stands on it.
TEST(Map, AThingThatIsSunkIntoAGroundHasAsSharpAnEdgeAsOneThatStandsOnIt) {
    const auto edgesOff = [](double height) {
        TracedCase given = labEight();
        given.meshes = {test::square(40.0), test::sphere({0.0, 0.0, height}, 1.0, 24)};
        const test::Judge judge(given);
        return judge.edgesOff(judge.with(mapOf(256)));
    };
    const double standing = edgesOff(1.001), sunk = edgesOff(0.7);
    std::cout << "p95 " << standing << " px standing, " << sunk << " px sunk\n";
    EXPECT_LE(sunk, 1.25 * standing); // not the same edge
}

// Level ones, which are left out of the map; MapBiasTest has those that are in it.
TEST(Map, LevelGroundsAreFreeOfAcne) {
    for (const double elevation : {90.0, 45.0, 20.0, 5.0})
        for (const auto& [half, height, near, far, side] :
             {std::tuple(8.0, 3.0, 1.0, 100.0, 1), std::tuple(8.0, 0.5, 4.0, 20.0, 200),
              std::tuple(0.008, 0.003, 0.001, 0.1, 1), std::tuple(500.0, 20.0, 1.0, 2000.0, 1)}) {
            const TracedCase given = test::flatGround(half, height, elevation, near, far, side);
            const Picture lit = test::render(given.build().root, given.view);
            for (const int size : {256, 2048})
                for (const auto filter : {ShadowMapTechnique::NEAREST, ShadowMapTechnique::BICUBIC}) {
                    Scene shadowed = given.build();
                    shadowed.addShadow(mapOf(size, filter));
                    EXPECT_EQ(test::render(shadowed.root, given.view).different(lit), 0)
                        << elevation << " degrees, half side " << half << ", size " << size << ", filter " << filter;
                }
        }
}

TEST(Map, TakesEachOfThreeLightsFromWhereItDoesNotReach) {
    const TracedCase given = labEight();
    const auto picture = [&](gnomon::ShadowTechnique* technique) {
        Scene scene = given.build();
        for (int i = 1; i < 3; ++i) {
            osg::ref_ptr<osg::LightSource> more = new osg::LightSource;
            more->getLight()->setLightNum(i);
            more->getLight()->setPosition(i == 1 ? osg::Vec4(-1.0f, -0.5f, 0.9f, 0.0f) : osg::Vec4(0, -3, 6, 1));
            more->getLight()->setAmbient({0.0f, 0.0f, 0.0f, 1.0f});
            more->getLight()->setDiffuse({0.05f, 0.1f * float(i), 0.1f, 1.0f});
            scene.root->addChild(more);
            scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0 + GLenum(i), osg::StateAttribute::ON);
        }
        if (technique) scene.addShadow(technique);
        test::Camera camera(scene.root, given.view);
        camera.frame();
        return camera.frame();
    };
    const osg::ref_ptr<ShadowMapTechnique> technique = mapOf(2048);
    const Picture mapped = picture(technique), traced = picture(new gnomon::TracedShadowTechnique);
    EXPECT_EQ(test::differingBlocks(mapped, traced), 0);
    EXPECT_GT(test::differingBlocks(mapped, picture(nullptr)), 10000);
    EXPECT_EQ(technique->passes(), 2u + 3u); // in the first of two frames: each sun; the lamp down and to two sides
}

struct Moving : test::MovingCase {
    Moving() : MovingCase(labEight(), test::box({3.0, 3.0, 1.0}, {4.0, 4.0, 2.0}), mapOf(512)) {}
};

/// One pass for a change, one more within eight frames of rest, in which what is kept of frames before is found anew, and none after.
void expectAChange(Moving& moving) {
    EXPECT_EQ(moving.passesInFrame(), 1u);
    unsigned atRest = 0;
    for (int frame = 0; frame < 8; ++frame) atRest += moving.passesInFrame();
    EXPECT_EQ(atRest, 1u);
    EXPECT_EQ(moving.passesInFrame(), 0u);
}

// Each of three suns has a map, and when one of them moves it is its map that is drawn again.
TEST(MapPasses, AreOneWhenOneOfThreeLightsMoves) {
    Moving moving;
    std::vector<osg::ref_ptr<osg::LightSource>> suns;
    for (int i = 1; i < 3; ++i) {
        suns.push_back(new osg::LightSource);
        suns.back()->getLight()->setLightNum(i);
        suns.back()->getLight()->setPosition(osg::Vec4(i == 1 ? -1.0f : 0.5f, 0.8f, 1.0f, 0.0f));
        moving.scene.root->addChild(suns.back());
        moving.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0 + GLenum(i), osg::StateAttribute::ON);
    }
    EXPECT_EQ(moving.passesInFrame(), 3u);
    EXPECT_EQ(moving.passesInFrame(), 0u);
    for (const auto& sun : suns) {
        sun->getLight()->setPosition(osg::Vec4(0.2f, -0.7f, 1.0f, 0.0f));
        expectAChange(moving);
    }
}

TEST(MapPasses, AreOneAndThenNoneUntilACasterMoves) {
    Moving moving;
    EXPECT_EQ(moving.passesInFrame(), 1u);
    for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(moving.passesInFrame(), 0u);
    moving.mover->setMatrix(osg::Matrixd::translate(0.0, -2.0, 0.0));
    expectAChange(moving);
    moving.scene.light->getLight()->setPosition({1.0f, 0.2f, 1.2f, 0.0f});
    expectAChange(moving);
}

// Maps are in coordinates about the middle of all casters, (0, 0, 0.5), from which the lamp is where the sun was: one upwards.
// Behind the box the sun's shadow is under it; the lamp's is three times as wide, [-3, 3] × [-3, 3].
TEST(Map, FollowsASunThatBecomesALamp) {
    Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 1.0})}, 8.0, {0.0, 0.0, 1.0, 0.0});
    scene.addShadow(mapOf(1024));
    test::Camera camera(scene.root, test::fromAbove(4.0)); // 32 pixels a unit
    EXPECT_EQ(camera.frame().count(test::shadowedGround), 0);
    scene.light->getLight()->setPosition({0.0f, 0.0f, 1.5f, 1.0f});
    EXPECT_NEAR(camera.frame().count(test::shadowedGround), 192 * 192 - 64 * 64, 4 * 192) << "a pixel along the edge";
    scene.light->getLight()->setPosition({0.0f, 0.0f, 1.0f, 0.0f});
    EXPECT_EQ(camera.frame().count(test::shadowedGround), 0);
}

/// Textures that a viewer's context was ever asked to make.
unsigned texturesMade(osgViewer::Viewer& viewer) {
    const unsigned context = viewer.getCamera()->getGraphicsContext()->getState()->getContextID();
    return osg::get<osg::TextureObjectManager>(context)->getNumberGenerated();
}

TEST(MapPasses, MakeNoTextureAnewForAShadowThatGrows) {
    Moving moving;
    const auto light = [&](float height) { moving.scene.light->getLight()->setPosition({-1.0f, -1.0f, height, 0.0f}); };
    light(8.0f);
    moving.passesInFrame();
    const unsigned before = texturesMade(moving.camera.viewer());
    for (const float height : {4.0f, 2.0f, 1.0f}) {
        light(height);
        EXPECT_EQ(moving.passesInFrame(), 1u) << height;
    }
    EXPECT_GT(before, 0u);
    EXPECT_EQ(texturesMade(moving.camera.viewer()), before);
}

TEST(MapPasses, AreNoneWhileTheCameraTurnsWithinWhatIsCovered) {
    Moving moving;
    moving.passesInFrame();
    for (int step = 1; step <= 20; ++step) { // 5 degrees in all, of a picture of 53
        moving.look(osg::Matrixd::rotate(osg::DegreesToRadians(0.25 * step), 0.0, 1.0, 0.0));
        EXPECT_EQ(moving.passesInFrame(), 0u) << step;
    }
}

TEST(MapPasses, FollowACameraThatLeavesWhatIsCovered) {
    Moving moving;
    moving.passesInFrame();
    unsigned passes = 0;
    for (int step = 1; step <= 20; ++step) {
        const osg::Vec3d eye(-8.0 + step, -14.0 + step, 10.0 - 0.45 * step);
        moving.camera.setView(test::perspective(eye, {0.0, 0.0, 0.0}, 640, 480));
        passes += moving.passesInFrame();
    }
    EXPECT_LE(passes, 10u);
    TracedCase last = moving.given;
    last.view = test::perspective({12.0, 6.0, 1.0}, {0.0, 0.0, 0.0}, 640, 480);
    EXPECT_EQ(test::CaseTrial(moving.technique, last).comparison.certain, 0);
}

TEST(Map, ASizeBeyondTheDriversIsToldInOneSentence) {
    test::Camera camera(test::groundScene({}).root, test::fromAbove(4.0));
    camera.frame();
    osg::GraphicsContext& context = *camera.context().graphicsContext();
    context.makeCurrent();
    osg::RenderInfo renderInfo(context.getState(), nullptr);
    const osg::ref_ptr<gnomon::DepthMap> map = new gnomon::DepthMap({1 << 20, 16}, osg::Texture::LINEAR);
    const osg::ref_ptr<gnomon::MapPicture> picture = new gnomon::MapPicture;
    const osg::ref_ptr<gnomon::MapPrograms> programs = new gnomon::MapPrograms;
    const std::string cause = map->show(renderInfo, *picture, *programs);
    context.releaseContext();
    EXPECT_NE(cause.find("a map of 1048576 x 16 texels cannot be made"), std::string::npos) << cause;
    EXPECT_EQ(programs->passes, 0u);
}

TEST(Map, TakesOnlyOptionsThatItHas) {
    using Options = gnomon::ShadowMapOptions;
    const Options fresh;
    EXPECT_EQ(std::tuple(fresh.size, fresh.cascades, fresh.edges, fresh.sunAngle, fresh.view, fresh.programUnit),
              std::tuple(1024, 0, Options::HARD, 0.533, Options::NOTHING, -1));
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    const auto kept = [&technique](auto Options::*which, auto asked) {
        Options options;
        options.*which = asked;
        technique->setOptions(options);
        return technique->getOptions().*which;
    };
    for (const auto& [asked, given] : {std::pair(-5, 16), {16, 16}, {300, 300}, {100000, 16384}})
        EXPECT_EQ(kept(&Options::size, asked), given);
    for (const auto& [asked, given] : {std::pair(-5, 0), {1, 1}, {3, 3}, {9, 4}})
        EXPECT_EQ(kept(&Options::cascades, asked), given);
    for (const auto& [asked, given] : {std::pair(5, 5), {31, 31}, {32, -1}, {-7, -1}})
        EXPECT_EQ(kept(&Options::programUnit, asked), given);
    for (const auto& [asked, given] :
         {std::pair(Options::TEXELS, Options::TEXELS), {Options::View(17), Options::NOTHING}})
        EXPECT_EQ(kept(&Options::view, asked), given);
    for (const auto& [asked, given] : {std::pair(-1.0, 0.0), {3.0, 3.0}, {50.0, 20.0}, {double(NAN), 0.0}}) {
        EXPECT_EQ(kept(&Options::sunAngle, asked), given);
        EXPECT_EQ(kept(&Options::lampSize, asked), asked == 50.0 ? 50.0 : given);
        EXPECT_EQ(kept(&Options::radius, asked), asked == 50.0 ? 50.0 : given);
    }
    technique->setCascades(9);
    EXPECT_EQ(osg::ref_ptr(osg::clone(technique.get()))->getCascades(), 4);
}

} // namespace
