// SPDX-License-Identifier: MIT
// What its own plane turns away from the light is in shadow, whole; what lies along the light is wholly lit or wholly dark.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

using namespace test;

namespace {

/// 24 houses whose walls lie along x and y.
TracedCase streets(double azimuth) {
    std::vector<Mesh> meshes{square(60.0)};
    for (int i = 0; i < 24; ++i)
        meshes.push_back(house({14.0 * (i % 6) - 35.0, 14.0 * (i / 6) - 21.0}, {9.0, 8.0, 5.0 + i * 7 % 5}, 0.0));
    return {"streets", meshes, sunAt(azimuth, 30.0),
            perspective({-40.0, -60.0, 30.0}, {0.0, -5.0, 0.0}, 640, 480, 40.0, 1.0, 300.0)};
}

/// One normal a corner, the mean of its faces': walls that are turned away are shaded.
void average(osg::Geometry& geometry) {
    const auto& corners = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
    std::map<osg::Vec3, osg::Vec3> sums;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        osg::Vec3 normal = (corners[i + 1] - corners[i]) ^ (corners[i + 2] - corners[i]);
        normal.normalize();
        for (int k = 0; k < 3; ++k) sums[corners[i + k]] += normal;
    }
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    for (const osg::Vec3& at : corners) {
        normals->push_back(sums[at]);
        normals->back().normalize();
    }
    geometry.setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
}

Scene build(const TracedCase& given, bool averaged) {
    Scene scene = given.build();
    for (unsigned i = 0; averaged && i < scene.content->getNumChildren(); ++i)
        average(*scene.content->getChild(i)->asGeode()->getDrawable(0)->asGeometry());
    return scene;
}

/// True where a pixel and all beside it show one plane.
bool isWithin(const gnomon::TruthImage& truth, int x, int y) {
    const gnomon::TruthPixel& here = truth.at(x, y);
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
            const gnomon::TruthPixel& other = truth.at(u, v);
            if (!other.seen() || glm::dot(other.normal, here.normal) < 1.0 - 1e-9 ||
                std::abs(glm::dot(here.normal, other.position - here.position)) > 1e-4)
                return false;
        }
    return here.seen();
}

/// A plane with all that is seen of it: its normal and place, rounded.
using Plane = std::array<long, 4>;
Plane planeOf(const gnomon::TruthPixel& pixel) {
    const double scale = 1e3;
    return {std::lround(scale * pixel.normal.x), std::lround(scale * pixel.normal.y),
            std::lround(scale * pixel.normal.z), std::lround(scale * glm::dot(pixel.normal, pixel.position))};
}

/// Pixels away from edges: turned away and yet lit; lit by rays and yet darkened; and those of planes along the light that are
/// of the rarer of lit and dark on their plane.
struct Wrong {
    int turnedAway = 0, bright = 0, darkened = 0, hatched = 0;
};

Wrong wrongOf(const std::string& spec, const TracedCase& given, const gnomon::TruthImage& truth, bool averaged) {
    const bool blends = spec.find("blend") != std::string::npos;
    Scene lit = build(given, averaged), dark = build(given, averaged), cast = build(given, averaged);
    dark.takeLightAway();
    cast.addShadow(spec);
    const Picture asLit = render(lit.root, given.view), asDark = render(dark.root, given.view),
                  drawn = render(cast.root, given.view);
    Wrong result;
    std::map<Plane, std::array<int, 2>> along;
    for (int y = 1; y + 1 < truth.height; ++y)
        for (int x = 1; x + 1 < truth.width; ++x) {
            const gnomon::TruthPixel& pixel = truth.at(x, y);
            if (!isWithin(truth, x, y) || (!blends && asLit.at(x, y) == asDark.at(x, y))) continue;
            const bool bright = drawn.at(x, y) == asLit.at(x, y);
            if (std::abs(pixel.facing) < 0.003) { // some steps of depth on a wall
                if (pixel.blockerDistance == 0.0 || pixel.facing <= 0.0) ++along[planeOf(pixel)][bright];
            } else if (pixel.facing < 0.0) {
                ++result.turnedAway;
                result.bright += bright;
            } else if (pixel.litCentre && !pixel.undecided && !pixel.isEdge()) {
                result.darkened += !bright;
            }
        }
    for (const auto& [plane, pixels] : along) result.hatched += std::min(pixels[0], pixels[1]);
    return result;
}

const std::pair<const char*, bool> ways[] = {{"map:composite=blend", false}, {"map", true}}; // averaged?

TEST(TurnedAway, WallsAreInShadowWholeUnderBothCompositesAndWithAveragedNormals) {
    for (const double azimuth : {15.0, 8.0, 3.0, 1.0, -8.0}) {
        const TracedCase given = streets(azimuth);
        const gnomon::TruthImage truth = given.truth();
        for (const auto& [spec, averaged] : ways) {
            const Wrong wrong = wrongOf(spec, given, truth, averaged);
            EXPECT_GT(wrong.turnedAway, 15000) << spec << " " << azimuth;
            EXPECT_EQ(wrong.bright, 0) << spec << " " << azimuth;
            EXPECT_EQ(wrong.darkened, 0) << spec << " " << azimuth;
        }
    }
}

// Less than a pixel in a thousand of 57,000: walls of a pixel or two are too small to tell how they lie.
TEST(TurnedAway, WallsAlongTheLightAreWhollyLitOrWhollyDark) {
    for (const double azimuth : {0.1, 0.0, -0.1}) {
        const TracedCase given = streets(azimuth);
        const gnomon::TruthImage truth = given.truth();
        for (const auto& [spec, averaged] : ways) {
            const Wrong wrong = wrongOf(spec, given, truth, averaged);
            EXPECT_LE(wrong.hatched, 57) << spec << " " << azimuth;
            EXPECT_EQ(wrong.darkened, 0) << spec << " " << azimuth;
        }
    }
}

// A slope of 18 degrees that one looks along from below, and a box over it, whose shadow and rim do not count.
TEST(TurnedAway, ASingleSheetSeenFromBehindHasNoSpecks) {
    const double drop = 14.0 * std::tan(osg::DegreesToRadians(18.0));
    for (const double below : {2.0, 1.0, 0.6}) {
        const TracedCase given{
            "slope",
            {quad({-14.0, -14.0, drop}, {28.0, 0.0, -2.0 * drop}, {0.0, 28.0, 0.0}),
             box({0.13, -1.15, 0.78}, {1.5, 0.47, 2.9})},
            {-0.105616, 0.729771, 0.675485, 0.0},
            perspective({-24.0, -4.8, 7.8 - below}, {-0.5, 1.5, 0.17 - 0.2 * below}, 320, 240, 44.0, 4.0, 60.0)};
        const gnomon::TruthImage truth = given.truth();
        Scene lit = given.build(), cast = given.build();
        cast.addShadow("map");
        const Picture asLit = render(lit.root, given.view), drawn = render(cast.root, given.view);
        int sheet = 0, dark = 0;
        for (int y = 1; y + 1 < truth.height; ++y)
            for (int x = 1; x + 1 < truth.width; ++x) {
                const gnomon::TruthPixel& pixel = truth.at(x, y);
                if (!isWithin(truth, x, y) || !(pixel.facing < -0.1) || pixel.blockerDistance > 0.0) continue;
                ++sheet;
                dark += drawn.at(x, y) != asLit.at(x, y);
            }
        EXPECT_GT(sheet, 2000) << below;
        EXPECT_LE(dark, sheet / 500) << below; // beside the box's shadow
    }
}

// A wall before the sun casts nothing; a box behind the left half of it does.
TEST(TurnedAway, AWallThatDoesNotCastIsInNoShadowOfItsOwn) {
    const TracedCase given{
        "wall",
        {quad({-4.0, 0.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, 4.0}), box({-3.0, 1.0, 0.0}, {-1.0, 2.0, 3.0})},
        {0.0, 1.0, 0.5, 0.0},
        perspective({0.0, -12.0, 2.0}, {0.0, 0.0, 2.0})};
    Scene lit = given.build(), cast = given.build();
    cast.content->getChild(0)->setNodeMask(~2u);
    cast.addShadow("map:composite=blend");
    cast.group->setCasters({nullptr, 2u});
    const Picture asLit = render(lit.root, given.view), drawn = render(cast.root, given.view);
    const auto at = [&](const Picture& picture, double x, double z) { // 412 pixels / 12 m
        return picture.at(int(200 + x * 34.3), int(150 + (z - 2.0) * 34.3));
    };
    EXPECT_EQ(at(drawn, 2.0, 1.0), at(asLit, 2.0, 1.0));
    EXPECT_EQ(at(drawn, 2.0, 3.0), at(asLit, 2.0, 3.0));
    EXPECT_NE(at(drawn, -2.0, 1.0), at(asLit, -2.0, 1.0));
}

} // namespace
