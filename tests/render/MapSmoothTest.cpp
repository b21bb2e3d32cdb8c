// SPDX-License-Identifier: MIT
// Edges of maps that are a pixel wide: the share of a pixel on their lit side, against closed forms and against rays.
#include "TracedCases.h"

#include <glm/geometric.hpp>
#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/Math>
#include <support/Oracle.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using gnomon::ShadowCasterGroup;
using gnomon::ShadowMapTechnique;
using test::Picture;
using test::Scene;
using test::TracedCase;

namespace {

osg::ref_ptr<ShadowMapTechnique> mapWith(ShadowMapTechnique::Edges edges, int size = 1024,
                                         ShadowMapTechnique::Filter filter = ShadowMapTechnique::BICUBIC) {
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(size);
    technique->setEdges(edges);
    technique->setFilter(filter);
    return technique;
}

/// Of the light, by how far a colour is from the dark one.
double shareOf(std::uint32_t color, std::uint32_t dark, std::uint32_t lit) {
    const auto red = [](std::uint32_t c) { return double(c & 0xffu); };
    return (red(color) - red(dark)) / (red(lit) - red(dark));
}

/// A case in which a pixel's share of the light can be told.
struct Shares : test::Judge {
    using Judge::Judge;
    bool tells(int x, int y) const { return int(lit.at(x, y) & 0xffu) - int(dark.at(x, y) & 0xffu) >= 20; }
    double at(const Picture& picture, int x, int y) const {
        return shareOf(picture.at(x, y), dark.at(x, y), lit.at(x, y));
    }
};

} // namespace

// A plate over one half of the ground, cut off at a slant, under a sun at 45 degrees: its shadow is cut off as the plate is, its
// height further on. How far a pixel is from there says how much of it is on the lit side. Of hard edges the root of the mean
// square would be 0.29, that of numbers spread evenly over a pixel.
TEST(MapSmooth, PixelsHaveTheShareThatIsOnTheLitSide) {
    const double half = 4.0, pixel = 2.0 * half / 256.0, height = 1.0;
    for (const auto composite : {ShadowCasterGroup::RELIGHT, ShadowCasterGroup::BLEND})
        for (const auto& [slant, most] : {std::pair(10.0, 0.205), {25.0, 0.14}, {40.0, 0.161}, {65.0, 0.14}}) {
            const double dark =
                composite == ShadowCasterGroup::BLEND ? 0.5 : double(test::shadowedGround) / test::litGround;
            const double angle = osg::DegreesToRadians(slant);
            const glm::dvec3 along(-std::sin(angle), std::cos(angle), 0.0), across(along.y, -along.x, 0.0);
            Scene scene = test::groundScene(
                {test::quad(glm::dvec3(0.0, 0.0, height) - 40.0 * along, 80.0 * along, -40.0 * across)}, 60.0,
                {-1.0, 0.0, 1.0, 0.0});
            scene.addShadow(mapWith(ShadowMapTechnique::SMOOTH));
            scene.group->setComposite(composite);
            scene.group->setDark(float(dark));
            const Picture picture = test::render(scene.root, test::fromAbove(half));
            double squares = 0.0, sum = 0.0, count = 0.0, farOff = 0.0;
            for (int y = 8; y < 248; ++y)
                for (int x = 8; x < 248; ++x) {
                    const glm::dvec3 place((x + 0.5) * pixel - half - height, (y + 0.5) * pixel - half, 0.0);
                    const double beyond = glm::dot(place, across) / pixel;
                    const double share = (double(picture.at(x, y) & 0xffu) / test::litGround - dark) / (1.0 - dark);
                    const double off = share - test::coverage(across, beyond);
                    if (glm::dot(place, across) < -height * across.x) continue; // the plate itself
                    if (std::abs(beyond) > 2.0) farOff = std::max(farOff, std::abs(off));
                    if (std::abs(beyond) > 0.5 * (std::abs(across.x) + std::abs(across.y))) continue;
                    squares += off * off;
                    sum += off;
                    count += 1.0;
                }
            std::cout << slant << " degrees: rms " << std::sqrt(squares / count) << ", mean " << sum / count
                      << ", elsewhere " << farOff << "\n";
            EXPECT_GT(count, 100.0);
            EXPECT_LE(std::sqrt(squares / count), most)
                << slant; // steps of texels of 1.5 pixels, rounded by the filter
            EXPECT_LE(std::abs(sum / count), 0.03) << slant;
            EXPECT_LE(farOff, 0.01) << slant; // rounding of colours
        }
}

TEST(MapSmooth, AreNearerToRaysThanHardEdges) {
    for (const TracedCase& given : {test::labEight(), test::townOfHouses()}) {
        const Shares shares(given);
        const auto off = [&](ShadowMapTechnique::Edges edges, ShadowMapTechnique::Filter filter) {
            return shares.shareOff(shares.with(mapWith(edges, 4096, filter)));
        };
        const double hard = off(ShadowMapTechnique::HARD, ShadowMapTechnique::BICUBIC),
                     smooth = off(ShadowMapTechnique::SMOOTH, ShadowMapTechnique::BICUBIC),
                     fine = off(ShadowMapTechnique::SMOOTH, ShadowMapTechnique::FINE);
        std::cout << given.name << ": hard " << hard << ", smooth " << smooth << ", fine " << fine << "\n";
        EXPECT_LT(fine, 0.6 * smooth) << given.name; // sixteen places, or texels half as wide, alone: 0.86
        EXPECT_LT(smooth, 0.4 * hard) << given.name; // a half more would be that of one comparison a pixel
    }
}

TEST(MapSmooth, NoPixelThatAllRaysAgreeOnIsOnTheOtherSide) {
    for (const auto filter : {ShadowMapTechnique::BILINEAR, ShadowMapTechnique::BICUBIC, ShadowMapTechnique::FINE})
        for (const TracedCase& given : {test::labEight(), test::townOfHouses()}) {
            const Shares shares(given);
            Picture picture = shares.with(mapWith(ShadowMapTechnique::SMOOTH, 2048, filter));
            int between = 0;
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x) {
                    if (!shares.tells(x, y)) continue;
                    const double share = shares.at(picture, x, y);
                    between += share > 0.05 && share < 0.95;
                    picture.pixels[std::size_t(y) * picture.width + x] =
                        (share > 0.5 ? shares.lit : shares.dark).at(x, y);
                }
            EXPECT_GT(between, 100) << filter;
            EXPECT_EQ(shares.compare(picture).certain, 0) << filter << given.name;
        }
}

// Nothing casts here, but either face is before the plane of the other.
TEST(MapSmooth, CornersOfARoomAreFreeOfAcne) {
    const test::Mesh ground = test::quad({-4.0, -4.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 8.0, 0.0}),
                     wall = test::quad({-4.0, 4.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, 3.0});
    int pixels = 0;
    for (const osg::Vec3d& eye : {osg::Vec3d(-3.0, -3.0, 1.7), {0.0, -3.5, 1.7}, {-3.5, 2.0, 1.2}, {3.0, 0.0, 2.5}}) {
        const Shares shares(test::tilted({"corner",
                                          {ground, wall},
                                          {0.3, -1.0, 1.2, 0.0},
                                          test::perspective(eye, {0.5, 4.0, 0.4}, 320, 240, 55.0, 0.1, 30.0)}));
        for (const auto filter : {ShadowMapTechnique::BICUBIC, ShadowMapTechnique::FINE}) {
            const Picture picture = shares.with(mapWith(ShadowMapTechnique::SMOOTH, 4096, filter));
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x) pixels += shares.tells(x, y) && shares.at(picture, x, y) < 0.9;
        }
    }
    EXPECT_LE(pixels, 1);
}

TEST(MapSmooth, FlatGroundsAreFreeOfAcne) {
    for (const double elevation : {90.0, 45.0, 20.0, 10.0, 5.0}) {
        const Shares shares(test::tilted(test::flatGround(8.0, 3.0, elevation, 1.0, 100.0, 20))); // not left out
        for (const auto filter : {ShadowMapTechnique::BILINEAR, ShadowMapTechnique::BICUBIC, ShadowMapTechnique::FINE})
            for (const int size : {64, 256, 2048})
                EXPECT_EQ(shares.with(mapWith(ShadowMapTechnique::SMOOTH, size, filter)).different(shares.lit), 0)
                    << elevation << " degrees, size " << size << ", filter " << filter;
    }
}

// Blocks high over a ground, their shadows out of the picture: pixels of the quad that see the ground say nothing of how a
// block lies.
TEST(MapSmooth, BlocksHaveLittleAcneAtTheirEdges) {
    TracedCase given{"blocks",
                     {test::quad({-300.0, -300.0, -150.0}, {600.0, 0.0, 0.0}, {0.0, 600.0, 0.0})},
                     test::sunAt(140.0, 35.0),
                     test::labEight().view};
    for (int i = 0; i < 16; ++i)
        given.meshes.push_back(test::house({3.5 * (i % 4) - 5.0, 3.5 * (i / 4) - 5.0}, {1.5, 1.2, 1.0}, 7.0 * i));
    const Shares shares(given);
    for (const auto filter : {ShadowMapTechnique::BILINEAR, ShadowMapTechnique::BICUBIC, ShadowMapTechnique::FINE})
        for (const int size : {64, 128, 256, 1024}) {
            const Picture picture = shares.with(mapWith(ShadowMapTechnique::SMOOTH, size, filter));
            int darker = 0, lit = 0;
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x) {
                    lit += shares.tells(x, y);
                    darker += shares.tells(x, y) && shares.at(picture, x, y) < 0.9;
                }
            std::cout << "filter " << filter << ", size " << size << ": " << darker << " of " << lit << "\n";
            EXPECT_LT(darker, 45)
                << size; // at corners both neighbours are of others; by the quad's other pixels alone 134
        }
}

TEST(MapSmooth, WithNearestAreHardEdges) {
    const Shares shares(test::labEight());
    const auto nearest = [&](ShadowMapTechnique::Edges edges) {
        return shares.with(mapWith(edges, 1024, ShadowMapTechnique::NEAREST));
    };
    EXPECT_EQ(nearest(ShadowMapTechnique::SMOOTH).different(nearest(ShadowMapTechnique::HARD)), 0);
}

// Of a slab over a level ground, eight pixels of it and more to a texel: an edge is narrow all the same.
TEST(MapSmooth, AreNarrowWhereATexelIsManyPixels) {
    for (const auto filter : {ShadowMapTechnique::BILINEAR, ShadowMapTechnique::BICUBIC}) {
        Scene scene = test::groundScene({test::quad({-45.0, -40.0, 1.0}, {40.0, 0.0, 0.0}, {8.0, 80.0, 0.0})}, 60.0,
                                        {-1.0, 0.0, 1.0, 0.0});
        scene.addShadow(mapWith(ShadowMapTechnique::SMOOTH, 32, filter));
        const Picture picture = test::render(scene.root, test::fromAbove(4.0));
        const double dark = double(test::shadowedGround) / test::litGround;
        int widest = 0, edges = 0;
        for (int y = 8; y < 248; ++y) {
            int between = 0;
            for (int x = 8; x < 248; ++x) {
                const double share = (double(picture.at(x, y) & 0xffu) / test::litGround - dark) / (1.0 - dark);
                between += share > 0.1 && share < 0.9;
            }
            widest = std::max(widest, between);
            edges += between > 0;
        }
        std::cout << filter << ": " << widest << " in a row at most, in " << edges << " rows\n";
        EXPECT_LE(widest, 4) << filter;
        EXPECT_GT(edges, 100) << filter;
    }
}

// Behind an upright sheet that stands across the view, the sun before it, the ground is dark from its foot on. What a
// comparison allows for of the ground's slope leaves a gap, half a texel where the slope is along one side of the texels.
// Other sheets, farther to the left, say where these begin.
TEST(MapSmooth, LeaveAGapOfHalfATexelWhereASlopeIsAlongOneSide) {
    constexpr double half = 4.0, pixels = 32.0, begin = -3.5; // metres, and pixels of each
    constexpr double size = 36.0, border = 6.0;               // texels of a map, and of these beside what it is of
    constexpr double reserve = 17.0 / 16.0;                   // what it is of, to what is seen: none beyond the casters
    constexpr double texel = reserve * (half - begin) / (size - border); // metres, on the ground
    const auto sheet = [](double x, double from, double to) {
        return test::quad({x, from, 0.0}, {0.0, to - from, 0.0}, {0.0, 0.0, 10.0});
    };
    for (const double elevation : {20.0, 10.0, 5.0}) {
        double gap = 0.0, count = 0.0;
        for (double foot = -2.0; foot < texel - 2.0; foot += 1.0 / pixels) {
            Scene scene =
                test::groundScene({sheet(begin, -40.0, -3.0), sheet(begin, 3.0, 40.0), sheet(foot, -2.0, 2.0)}, 60.0,
                                  test::sunAt(180.0, elevation));
            const Picture lit = test::render(scene.root, test::fromAbove(half));
            scene.addShadow(mapWith(ShadowMapTechnique::SMOOTH, int(size)));
            scene.group->setComposite(ShadowCasterGroup::BLEND);
            scene.group->setDark(0.0f);
            const Picture picture = test::render(scene.root, test::fromAbove(half));
            for (int x = int(std::lround((foot + half) * pixels)); x < 160; ++x)
                gap += shareOf(picture.at(x, 128), 0, lit.at(x, 128)) / pixels / texel;
            count += 1.0;
        }
        std::cout << elevation << " degrees: a gap of " << gap / count << " texels\n";
        EXPECT_NEAR(gap / count, 0.5, 0.12) << elevation; // a pixel; with three quarters of both slopes it was 0.72
    }
}

// Of a view in which 600 texels are of use.
TEST(MapTexels, AreNoMoreThanTheViewNeeds) {
    const Shares shares(test::labEight());
    const auto with = [&](int size) { return shares.with(mapWith(ShadowMapTechnique::SMOOTH, size)); };
    const Picture needed = with(1024);
    EXPECT_EQ(with(8192).different(needed), 0);
    EXPECT_GT(with(128).different(needed), 200);
}

TEST(MapTexels, FollowACameraThatComesNear) {
    const TracedCase given = test::labEight();
    const osg::ref_ptr<ShadowMapTechnique> technique = mapWith(ShadowMapTechnique::HARD, 2048);
    Scene scene = given.build();
    scene.addShadow(technique);
    test::Camera camera(scene.root, given.view);
    for (const double zoom : {1.0, 0.95, 4.0, 1.0}) {
        TracedCase nearer = given;
        nearer.view.projection = given.view.projection * osg::Matrixd::scale(zoom, zoom, 1.0);
        camera.setView(nearer.view);
        const unsigned before = technique->passes();
        const Picture picture = camera.frame();
        EXPECT_EQ(technique->passes() - before, zoom == 0.95 ? 0u : 1u) << zoom;
        EXPECT_EQ(test::Judge(nearer).compare(picture).certain, 0) << zoom;
    }
}

// What a disc of 128 texels reaches is more where there are fewer of them: it is held from the first frame on.
TEST(MapTexels, AreKnownBeforeWhatSoftEdgesReach) {
    TracedCase given = test::labEight();
    given.view.projection *= osg::Matrixd::scale(4.0, 4.0, 1.0); // a part of it is seen, by few pixels
    given.view.width = 40;
    given.view.height = 30;
    const osg::ref_ptr<ShadowMapTechnique> technique = mapWith(ShadowMapTechnique::SOFT, 8192);
    technique->setRadius(2.0);
    Scene scene = given.build();
    scene.addShadow(technique);
    test::Camera camera(scene.root, given.view);
    const Picture first = camera.frame();
    EXPECT_EQ(camera.frame().different(first), 0);
    EXPECT_EQ(technique->passes(), 1u);
}

// What soft edges alone go by changes no map of others.
TEST(MapTexels, StayWhereTheSizeOfALightIsOfNoAccount) {
    const TracedCase given = test::labEight();
    for (const auto edges : {ShadowMapTechnique::HARD, ShadowMapTechnique::SMOOTH, ShadowMapTechnique::SOFT}) {
        const osg::ref_ptr<ShadowMapTechnique> technique = mapWith(edges, 512);
        Scene scene = given.build();
        scene.addShadow(technique);
        test::Camera camera(scene.root, given.view);
        camera.frame();
        const unsigned before = technique->passes();
        technique->setSunAngle(3.0);
        technique->setLampSize(0.5);
        technique->setRadius(0.25);
        camera.frame();
        EXPECT_EQ(technique->passes() > before, edges == ShadowMapTechnique::SOFT) << edges;
    }
}
