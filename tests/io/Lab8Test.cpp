// SPDX-License-Identifier: MIT
// lab8: its two shadows against rays, its questions, its window.
#include "ExampleProgram.h"
#include "Rays.h"

#include <cmath>

namespace {

using namespace gnomon::testing;

class Lab8 : public ExampleProgram {
protected:
    Lab8() : ExampleProgram(LAB8) {}
};

// The handout's scene, y up: a sphere and a cube on y = 0, seen through ortho(-1, 1, -1, 1, -1, 1).

double meetThings(const osg::Vec3d& from, const osg::Vec3d& way) {
    const double cube = meetBox(from, way, {0.25, 0.0, -0.25}, {0.75, 0.5, 0.25});
    return std::min(meetSphere(from, way, {-0.5, 0.25, 0.0}, 0.5), cube);
}

/// Where rays from the ground meet the sphere or the cube before the light.
Mask shadow(const osg::Vec3d& eye, const osg::Vec3d& at, const osg::Vec3d& light) {
    const Sights sights = {
        600, 600, osg::Matrixd::lookAt(eye, at, osg::Vec3d(0, 1, 0)) * osg::Matrixd::ortho(-1, 1, -1, 1, -1, 1)};
    return sights.where([&](const osg::Vec3d& from, const osg::Vec3d& way) {
        const double t = -from.y() / way.y();
        const osg::Vec3d ground = from + way * t;
        if (!(t > 0.0 && t < 1.0) || std::max(std::abs(ground.x()), std::abs(ground.z())) > 2.0) return false;
        const osg::Vec3d above = ground + osg::Vec3d(0.0, 1e-9, 0.0);
        return meetThings(from, way) > t && meetThings(above, light - above) < 1.0;
    });
}

Mask black(const osg::Image& image) {
    return maskOf(image, [](const osg::Vec3d& color) { return color == osg::Vec3d(); });
}

std::string text(const osg::Vec3d& p) {
    return std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z());
}

const osg::Vec3d eye(0.0, 0.1, 0.1), at(0.0, 0.0, 0.0);

} // namespace

TEST_F(Lab8, NodeAndShaderDrawTheRaysShadow) {
    for (const osg::Vec3d& light : {osg::Vec3d(0.0, 5.0, 0.0), osg::Vec3d(1.0, 2.0, 0.5), osg::Vec3d(-0.4, 1.1, 0.9)}) {
        const Mask rays = shadow(eye, at, light);
        const auto node = picture({"--light", text(light)}), shader = picture({"--light", text(light), "--keys", "n"});
        EXPECT_GT(count(rays), 2000);
        // OSG's sphere is of flat pieces, up to two pixels inside the true one; at its foot the shadow is a sliver.
        EXPECT_LE(misplaced(black(*node), rays, 600, 2), 15) << text(light);
        EXPECT_LE(misplaced(black(*shader), rays, 600, 2), 15) << text(light);
        EXPECT_LE(count(differing(*node, *shader)), 30) << "of single precision, at edges; " << text(light);
    }
}

// The sphere's top is at 0.75, the cube's upper vertices at 0.5: what is as high as the light or higher casts nothing.
TEST_F(Lab8, ALightAtOrBelowATopThrowsNoInvertedShadow) {
    for (const double height : {0.75, 0.6, 0.5, 0.3}) {
        const osg::Vec3d light(0.1, height, 0.4);
        const Mask rays = shadow(eye, at, light);
        EXPECT_GT(count(rays), 2000);
        for (const char* keys : {"nnn", "n"})
            EXPECT_LE(misplaced(black(*picture({"--light", text(light), "--keys", keys})), rays, 600, 2), 40)
                << height << " " << keys;
    }
}

TEST_F(Lab8, ALightUnderTheGroundThrowsNoShadow) {
    for (const char* keys : {"nnn", "n", "nn"})
        EXPECT_EQ(count(black(*picture({"--light", "0.2,-1,0.1", "--keys", keys}))), 0) << keys;
}

namespace {

/// What is written and what is then said. Without a display it ends where it would open a window.
Ending answered(const std::string& lines, const std::filesystem::path& folder) {
    return runProgram("sh", {"-c", "printf '" + lines + "' | DISPLAY= '" LAB8 "'"}, folder);
}

int timesIn(const std::string& text, const std::string& part) {
    int times = 0;
    for (std::size_t place = text.find(part); place != std::string::npos; place = text.find(part, place + 1)) ++times;
    return times;
}

} // namespace

TEST_F(Lab8, AsksForThreePointsAndReadsThemAll) {
    const Ending ending = answered("(0.0, 0.1, 0.1)\\n(0.0, 0.0, 0.0)\\n( 0,5 ,0 )\\n", folder.path());
    EXPECT_EQ(ending.out, "Please enter an eye point: Please enter an at point: Please enter a light location: ");
    EXPECT_EQ(ending.status, 1);
    EXPECT_NE(ending.err.find("no window can be opened"), std::string::npos) << "it went on: " << ending.err;
}

TEST_F(Lab8, AsksAgainAfterABadAnswer) {
    for (const char* bad : {"(1,2)", "one,2,3", "(1,2,3", "1 2 3 4", "(nan,0,0)", "1e9,0,0"}) {
        const Ending ending = answered(std::string(bad) + "\\n0,1,1\\n\\n" + bad + "\\n0,5,0\\n", folder.path());
        EXPECT_EQ(timesIn(ending.out, "Please enter an eye point: "), 2) << bad;
        EXPECT_EQ(timesIn(ending.out, "Please enter an at point: "), 1) << "nothing is the handout's answer";
        EXPECT_EQ(timesIn(ending.out, "Please enter a light location: "), 2) << bad;
        EXPECT_EQ(timesIn(ending.out, "That cannot be used. Allowed: 3 numbers"), 2) << ending.out;
        EXPECT_NE(ending.err.find("no window can be opened"), std::string::npos) << ending.err;
    }
}

TEST_F(Lab8, EndOfInputEndsItCleanly) {
    for (const char* lines : {"", "0,1,1\\n", "0,1,1\\n0,0,0\\n", "0,1,1\\nbad"}) {
        const Ending ending = answered(lines, folder.path());
        EXPECT_EQ(ending.status, 0) << lines;
        EXPECT_EQ(ending.err, "") << lines;
    }
}

TEST_F(Lab8, OffscreenWritesAPictureOfItsName) {
    EXPECT_EQ(run({"--offscreen"}).status, 0);
    EXPECT_EQ(folder.list(), Arguments{"lab8.png"});
}

TEST_F(Lab8, KeysAndMouseChangeTheShadow) {
    open({"--eye", "0,0.1,0.1", "--at", "0,0,0", "--light", "1,2,0.5"});
    const auto blackIn = [](const Screenshot& p) { return std::count(p.pixels.begin(), p.pixels.end(), 0u); };
    EXPECT_GT(blackIn(first), 2000);
    const Screenshot shader = pressed("n");
    EXPECT_NEAR(double(blackIn(shader)), double(blackIn(first)), 40.0);
    EXPECT_EQ(blackIn(pressed("n")), 0);
    EXPECT_EQ(pressed("n"), first);
    EXPECT_GT(blackIn(pressed("d")), blackIn(first)) << "a lower light, a longer shadow";
    EXPECT_EQ(pressed("u"), first);
    const Screenshot moved = changed("the middle button", [&] { desktop->drag(2, 60, 0); });
    EXPECT_GT(blackIn(moved), 1000);
    const Screenshot turned = changed("the left button", [&] { desktop->drag(1, 60, 30); });
    EXPECT_GT(blackIn(turned), 1000);
    expectEscapeEndsIt();
}
