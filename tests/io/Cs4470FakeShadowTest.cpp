// SPDX-License-Identifier: MIT
// cs4470_fakeshadow: its shadow against rays, its sketch's overhead light, its double darkening.
#include "ExampleProgram.h"
#include "Rays.h"

#include <cmath>

namespace {

using namespace gnomon::testing;

class FakeShadow : public ExampleProgram {
protected:
    FakeShadow() : ExampleProgram(CS4470_FAKESHADOW) {}
};

constexpr int width = 640, height = 512;
const osg::Vec3d eye(0.0, 0.0, 200.0), middle(0.0, 0.0, -511.0);

/// The cube of side 100 about (0, 0, -511), turned by 30 degrees about x, then y, then z.
bool meetsCube(const osg::Vec3d& from, const osg::Vec3d& way) {
    const double angle = osg::DegreesToRadians(30.0);
    const osg::Matrixd turn = osg::Matrixd::rotate(angle, osg::X_AXIS) * osg::Matrixd::rotate(angle, osg::Y_AXIS) *
                              osg::Matrixd::rotate(angle, osg::Z_AXIS);
    const osg::Matrixd back = osg::Matrixd::inverse(turn);
    return meetBox((from - middle) * back, way * back, osg::Vec3d(-50, -50, -50), osg::Vec3d(50, 50, 50)) < 1e9;
}

/// Pixels whose line of sight meets the floor, and from there the cube on the way to the light.
Mask shadow(const osg::Vec3d& toLight) {
    const Sights sights = {width, height,
                           osg::Matrixd::lookAt(eye, middle, osg::Vec3d(0, 1, 0)) *
                               osg::Matrixd::perspective(45.0, 1.25, 1.0, 10000.0)};
    return sights.where([&](const osg::Vec3d& from, const osg::Vec3d& way) {
        const double t = (-200.0 - from.y()) / way.y();
        const osg::Vec3d floor = from + way * t;
        const bool inside = t > 0.0 && std::abs(floor.x()) < 250.0 && std::abs(floor.z() + 511.0) < 250.0;
        return inside && !meetsCube(from, way) && meetsCube(floor, toLight);
    });
}

/// 40 % black over a checkerboard of white and 51.
bool isDark(const osg::Vec3d& color, int times) {
    const double factor = std::pow(0.6, times);
    return apart(color, osg::Vec3d(1, 1, 1) * 255.0 * factor) < 1.6 ||
           apart(color, osg::Vec3d(1, 1, 1) * 51.0 * factor) < 1.6;
}

Mask dark(const osg::Image& image, int times) {
    return maskOf(image, [times](const osg::Vec3d& color) { return isDark(color, times); });
}

const osg::Vec3d light(std::cos(osg::DegreesToRadians(35.0)) * std::cos(osg::DegreesToRadians(65.0)),
                       std::sin(osg::DegreesToRadians(65.0)),
                       std::sin(osg::DegreesToRadians(35.0)) * std::cos(osg::DegreesToRadians(65.0)));

} // namespace

TEST_F(FakeShadow, DarkensTheFloorByFortyPercentWhereRaysAreBlocked) {
    const Mask rays = shadow(light);
    EXPECT_GT(count(rays), 500);
    EXPECT_EQ(misplaced(dark(*picture({}), 1), rays, width), 0);
}

TEST_F(FakeShadow, ScalesByZeroForALightOverhead) {
    const Mask rays = shadow({0.0, 1.0, 0.0});
    EXPECT_GT(count(rays), 500);
    EXPECT_EQ(misplaced(dark(*picture({"--keys", "k"}), 1), rays, width), 0);
}

// A ray through a cube goes in at one face and out at another.
TEST_F(FakeShadow, DarkensTwiceAsTheNotesDoOnDemand) {
    const auto twice = picture({"--keys", "x"});
    EXPECT_EQ(misplaced(dark(*twice, 2), shadow(light), width), 0);
    EXPECT_LT(count(dark(*twice, 1)), 60) << "the edges";
    EXPECT_EQ(count(dark(*picture({"--keys", "xx"}), 2)), 0);
}

TEST_F(FakeShadow, TurnsTheCubeAFrameAtATime) {
    const auto still = picture({"--frames", "5"}), turned = picture({"--keys", "j", "--frames", "5"});
    EXPECT_EQ(count(differing(*still, *picture({}))), 0);
    EXPECT_GT(count(differing(*turned, *still)), 500);
}

TEST_F(FakeShadow, KeysAndMouseChangeTheShadow) {
    open();
    const auto darkIn = [](const Screenshot& p, std::uint32_t pixel) {
        return std::count(p.pixels.begin(), p.pixels.end(), pixel);
    };
    EXPECT_GT(darkIn(first, 0x999999u), 200) << "0.6 of white";
    const Screenshot twice = pressed("x");
    EXPECT_GT(darkIn(twice, 0x5c5c5cu), 200) << "0.36 of white";
    EXPECT_EQ(pressed("x"), first);
    expectSwitches({"k"});
    const Screenshot moved = changed("the middle button", [&] { desktop->drag(2, 40, -20); });
    EXPECT_GT(darkIn(moved, 0x999999u), 200);
    const Screenshot turned = changed("the left button", [&] { desktop->drag(1, 30, 20); });
    EXPECT_GT(darkIn(turned, 0x00ffffu), 1000) << "the background";
    expectMotionAfter("j");
    expectEscapeEndsIt();
}
