// SPDX-License-Identifier: MIT
// gus_shadow: the shadow on a plane from three points against rays.
#include "ExampleProgram.h"
#include "Rays.h"

#include <osg/BoundingBox>

#include <cmath>

namespace {

using namespace gnomon::testing;

class GusShadow : public ExampleProgram {
protected:
    GusShadow() : ExampleProgram(GUS_SHADOW) {}
};

constexpr int width = 800, height = 600;

/// A floor given by three corners, a box of side 2/10 of its shorter side 3/10 above its middle, turned by 30 degrees.
struct Place {
    osg::Vec3d a, b, c;

    osg::Vec3d normal() const {
        osg::Vec3d n = (b - a) ^ (c - b);
        n.normalize();
        return n;
    }
    double size() const { return std::min((b - a).length(), (c - b).length()); }

    bool meetsBox(const osg::Vec3d& from, const osg::Vec3d& way, double limit) const {
        const osg::Matrixd place = osg::Matrixd::rotate(osg::DegreesToRadians(30.0), normal()) *
                                   osg::Matrixd::translate((a + c) / 2.0 + normal() * size() * 0.3);
        const osg::Matrixd back = osg::Matrixd::inverse(place);
        const osg::Vec3d half = osg::Vec3d(0.1, 0.1, 0.1) * size();
        return meetBox(from * back, osg::Matrixd::transform3x3(way, back), -half, half) < limit;
    }
};

/// gus_shadow's camera: the scene fills the picture, seen from the south-west and 30 degrees above.
osg::Matrixd clipOf(const Place& place) {
    osg::BoundingBoxd bounds;
    for (const osg::Vec3d& p :
         {place.a, place.b, place.c, (place.a + place.c) / 2.0 + place.normal() * place.size() * 0.5})
        bounds.expandBy(p);
    const double azimuth = osg::DegreesToRadians(215.0), elevation = osg::DegreesToRadians(30.0);
    const double distance = bounds.radius() * 1.15 / std::sin(osg::DegreesToRadians(20.0));
    const osg::Vec3d eye = bounds.center() + osg::Vec3d(std::sin(azimuth) * std::cos(elevation),
                                                        std::cos(azimuth) * std::cos(elevation), std::sin(elevation)) *
                                                 distance;
    return osg::Matrixd::lookAt(eye, bounds.center(), osg::Vec3d(0, 0, 1)) *
           osg::Matrixd::perspective(40.0, double(width) / height, 1.0, 1e4);
}

Mask shadow(const Place& place, const osg::Vec4d& light) {
    return Sights{width, height, clipOf(place)}.where([&](const osg::Vec3d& from, const osg::Vec3d& way) {
        const double t = (place.normal() * (place.a - from)) / (place.normal() * way);
        const osg::Vec3d floor = from + way * t, away = floor - place.a;
        const osg::Vec3d side = place.b - place.a, up = place.c - place.b; // at right angles in these tests
        const double u = (away * side) / side.length2(), v = (away * up) / up.length2();
        if (!(t > 0.0 && u > 0.0 && u < 1.0 && v > 0.0 && v < 1.0) || place.meetsBox(from, way, t)) return false;
        const osg::Vec3d place3(light.x(), light.y(), light.z());
        return place.meetsBox(floor, light.w() == 0.0 ? place3 : place3 - floor, light.w() == 0.0 ? 1e9 : 1.0);
    });
}

/// Ambient light alone: 0.2 of the floor's 0.9 and of its texture's two colours.
Mask unlitFloor(const osg::Image& image) {
    return maskOf(image, [](const osg::Vec3d& color) {
        const double share = 255.0 * 0.2 * 0.9;
        return apart(color, osg::Vec3d(0.75, 0.72, 0.6) * share) < 1.6 ||
               apart(color, osg::Vec3d(0.95, 0.93, 0.85) * share) < 1.6;
    });
}

const Place usual = {{-4.0, -3.0, 0.0}, {4.0, -3.0, 0.0}, {4.0, 3.0, 1.0}};

} // namespace

TEST_F(GusShadow, LiesWhereRaysToTheLightAreBlocked) {
    const Mask rays = shadow(usual, {3.0, -2.0, 6.0, 1.0});
    EXPECT_GT(count(rays), 2000);
    EXPECT_EQ(misplaced(unlitFloor(*picture({})), rays, width), 0);
}

TEST_F(GusShadow, HasNothingToSay) { EXPECT_EQ(run({"--out", "gus.png"}).err, ""); }

TEST_F(GusShadow, LiesOnOtherPlanesToo) {
    const Place level = {{0.0, 0.0, 5.0}, {0.0, -6.0, 5.0}, {9.0, -6.0, 5.0}};
    const Mask rays = shadow(level, {3.0, -4.0, 12.0, 1.0});
    EXPECT_GT(count(rays), 2000);
    EXPECT_EQ(misplaced(unlitFloor(*picture({"--points", "0,0,5,0,-6,5,9,-6,5", "--light", "3,-4,12,1"})), rays, width),
              0);
}

// The article speaks of the light's position, and its matrix is that of the way towards it.
TEST_F(GusShadow, TakesTheLightForAPlaceOrForAWay) {
    const Mask place = shadow(usual, {3.0, -2.0, 6.0, 1.0}), way = shadow(usual, {3.0, -2.0, 6.0, 0.0});
    EXPECT_GT(beyond(place, way) + beyond(way, place), 300);
    EXPECT_EQ(misplaced(unlitFloor(*picture({"--keys", "k"})), way, width), 0);
}

TEST_F(GusShadow, BlendHalvesWhatRelightTakesTheLightFrom) {
    const Mask rays = shadow(usual, {3.0, -2.0, 6.0, 1.0});
    const auto relit = picture({}), blended = picture({"--keys", "r"});
    EXPECT_LE(beyond(differing(*relit, *blended), rays), 60) << "edges";
    EXPECT_EQ(count(unlitFloor(*blended)), 0);
}

TEST_F(GusShadow, KeysAndMouseChangeTheShadow) {
    open();
    expectSwitches({"r", "k"});
    EXPECT_NE(changed("the middle button", [&] { desktop->drag(2, 40, 10); }), first);
    EXPECT_NE(changed("the left button", [&] { desktop->drag(1, 30, 20); }), first);
    expectMotionAfter("j");
    expectEscapeEndsIt();
}
