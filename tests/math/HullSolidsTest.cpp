// SPDX-License-Identifier: MIT
// Shadows of boxes, L-shapes and tanks on terrain, as the solids that are drawn, against rays in double that share nothing
// with them; and whatever can go wrong.
#include "GroundTriangles.h"
#include <support/TerrainTrial.h>

#include <gtest/gtest.h>

#include <iostream>
#include <limits>

using gnomon::Ground;
using gnomon::HeightPyramid;
using gnomon::HullGround;
using gnomon::HullOutcome;
using gnomon::HullPart;
using gnomon::HullSolids;
using test::boxAt;
using test::figures;
using test::groundOf;
using test::hills;
using test::hullMethod;
using test::Prism;
using test::prismsOn;
using test::sunAt;

namespace {

constexpr int posts = 160;

/// A step of 20 m along x = 600, half a pitch wide.
double cliff(double x, double) { return x < 600.0 ? 20.0 : 0.0; }

HeightPyramid level(double side = 1600.0, const glm::dvec2& origin = glm::dvec2(0.0)) {
    return HeightPyramid({{2, 2, origin, glm::dvec2(side)}, std::vector<float>(4, 3.0f)});
}

glm::dvec4 sun(double azimuth, double elevation) { return glm::dvec4(sunAt(azimuth, elevation), 0.0); }

HullSolids solidsOf(const Ground& ground, const std::vector<gnomon::ConvexPart>& from, const glm::dvec4& light,
                    const glm::dvec3& origin = {800.0, 800.0, 3.0}) {
    std::vector<HullPart> parts;
    for (const gnomon::ConvexPart& part : from) parts.emplace_back(part);
    return hullSolids(HullGround(ground), parts, light, origin);
}

HullOutcome outcomeOf(const HullSolids& solids) {
    for (std::size_t i = 0; i < solids.outcomes.size(); ++i)
        if (solids.outcomes[i] > 0) return HullOutcome(i);
    return HullOutcome::cast;
}

/// Intersection over union.
double overlap(const Ground& ground, const Prism& prism, const glm::dvec4& light, int points = 4000) {
    return judge(ground, prism, light, {{"hull", hullMethod()}}, points).at(0).overlap();
}

/// Half of a degree of 0.001 is for rays through an edge.
constexpr double exact = 0.9995;

TEST(HullSolids, OfFourHundredObjectsOnHillsKeepToTheTruth) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto prisms = prismsOn(ground, glm::dvec2(300.0), glm::dvec2(1290.0), 400, 1);
    test::printHead(std::cout);
    for (const double elevation : {60.0, 30.0, 10.0, 4.0}) { // the last one is lower than hills are steep
        const auto places = elevation > 5.0 ? test::Places::all : test::Places::sunlit;
        const auto found =
            figures(ground, prisms, elevation, {{"box", test::boxMethod()}, {"hull", hullMethod()}}, 1600, places);
        test::printRow(std::cout, elevation, "box", found[0]);
        test::printRow(std::cout, elevation, "hull", found[1]);
        EXPECT_NEAR(found[0].pooled, 0.88, 0.03) << "else what the published method cannot do is gone";
        EXPECT_GE(found[1].pooled, exact) << elevation;
        EXPECT_GE(found[1].fifth, exact) << elevation;
        EXPECT_LE(found[1].triangles, 40.0) << elevation;
        EXPECT_GE(found[1].rays, 100000);
    }
}

TEST(HullSolids, AreTheSameOnTrianglesAsOnTheGridThatTheyWereCutFrom) {
    const HeightPyramid grid = groundOf(hills, 60);
    const gnomon::TriangleGround triangles = test::LooseTriangles(test::trianglesOf(grid.field())).ground();
    for (const Prism& prism : prismsOn(grid, glm::dvec2(150.0), glm::dvec2(440.0), 40, 2))
        EXPECT_GE(overlap(triangles, prism, sun(77.0, 25.0), 1000), exact);
}

TEST(HullSolids, OfASunStraightOverheadAreTheFootprint) {
    const HeightPyramid ground = level();
    const Prism house = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.3, -20.0, 23.0);
    for (const double off : {0.0, 1e-12, 1e-6}) {
        const HullSolids drawn = solidsOf(ground, house.parts(), {off, 0.0, 1.0, 0.0});
        int inside = 0;
        for (int i = 0; i < 10000; ++i)
            inside += drawn.around({790.0 + 0.2 * (i % 100) + 0.0123, 790.0 + 0.2 * (i / 100) + 0.0077, 3.0});
        EXPECT_NEAR(inside * 0.04, 160.0, 1.0) << off;
    }
}

TEST(HullSolids, AreRightDownToALowSun) {
    const HeightPyramid flat = level(20000.0, glm::dvec2(-10000.0));
    for (const double elevation : {0.5, 1.0, 3.0, 8.0})
        EXPECT_GE(figures(flat, prismsOn(flat, glm::dvec2(0.0), glm::dvec2(100.0), 24, 2), elevation,
                          {{"hull", hullMethod()}}, 2000)[0]
                      .least,
                  exact)
            << elevation;
}

/// Where one polygon on the ground would not be right.
TEST(HullSolids, AreRightOverBordersHolesAndCliffs) {
    const auto strip = [](double x, double y) { return x == 840.0 && y >= 700.0 && y < 900.0 ? NAN : 0.0; };
    const HeightPyramid holes = groundOf(strip, posts), step = groundOf(cliff, posts);
    const struct {
        const char* name;
        const Ground& ground;
        Prism house;
        glm::dvec4 sun;
    } cases[] = {{"hole", holes, boxAt({800.0, 800.0}, {6.0, 5.0}, 0.4, -20.0, 20.0), sun(265.0, 20.0)},
                 {"over the hole", holes, boxAt({840.0, 800.0}, {6.0, 15.0}, 0.4, -20.0, 20.0), sun(265.0, 20.0)},
                 {"border", holes, boxAt({8.0, 600.0}, {6.0, 5.0}, 0.4, -20.0, 20.0), sun(85.0, 20.0)},
                 {"at the border", holes, boxAt({2.0, 600.0}, {6.0, 5.0}, 0.4, -20.0, 20.0), sun(265.0, 20.0)},
                 {"down a cliff", step, boxAt({585.0, 600.0}, {6.0, 25.0}, 0.6, -40.0, 40.0), sun(265.0, 30.0)},
                 {"up a cliff", step, boxAt({620.0, 600.0}, {6.0, 25.0}, 0.9, -40.0, 30.0), sun(85.0, 60.0)},
                 {"on a cliff", step, boxAt({600.0, 600.0}, {6.0, 25.0}, 0.4, -40.0, 40.0), sun(175.0, 20.0)}};
    for (const auto& it : cases) EXPECT_GE(overlap(it.ground, it.house, it.sun), exact) << it.name;
}

/// A deck 5 m over level ground takes the shadow where the deck is, and the ground under it where the ground is.
TEST(HullSolids, OnADeckAreTheDecks) {
    const gnomon::TriangleGround ground({{-100.0, -100.0, 0.0},
                                         {100.0, -100.0, 0.0},
                                         {100.0, 100.0, 0.0},
                                         {-100.0, 100.0, 0.0},
                                         {-40.0, -10.0, 5.0},
                                         {-15.0, -10.0, 5.0},
                                         {-15.0, 10.0, 5.0},
                                         {-40.0, 10.0, 5.0}},
                                        {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
    const Prism house = boxAt({0.0, 0.0}, {3.0, 3.0}, 0.0, 0.0, 20.0);
    const HullSolids drawn = solidsOf(ground, house.parts(), {1.0, 0.0, 1.0, 0.0}, glm::dvec3(0.0));
    for (const auto& [x, z, isDark] :
         {std::tuple(-22.9, 0.0, true), {-23.1, 0.0, false}, {-17.9, 5.0, true}, {-18.1, 5.0, false}})
        EXPECT_EQ(drawn.around({x, 1.0, z}) != 0, isDark) << x << " " << z;
}

TEST(HullSolids, OfWhatIsHalfBuriedOrFloatsAreRightAndOfWhatIsInTheGroundThereIsNone) {
    const HeightPyramid ground = groundOf(hills, posts);
    const double height = *ground.height(800.0, 800.0);
    const auto house = [&](double base, double roof) {
        return boxAt({800.0, 800.0}, {20.0, 15.0}, 0.4, height + base, height + roof);
    };
    for (const double azimuth : {20.0, 110.0, 200.0, 290.0}) {
        EXPECT_GE(overlap(ground, house(-30.0, 1.0), sun(azimuth, 30.0)), exact) << "half buried";
        EXPECT_GE(overlap(ground, house(8.0, 20.0), sun(azimuth, 30.0)), exact) << "floating";
        const HullSolids none = solidsOf(ground, house(-30.0, -15.0).parts(), sun(azimuth, 30.0));
        EXPECT_EQ(outcomeOf(none), HullOutcome::unseen);
        EXPECT_TRUE(none.corners.empty());
    }
}

/// A pyramid of 40 × 40 m and 40 m, 2 m of it in the ground. 38 × 38 m and 38 m stand out: in a sun over one of its sides, 1 up
/// in 2, the apex' shadow is 57 m off that side.
TEST(HullSolids, OfSlantingWallsInTheGroundAreOfWhatStandsOut) {
    const HeightPyramid ground = level();
    const auto hull = gnomon::convexHull(
        {{780.0, 780.0, 1.0}, {820.0, 780.0, 1.0}, {820.0, 820.0, 1.0}, {780.0, 820.0, 1.0}, {800.0, 800.0, 41.0}});
    const HullSolids drawn = solidsOf(ground, {{*hull, std::nullopt}}, {2.0, 0.0, 1.0, 0.0});
    double dark = 0.0;
    for (int i = 0; i < 400; ++i)
        for (int j = 0; j < 200; ++j) { // beside the pyramid
            const glm::dvec2 p(720.0 + 0.1523 * i, 780.0 + 0.2 * j + 0.031);
            if (p.x < 781.0) dark += 0.1523 * 0.2 * (drawn.around({p, 3.0}) != 0);
        }
    EXPECT_NEAR(dark, 38.0 * 57.0 / 2.0, 10.0);
}

TEST(HullSolids, OfAWallThatBridgesAValleyAreNotTakenForBuried) {
    const HeightPyramid ground = groundOf([](double x, double) { return std::abs(x - 800.0); }, posts);
    const Prism bridge = boxAt({800.0, 800.0}, {30.0, 4.0}, 0.0, 15.0, 20.0); // its ends are in the slopes
    EXPECT_GE(overlap(ground, bridge, sun(180.0, 60.0)), exact);
}

TEST(HullSolids, WithoutGroundOrOfALightThatIsBelowOrNowhereThereIsNone) {
    const HeightPyramid holes({{2, 2, {0.0, 0.0}, {9.0, 9.0}}, std::vector<float>(4, std::nanf(""))}), ground = level();
    const gnomon::TriangleGround nothing({}, {}), one({{0.0, 0.0, 1.0}, {60.0, 0.0, 4.0}, {0.0, 60.0, 2.0}}, {0, 1, 2});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const struct {
        const Ground& ground;
        double at;
        glm::dvec4 light;
        HullOutcome expected;
    } cases[] = {{holes, 4.0, sun(20.0, 30.0), HullOutcome::noGround},
                 {nothing, 4.0, sun(20.0, 30.0), HullOutcome::noGround},
                 {one, 80.0, sun(240.0, 50.0), HullOutcome::noGround}, // beside it
                 {ground, 800.0, sun(30.0, 0.0), HullOutcome::lightBelow},
                 {ground, 800.0, sun(30.0, -20.0), HullOutcome::lightBelow},
                 {ground, 800.0, {800.0, 830.0, 2.0, 1.0}, HullOutcome::lightBelow}, // a lamp under the ground
                 {ground, 800.0, {0.0, 0.0, 0.0, 0.0}, HullOutcome::lightBelow},
                 {ground, 800.0, {nan, 0.0, 1.0, 0.0}, HullOutcome::unseen},
                 {ground, 800.0, {800.0, 830.0, 50.0, nan}, HullOutcome::unseen}};
    for (const auto& [under, at, light, expected] : cases) {
        const HullSolids solids = solidsOf(under, boxAt({at, at}, {2.0, 2.0}, 0.3, 0.0, 23.0).parts(), light);
        EXPECT_EQ(outcomeOf(solids), expected) << at << " " << light.z << " " << light.w;
        EXPECT_TRUE(solids.corners.empty());
    }
}

TEST(HullSolids, OfALampInsideOrInTheRoofAreAllTheGround) {
    const HeightPyramid ground = level();
    const Prism house = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.0, -20.0, 23.0);
    for (const double height : {10.0, house.roof}) {
        const HullSolids solids = solidsOf(ground, house.parts(), {800.0, 800.0, height, 1.0});
        EXPECT_EQ(outcomeOf(solids), HullOutcome::lightInside);
        const HullSolids drawn = solids;
        for (const glm::dvec3& place : {glm::dvec3(1.0, 2.0, 3.0), {1590.0, 10.0, 3.0}, {801.0, 802.0, 3.0}})
            EXPECT_NE(drawn.around(place), 0);
    }
}

TEST(HullSolids, OfARugInTheGroundThereIsNone) {
    const HeightPyramid ground = level();
    const auto rug = [&](double lift) {
        return outcomeOf(solidsOf(ground,
                                  {{*gnomon::convexHull({{800.0, 800.0, 3.0 + lift},
                                                         {810.0, 800.0, 3.0 + lift},
                                                         {810.0, 805.0, 3.0 + lift},
                                                         {800.0, 805.0, 3.0 + lift}}),
                                    std::nullopt}},
                                  sun(30.0, 40.0)));
    };
    EXPECT_EQ(rug(0.0), HullOutcome::unseen);
    EXPECT_EQ(rug(1e-6), HullOutcome::unseen) << "by rounding over the ground";
    EXPECT_EQ(rug(0.01), HullOutcome::cast);
}

TEST(HullSolids, OfALampAreRight) {
    const HeightPyramid ground = groundOf(hills, posts);
    std::vector<test::Share> shares;
    for (const Prism& prism : prismsOn(ground, glm::dvec2(500.0), glm::dvec2(1100.0), 40, 4)) {
        const glm::dvec4 lamp(prism.middle() + glm::dvec2(25.0, -15.0), prism.roof + 20.0, 1.0);
        shares.push_back(judge(ground, prism, lamp, {{"hull", hullMethod()}}, 2000)[0]);
    }
    EXPECT_GE(tally(shares).least, 0.998);
}

TEST(HullSolids, OfALampBelowTheRoofGoOnToTheEndOfTheGround) {
    const HeightPyramid ground = groundOf(hills, posts);
    const double height = *ground.height(800.0, 800.0);
    const Prism house = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.3, height - 20.0, height + 20.0);
    const glm::dvec4 lamp(820.0, 810.0, height + 12.0, 1.0);
    const HullSolids drawn = solidsOf(ground, house.parts(), lamp);
    int shadowed = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec2 p(300.0 + 10.0 * (i % 63), 500.0 + 8.0 * (i / 63));
        const double z = *ground.height(p.x, p.y);
        if (z > lamp.z || house.isUnder(p)) continue; // the truth is of lights above the ground
        const bool expected = house.blocks({p.x, p.y, z}, lamp);
        shadowed += expected;
        EXPECT_EQ(drawn.around({p.x, p.y, z}) != 0, expected) << p.x << " " << p.y;
    }
    EXPECT_GT(shadowed, 300);
}

/// As long as `turn` allows, what was found for one sun is right for another, but for what the silhouette misses.
TEST(HullSolids, FollowASunThatTurnsALittle) {
    const HeightPyramid ground = groundOf(hills, posts);
    for (const Prism& prism : prismsOn(ground, glm::dvec2(400.0), glm::dvec2(1200.0), 60, 3))
        for (const double elevation : {60.0, 25.0, 12.0}) {
            HullSolids solids = solidsOf(ground, prism.parts(), sun(77.0, elevation));
            const double turned = solids.turn / test::degree;
            EXPECT_GT(turned, 0.1);
            const glm::dvec4 now =
                sun(77.0 + 0.7 * turned / std::cos(elevation * test::degree), elevation - 0.7 * turned);
            solids.light = now; // as it is drawn
            const HullSolids drawn = solids;
            const test::Method follows = [&](const auto&, const auto&, const auto&) {
                return test::Found{[&](const glm::dvec3& place) { return drawn.around(place) != 0; }, 0};
            };
            EXPECT_GE(judge(ground, prism, now, {{"follows", follows}}, 1500)[0].overlap(), 0.97) << elevation;
        }
}

TEST(HullSolids, MovedToWorldCoordinatesAreTheSame) {
    const glm::dvec2 far(433000.0, 5410000.0);
    const HeightPyramid near = groundOf(hills, posts), moved = groundOf(hills, posts, 0.0, far);
    for (Prism prism : prismsOn(near, glm::dvec2(400.0), glm::dvec2(1200.0), 40, 3)) {
        const HullSolids expected = solidsOf(near, prism.parts(), sun(77.0, 25.0));
        for (glm::dvec2& corner : prism.outline) corner += far;
        const HullSolids found =
            solidsOf(moved, prism.parts(), sun(77.0, 25.0), glm::dvec3(far, 0.0) + expected.origin);
        ASSERT_EQ(found.vertices.size(), expected.vertices.size());
        for (std::size_t i = 0; i < found.vertices.size(); ++i)
            EXPECT_LT(glm::length(glm::dvec4(found.vertices[i] - expected.vertices[i])), 1e-2)
                << "floats 800 m from their origin";
    }
}

/// Of a town's tile nothing in a layer overlaps, and no place is in more solids than is said.
TEST(HullSolids, OfOneLayerDoNotOverlapAndNoPlaceIsInMoreThanIsSaid) {
    const HeightPyramid ground = groundOf(hills, posts);
    std::vector<gnomon::ConvexPart> parts;
    for (const Prism& prism : prismsOn(ground, glm::dvec2(600.0), glm::dvec2(800.0), 200, 1))
        for (const gnomon::ConvexPart& part : prism.parts()) parts.push_back(part);
    const HullSolids all = solidsOf(ground, parts, sun(77.0, 25.0));
    ASSERT_GT(all.sides.size(), 1u);
    const HullSolids drawn = all;
    std::vector<HullSolids> layers;
    for (std::size_t i = 0; i < all.sides.size(); ++i) {
        HullSolids layer = all;
        layer.corners.clear();
        for (const auto* ends : {&all.sides, &all.ends}) {
            const unsigned before = ends == &all.ends ? all.sides.back() : 0u;
            layer.corners.insert(layer.corners.end(), all.corners.begin() + (i > 0 ? (*ends)[i - 1] : before),
                                 all.corners.begin() + (*ends)[i]);
        }
        layers.emplace_back(layer);
    }
    int most = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 p(560.0 + 5.0 * (i % 50) + 0.3, 580.0 + 6.0 * (i / 50) + 0.2);
        const glm::dvec3 place(p, *ground.height(p.x, p.y));
        int sum = 0;
        for (const HullSolids& layer : layers) {
            EXPECT_TRUE(layer.around(place) == 0 || layer.around(place) == 1);
            sum += layer.around(place);
        }
        EXPECT_EQ(sum, drawn.around(place));
        most = std::max(most, sum);
    }
    EXPECT_GT(most, 3);
    EXPECT_LE(unsigned(most), all.mostOver);
}

/// Half of what the rays say is behind the crest, in the ground's own shadow.
TEST(TerrainTrial, CanLeaveOutWhatTheGroundItselfKeepsTheLightFrom) {
    const HeightPyramid ground = groundOf([](double x, double) { return 100.0 - std::abs(x - 800.0); }, posts);
    const Prism house = boxAt({785.0, 800.0}, {6.0, 6.0}, 0.0, 50.0, 105.0);
    const test::Share all = judge(ground, house, sun(270.0, 30.0), {{"hull", hullMethod()}}, 4000)[0];
    const test::Share sunlit =
        judge(ground, house, sun(270.0, 30.0), {{"hull", hullMethod()}}, 4000, test::Places::sunlit)[0];
    EXPECT_GE(sunlit.overlap(), exact);
    EXPECT_GT(sunlit.either, 20);
    EXPECT_LT(sunlit.either, 0.7 * all.either);
}

} // namespace
