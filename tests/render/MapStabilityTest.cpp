// SPDX-License-Identifier: MIT
// Shadow maps while the camera moves: how far edges crawl. And casters far outside the view.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <support/Oracle.h>
#include <support/Panels.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

using gnomon::ShadowMapTechnique;
using namespace test;

namespace {

/// A long box on a ground. The shadow of its upper edge ends on the ground in a line: x = shadowEnd.
constexpr double shadowEnd = -0.5 - 1.0 / 1.2;

TracedCase longBox() {
    return {"long box",
            {square(30.0), box({-0.5, -8.0, 0.0}, {0.5, 8.0, 1.0})},
            {1.0, 0.3, 1.2, 0.0},
            perspective({-10.0, -11.0, 8.0}, {-1.3, 0.0, 0.0}, 480, 360)};
}

/// Pixels from the window's lower left corner.
osg::Vec2d onScreen(const View& view, const osg::Vec3d& place) {
    const osg::Vec3d clip = place * (view.view * view.projection);
    return {(clip.x() + 1.0) / 2.0 * view.width, (clip.y() + 1.0) / 2.0 * view.height};
}

/// How far, in pixels, the shadow reaches beyond its end, on average over 8 m of that: by how many pixels more are dark in
/// a strip about it than have their centres on the shadow's side of the line. A line that is off by a share of a pixel
/// takes that share of the centres along it.
double offset(const Picture& shadowed, const Picture& lit, const View& view) {
    constexpr double half = 4.0, beside = 0.4; // metres
    int more = 0;
    const Sights sights(view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const Sight seen = sights.at(x + 0.5, y + 0.5);
            const glm::dvec3 place = seen.from - seen.way * (seen.from.z / seen.way.z);
            if (std::abs(place.y) > half || std::abs(place.x - shadowEnd) > beside) continue;
            const bool dark = shadowed.at(x, y) != lit.at(x, y);
            more += int(dark) - int(place.x > shadowEnd);
        }
    return more / (onScreen(view, {shadowEnd, half, 0.0}) - onScreen(view, {shadowEnd, -half, 0.0})).length();
}

/// What a walk of 32 frames does to a shadow's edge.
struct Crawl {
    double mean = 0.0, deviation = 0.0; ///< of the offset, pixels.
    unsigned maps = 0;                  ///< drawn.
};

std::ostream& operator<<(std::ostream& out, const Crawl& crawl) {
    return out << "off by " << crawl.mean << " px, deviation " << crawl.deviation << ", " << crawl.maps << " maps";
}

/// @param step  what the eye space of a frame is to that of the first, by its number.
Crawl crawlOf(int size, const std::function<osg::Matrixd(int)>& step) {
    constexpr int frames = 32;
    const TracedCase given = longBox();
    Scene plain = given.build(), scene = given.build();
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(size);
    scene.addShadow(technique);
    Camera lit(plain.root, given.view), shadowed(scene.root, given.view);
    double sum = 0.0, squares = 0.0;
    for (int frame = 0; frame < frames; ++frame) {
        View view = given.view;
        view.view = view.view * step(frame);
        for (Camera* each : {&lit, &shadowed}) each->setView(view);
        const double off = offset(shadowed.frame(), lit.frame(), view);
        sum += off;
        squares += off * off;
    }
    const double mean = sum / frames;
    return {mean, std::sqrt(std::max(0.0, squares / frames - mean * mean)), technique->passes()};
}

// Where the shadow ends a pixel is 3 cm: eighths of it. Of 2048 texels are used as many as are of use, a texel is then about as wide.
osg::Matrixd aside(int frame) { return osg::Matrixd::translate(0.004 * frame, 0.0, 0.0); }
osg::Matrixd ahead(int frame) { return osg::Matrixd::translate(0.0, 0.0, 0.004 * frame); }
osg::Matrixd turned(int frame) { return osg::Matrixd::rotate(osg::DegreesToRadians(0.0139 * frame), 0.0, 1.0, 0.0); }

constexpr double mostCrawl = 0.02; // pixels; the goal

TEST(MapStability, EdgesDoNotCrawlWhileTheCameraMovesAndTurnsByPartsOfAPixel) {
    for (const int size : {64, 2048})
        for (const auto& [name, step] : {std::pair("aside", &aside), {"ahead", &ahead}, {"turned", &turned}}) {
            const Crawl found = crawlOf(size, step);
            std::cout << size << ", " << name << ": " << found << "\n";
            EXPECT_LE(found.deviation, mostCrawl) << size << ", " << name;
        }
}

/// Half a kilometre up-sun of a square stands a tower of 200 m; its shadow crosses the square.
TEST(MapStability, ATowerOfTwoHundredMetresHalfAKilometreUpTheSunCastsIntoAViewThatDoesNotHoldIt) {
    const Mesh ground = square(150.0);
    const std::vector<Mesh> casters{box({500.0, -10.0, 0.0}, {520.0, 10.0, 200.0})};
    const osg::Vec4d sun = sunAt(0.0, 15.0); // the shadow is 746 m long
    for (const osg::Vec3d& eye : {osg::Vec3d(70.0, -5.0, 20.0), osg::Vec3d(0.0, -70.0, 25.0),
                                  osg::Vec3d(60.0, 40.0, 30.0), osg::Vec3d(-40.0, 45.0, 15.0)}) {
        const View view = perspective(eye, {0.0, 0.0, 0.0}, 320, 240, 40.0, 1.0, 400.0);
        Scene lit = groundScene(casters, 150.0, sun), dark = groundScene(casters, 150.0, sun),
              shadowed = groundScene(casters, 150.0, sun);
        dark.takeLightAway();
        const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
        shadowed.addShadow(technique);
        const Mask mask = castRays(ground, casters, sun, view);
        EXPECT_EQ(mask.count(Seen::Caster), 0) << eye.x();
        EXPECT_GT(mask.count(Seen::ShadowedReceiver), 3000) << eye.x();
        constexpr int reach = 2; // a texel is less than a pixel
        const Comparison found =
            compare(render(shadowed.root, view), render(lit.root, view), render(dark.root, view), mask, reach);
        EXPECT_EQ(found.wrongInside, 0) << eye.x();
        EXPECT_EQ(found.wrongAtEdge, 0) << eye.x();
        EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
    }
}

/// Pixels that a picture and another one, taken so many pixels further to the right and up, have otherwise. What is at the sides of
/// either does not count: its neighbours are not seen.
int changedAside(const Picture& before, const Picture& after, int right, int up) {
    int changed = 0;
    for (int y = 1; y < after.height - up - 1; ++y)
        for (int x = 1; x < after.width - right - 1; ++x) changed += after.at(x, y) != before.at(x + right, y + up);
    return changed;
}

// A camera from above that goes on by whole pixels sees every pixel again in the next frame. Hard edges are stairs of texels, and stay
// as they are only where texels do: a map that no longer holds the view is moved by whole texels.
TEST(MapStability, AWalkPastTheMarginOfAMapLeavesHardEdgesWhereTheyAre) {
    constexpr int right = 5, up = 2, frames = 60; // more than a view
    std::vector<Mesh> posts;
    for (int i = 0; i < 400; ++i)
        posts.push_back(
            house({1.3 * (i % 20) - 6.0, 1.1 * (i / 20) - 6.0}, {0.2, 0.1, 0.4 + 0.01 * (i % 7)}, 17.0 * i));
    Scene scene = groundScene(posts, 60.0, sunAt(33.0, 50.0));
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    scene.addShadow(technique);
    View view = fromAbove(4.0, 256);
    Camera camera(scene.root, view);
    Picture before = camera.frame();
    int changed = 0, changedAtOnce = 0;
    const unsigned mapsBefore = technique->passes();
    for (int frame = 0; frame < frames; ++frame) {
        view.view.postMultTranslate(osg::Vec3d(-right, -up, 0.0) / 32.0); // a pixel is a 32nd
        camera.setView(view);
        const Picture after = camera.frame();
        const int now = changedAside(before, after, right, up);
        changed += now;
        changedAtOnce = std::max(changedAtOnce, now);
        before = after;
    }
    const unsigned maps = technique->passes() - mapsBefore;
    std::cout << maps << " maps, " << changed << " pixels in " << frames << " frames, " << changedAtOnce << " in one\n";
    EXPECT_GE(maps, 8u);
    EXPECT_LE(changedAtOnce, 5); // of 60,000: floats round otherwise where the edge of a texel meets a pixel's middle
}

// What is kept of maps goes by the frames before; where nothing moves any more, nothing is.
TEST(MapStability, APictureOfAStillSceneIsTheSameWhateverWasDrawnBefore) {
    for (const TracedCase& given : {test::townOfHouses(), test::longStreet(45.0)}) {
        const auto begun = [&given] {
            Scene scene = given.build();
            scene.addShadow(new ShadowMapTechnique);
            return scene;
        };
        Scene fresh = begun(), used = begun();
        const Picture first = test::render(fresh.root, given.view);
        test::Camera camera(used.root, given.view);
        const osg::ref_ptr<osg::Light> light = used.light->getLight();
        const osg::Vec4d place = light->getPosition();
        light->setPosition({0.2f, -0.6f, 1.0f, 0.0f});
        test::View close = given.view;
        close.view.postMultTranslate(osg::Vec3d(0.0, 0.0, 9.0));
        close.projection = osg::Matrixd::perspective(12.0, 4.0 / 3.0, 0.5, 4000.0);
        camera.setView(close);
        for (int i = 0; i < 3; ++i) camera.frame();
        light->setPosition(place);
        camera.frame();
        camera.setView(given.view);
        const Picture moved = camera.frame();
        for (int i = 0; i < 10; ++i)
            EXPECT_EQ(camera.frame().different(first), 0)
                << given.name << ", frame " << i << ", before it has come to rest " << moved.different(first);
    }
}

// Smooth edges, as of a camera that stops: they step with its last motion, if at all, and never later.
TEST(MapStability, SmoothEdgesStandStillAsSoonAsTheCameraDoes) {
    const TracedCase given = test::townOfHouses();
    Scene scene = given.build();
    scene.addShadow("map:edges=smooth");
    test::View view = given.view;
    test::Camera camera(scene.root, view);
    for (int i = 0; i < 6; ++i) {
        view.view.postMultTranslate(osg::Vec3d(0.0, 0.0, 0.7));
        camera.setView(view);
        camera.frame();
    }
    const Picture first = camera.frame();
    for (int i = 0; i < 10; ++i) EXPECT_EQ(camera.frame().different(first), 0) << "frame " << i;
}

} // namespace
