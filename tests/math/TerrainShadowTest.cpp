// SPDX-License-Identifier: MIT
// Shadows of boxes, L-shapes and tanks on terrain, in plan, against rays in double; and whatever can go wrong.
#include "Houses.h"

#include <gnomon/ground/TriangleGround.h>
#include <gnomon/onterrain/TerrainShadow.h>
#include <gtest/gtest.h>

#include <iostream>
#include <limits>
#include <set>

using gnomon::Drape;
using gnomon::Ground;
using gnomon::HeightPyramid;
using gnomon::TerrainMethod;
using gnomon::TerrainOutcome;
using gnomon::TerrainShadow;
using gnomon::terrainShadow;
using test::boxAt;
using test::Contestant;
using test::drapeMethod;
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
    return HeightPyramid({2, 2, origin, glm::dvec2(side), std::vector<float>(4, 3.0f)});
}

glm::dvec4 sun(double azimuth, double elevation) { return glm::dvec4(sunAt(azimuth, elevation), 0.0); }

TerrainShadow shadowOf(const Ground& ground, const Prism& prism, const glm::dvec4& light,
                       TerrainMethod method = TerrainMethod::hull, double error = 0.1) {
    return terrainShadow(ground, prism.parts().at(0), light, method, error);
}

/// Intersection over union of what terrainShadow() gives, exact where it is draped.
double overlap(const Ground& ground, const Prism& prism, const glm::dvec4& light, int points = 4000) {
    return judge(ground, prism, light, {{"hull", hullMethod(0.0)}}, points).at(0).overlap();
}

void expectTable(double elevation, const std::vector<test::Figures>& found, double pooled, double fifth) {
    const test::Figures &box = found[0], &hull = found[1], &fine = found[3], &exact = found[4];
    EXPECT_GE(hull.pooled, pooled) << elevation;
    EXPECT_GE(hull.fifth, fifth) << elevation;
    EXPECT_LE(hull.triangles, box.triangles) << elevation;
    EXPECT_GE(fine.pooled, 0.998) << elevation;
    EXPECT_EQ(exact.least, 1.0) << elevation;
    EXPECT_EQ(found[2].beyond, 0) << elevation;
    EXPECT_EQ(fine.beyond, 0) << elevation;
    EXPECT_LT(found[2].least, elevation > 20.0 ? 1.0 : 1.1) << "else the bound is not tried; lower it is 0";
    EXPECT_GE(exact.rays, 400000) << "100,000 a class of object, boxes counting as two";
}

TEST(TerrainShadow, OfFourHundredObjectsOnHillsKeepsToTheTruth) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto prisms = prismsOn(ground, glm::dvec2(300.0), glm::dvec2(1290.0), 400, 1);
    const std::vector<Contestant> contestants{{"box", test::boxMethod()},
                                              {"hull", hullMethod()},
                                              {"drape 0.5", drapeMethod(0.5), 0.5},
                                              {"drape 0.1", drapeMethod(0.1), 0.1},
                                              {"exact", drapeMethod(0.0)}};
    const struct {
        double elevation, pooled, fifth;
    } wanted[] = {{60.0, 0.995, 0.98}, {30.0, 0.995, 0.98}, {10.0, 0.985, 0.97}};
    test::printHead(std::cout);
    for (const auto& [elevation, pooled, fifth] : wanted) {
        const auto found = figures(ground, prisms, elevation, contestants, 1600);
        for (std::size_t i = 0; i < found.size(); ++i)
            test::printRow(std::cout, elevation, contestants[i].name, found[i]);
        expectTable(elevation, found, pooled, fifth);
    }
}

TEST(TerrainShadow, ChangesLittleFromDegreeToDegreeOfAzimuthAndTurn) {
    const HeightPyramid rough = groundOf(hills, posts), flat = level();
    for (const Ground* ground : {static_cast<const Ground*>(&rough), static_cast<const Ground*>(&flat)}) {
        const double height = *ground->height(800.0, 800.0);
        double last[2] = {-1.0, -1.0};
        for (int angle = 0; angle <= 360; ++angle) {
            const Prism still = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.3, height - 20.0, height + 20.0);
            const Prism turned =
                boxAt({800.0, 800.0}, {8.0, 5.0}, 0.25 * angle * test::degree, height - 20.0, height + 20.0);
            const double now[2] = {overlap(*ground, still, sun(angle, 30.0), 2000),
                                   overlap(*ground, turned, sun(77.0, 30.0), 2000)};
            for (int i = 0; i < 2; ++i) {
                EXPECT_GT(now[i], 0.97) << angle;
                const double jump = angle > 0 ? std::abs(now[i] - last[i]) : 0.0;
                EXPECT_LT(jump, i ? 0.015 : 0.02)
                    << angle; // turned by a quarter of a degree; of it 0.01 for the points
                last[i] = now[i];
            }
        }
    }
}

TEST(TerrainShadow, OfASunStraightOverheadIsTheFootprint) {
    const HeightPyramid ground = level();
    const Prism house = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.3, -20.0, 23.0);
    for (const double off : {0.0, 1e-12, 1e-6}) {
        const TerrainShadow shadow = shadowOf(ground, house, {off, 0.0, 1.0, 0.0});
        EXPECT_EQ(shadow.outcome, TerrainOutcome::fan);
        const double area = test::areaInPlan(shadow.triangles);
        EXPECT_NEAR(area, 160.0, 1e-3) << off; // the reach at 1e-6 is 20 µm, of floats at 8 m 1 µm
    }
}

TEST(TerrainShadow, IsRightDownToALowSun) {
    const HeightPyramid flat = level(20000.0, glm::dvec2(-10000.0)), rough = groundOf(hills, posts);
    const auto onFlat = prismsOn(flat, glm::dvec2(0.0), glm::dvec2(100.0), 24, 2);
    for (const double elevation : {0.5, 1.0, 3.0, 8.0})
        EXPECT_GE(figures(flat, onFlat, elevation, {{"hull", hullMethod()}}, 2000)[0].least, 0.95) << elevation;
    const auto onHills = prismsOn(rough, glm::dvec2(400.0), glm::dvec2(1200.0), 60, 2);
    for (const double elevation : {8.0, 9.0, 15.0}) {
        const test::Figures hull = figures(rough, onHills, elevation, {{"hull", hullMethod()}}, 2000)[0];
        EXPECT_GE(hull.pooled, 0.95) << elevation;
        EXPECT_GE(hull.fifth, 0.95) << elevation;
    }
}

/// Where a fan is not right: what is draped instead is exact, and why is told.
TEST(TerrainShadow, OverBordersHolesAndCliffsIsDrapedAndSaysWhy) {
    std::vector<float> heights(posts * posts, 0.0f);
    for (int j = 70; j < 90; ++j) heights[std::size_t(j * posts + 84)] = std::numeric_limits<float>::quiet_NaN();
    const HeightPyramid holes({posts, posts, {0.0, 0.0}, {10.0, 10.0}, heights}), step = groundOf(cliff, posts);
    const struct {
        const char* name;
        const Ground& ground;
        Prism house;
        glm::dvec4 sun;
        TerrainOutcome expected;
    } cases[] = {
        {"hole", holes, boxAt({800.0, 800.0}, {6.0, 5.0}, 0.4, -20.0, 20.0), sun(265.0, 20.0), TerrainOutcome::rough},
        {"over the hole", holes, boxAt({840.0, 800.0}, {6.0, 15.0}, 0.4, -20.0, 20.0), sun(265.0, 20.0),
         TerrainOutcome::noFan},
        {"border", holes, boxAt({8.0, 600.0}, {6.0, 5.0}, 0.4, -20.0, 20.0), sun(85.0, 20.0), TerrainOutcome::noFan},
        {"at the border", holes, boxAt({2.0, 600.0}, {6.0, 5.0}, 0.4, -20.0, 20.0), sun(265.0, 20.0),
         TerrainOutcome::noFan},
        {"down a cliff", step, boxAt({585.0, 600.0}, {6.0, 25.0}, 0.6, -40.0, 40.0), sun(265.0, 30.0),
         TerrainOutcome::fan},
        {"up a cliff", step, boxAt({620.0, 600.0}, {6.0, 25.0}, 0.9, -40.0, 30.0), sun(85.0, 60.0),
         TerrainOutcome::steep},
        {"on a cliff", step, boxAt({600.0, 600.0}, {6.0, 25.0}, 0.4, -40.0, 40.0), sun(175.0, 20.0),
         TerrainOutcome::steep}};
    for (const auto& it : cases) {
        EXPECT_EQ(sentence(shadowOf(it.ground, it.house, it.sun).outcome), std::string(sentence(it.expected)))
            << it.name;
        EXPECT_GE(overlap(it.ground, it.house, it.sun), it.expected == TerrainOutcome::fan ? 0.99 : 0.998) << it.name;
    }
}

TEST(TerrainShadow, OfWhatIsHalfBuriedOrFloatsIsRightAndOfWhatIsInTheGroundThereIsNone) {
    const HeightPyramid ground = groundOf(hills, posts);
    const double height = *ground.height(800.0, 800.0);
    const auto house = [&](double base, double roof) {
        return boxAt({800.0, 800.0}, {20.0, 15.0}, 0.4, height + base, height + roof);
    };
    for (const double azimuth : {20.0, 110.0, 200.0, 290.0}) {
        EXPECT_GE(overlap(ground, house(-30.0, 1.0), sun(azimuth, 30.0)), 0.97) << "half buried";
        EXPECT_GE(overlap(ground, house(8.0, 20.0), sun(azimuth, 30.0)), 0.97) << "floating";
        const TerrainShadow none = shadowOf(ground, house(-30.0, -15.0), sun(azimuth, 30.0));
        EXPECT_EQ(none.outcome, TerrainOutcome::buried);
        EXPECT_TRUE(none.triangles.empty());
    }
}

/// A pyramid of 40 × 40 m and 40 m, 2 m of it in the ground. 38 × 38 m and 38 m stand out: in a sun over one of its sides, 1 up
/// in 2, the apex' shadow is 57 m off that side, and the shadow with what it stands on has 38² + 38 · 57 / 2 m².
TEST(TerrainShadow, OfSlantingWallsInTheGroundIsOfWhatStandsOut) {
    const HeightPyramid ground = level();
    const auto hull = gnomon::convexHull(
        {{780.0, 780.0, 1.0}, {820.0, 780.0, 1.0}, {820.0, 820.0, 1.0}, {780.0, 820.0, 1.0}, {800.0, 800.0, 41.0}});
    for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape}) {
        const TerrainShadow shadow = terrainShadow(ground, {*hull, std::nullopt}, {2.0, 0.0, 1.0, 0.0}, method, 0.0);
        double area = 0.0;
        for (std::size_t k = 0; k + 2 < shadow.triangles.size(); k += 3) {
            const glm::dvec3 a = shadow.triangles[k + 1] - shadow.triangles[k],
                             b = shadow.triangles[k + 2] - shadow.triangles[k];
            area += 0.5 * std::abs(a.x * b.y - a.y * b.x);
        }
        EXPECT_NEAR(area, 2527.0, 0.01) << "corners are floats about the first, off by some 2e-6 m";
    }
}

TEST(TerrainShadow, OfAWallThatBridgesAValleyIsNotTakenForBuried) {
    const HeightPyramid ground = groundOf([](double x, double) { return std::abs(x - 800.0); }, posts);
    const Prism bridge = boxAt({800.0, 800.0}, {30.0, 4.0}, 0.0, 15.0, 20.0); // its ends are in the slopes
    const TerrainShadow shadow = shadowOf(ground, bridge, sun(180.0, 60.0));
    EXPECT_FALSE(shadow.triangles.empty());
    EXPECT_GE(overlap(ground, bridge, sun(180.0, 60.0)), 0.998);
}

TEST(TerrainShadow, OnOneTriangleEndsWhereTheTriangleDoes) {
    const gnomon::TriangleGround ground({{0.0, 0.0, 1.0}, {60.0, 0.0, 4.0}, {0.0, 60.0, 2.0}}, {0, 1, 2});
    const Prism inside = boxAt({15.0, 15.0}, {3.0, 2.0}, 0.3, -5.0, 8.0),
                across = boxAt({30.0, 29.0}, {3.0, 2.0}, 0.3, -5.0, 8.0);
    EXPECT_EQ(shadowOf(ground, inside, sun(240.0, 50.0)).outcome, TerrainOutcome::fan);
    EXPECT_GE(overlap(ground, inside, sun(240.0, 50.0)), 0.998);
    EXPECT_EQ(shadowOf(ground, across, sun(60.0, 30.0)).outcome, TerrainOutcome::noFan);
    EXPECT_GE(overlap(ground, across, sun(60.0, 30.0)), 0.998);
    EXPECT_EQ(shadowOf(ground, boxAt({40.0, 40.0}, {3.0, 2.0}, 0.3, -5.0, 8.0), sun(240.0, 50.0)).outcome,
              TerrainOutcome::noGround)
        << "it falls beside the ground";
}

TEST(TerrainShadow, WithoutGroundThereIsNone) {
    const HeightPyramid holes({2, 2, {0.0, 0.0}, {9.0, 9.0}, std::vector<float>(4, std::nanf(""))});
    const gnomon::TriangleGround nothing({}, {});
    for (const Ground* ground : {static_cast<const Ground*>(&holes), static_cast<const Ground*>(&nothing)})
        for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape}) {
            const TerrainShadow shadow =
                shadowOf(*ground, boxAt({4.0, 4.0}, {2.0, 2.0}, 0.0, 0.0, 5.0), sun(20.0, 30.0), method);
            EXPECT_EQ(shadow.outcome, TerrainOutcome::noGround);
            EXPECT_TRUE(shadow.triangles.empty());
        }
}

TEST(TerrainShadow, OfALightThatIsBelowOrNowhereThereIsNoneAndItSaysWhy) {
    const HeightPyramid ground = level();
    const Prism house = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.3, -20.0, 23.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::pair<glm::dvec4, TerrainOutcome> cases[] = {
        {sun(30.0, 0.0), TerrainOutcome::lightBelow},           {sun(30.0, -20.0), TerrainOutcome::lightBelow},
        {{800.0, 830.0, 2.0, 1.0}, TerrainOutcome::lightBelow}, // a lamp under the ground
        {{0.0, 0.0, 0.0, 0.0}, TerrainOutcome::lightBelow},     {{nan, 0.0, 1.0, 0.0}, TerrainOutcome::edgeOn},
        {{800.0, 830.0, 50.0, nan}, TerrainOutcome::edgeOn}};
    for (const auto& [light, expected] : cases)
        for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape}) {
            const TerrainShadow shadow = shadowOf(ground, house, light, method);
            EXPECT_EQ(sentence(shadow.outcome), std::string(sentence(expected)));
            EXPECT_TRUE(shadow.triangles.empty());
        }
}

TEST(TerrainShadow, OfALampInsideOrInTheRoofIsAllTheGround) {
    const HeightPyramid ground = level();
    const Prism house = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.0, -20.0, 23.0);
    for (const double height : {10.0, house.roof}) {
        const TerrainShadow shadow = shadowOf(ground, house, {800.0, 800.0, height, 1.0}, TerrainMethod::hull);
        EXPECT_EQ(shadow.outcome, TerrainOutcome::lightInside);
        const double area = test::areaInPlan(shadow.triangles);
        constexpr double side = 1600.0; // of level()
        EXPECT_NEAR(area, side * side, 1e-6 * side * side);
    }
}

TEST(TerrainShadow, OfARugInTheGroundThereIsNone) {
    const HeightPyramid ground = level();
    const double height = *ground.height(800.0, 800.0);
    const std::vector<glm::dvec3> corners{
        {800.0, 800.0, height}, {810.0, 800.0, height}, {810.0, 805.0, height}, {800.0, 805.0, height}};
    for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape}) {
        const auto rug = [&](double lift) {
            gnomon::ConvexPart part{*gnomon::convexHull(corners), std::nullopt};
            for (glm::dvec3& vertex : part.hull.vertices) vertex.z += lift;
            for (auto& face : part.hull.faces) face.plane.w -= lift * face.plane.z;
            return gnomon::terrainShadow(ground, part, glm::dvec4(sunAt(30.0, 40.0), 0.0), method);
        };
        EXPECT_EQ(rug(0.0).outcome, TerrainOutcome::buried);
        EXPECT_EQ(rug(1e-6).outcome, TerrainOutcome::buried) << "by rounding over the ground";
        EXPECT_NE(rug(0.01).outcome, TerrainOutcome::buried);
        EXPECT_FALSE(rug(0.01).triangles.empty());
    }
}

TEST(TerrainShadow, OfALampIsRightAndItsErrorIsThatOfItsLowestRays) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto prisms = prismsOn(ground, glm::dvec2(500.0), glm::dvec2(1100.0), 40, 4);
    std::vector<test::Share> hull, coarse, exact;
    for (const Prism& prism : prisms) {
        const glm::dvec2 middle = prism.middle();
        const glm::dvec4 lamp(middle + glm::dvec2(25.0, -15.0), prism.roof + 20.0, 1.0);
        const auto shares =
            judge(ground, prism, lamp,
                  {{"hull", hullMethod()}, {"coarse", drapeMethod(0.5), 0.5}, {"exact", drapeMethod(0.0)}}, 2000);
        hull.push_back(shares[0]);
        coarse.push_back(shares[1]);
        exact.push_back(shares[2]);
    }
    EXPECT_GE(tally(hull).pooled, 0.99);
    EXPECT_EQ(tally(coarse).beyond, 0);
    EXPECT_LT(tally(coarse).least, 1.0) << "else the bound is not tried";
    EXPECT_EQ(tally(exact).least, 1.0);
}

TEST(TerrainShadow, OfALampBelowTheRoofGoesOnToTheEndOfTheGround) {
    const HeightPyramid ground = groundOf(hills, posts);
    const double height = *ground.height(800.0, 800.0);
    const Prism house = boxAt({800.0, 800.0}, {8.0, 5.0}, 0.3, height - 20.0, height + 20.0);
    const glm::dvec4 lamp(820.0, 810.0, height + 12.0, 1.0);
    EXPECT_EQ(shadowOf(ground, house, lamp).outcome, TerrainOutcome::noFan);
    int shadowed = 0;
    const TerrainShadow shadow = shadowOf(ground, house, lamp);
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec2 p(300.0 + 10.0 * (i % 63), 500.0 + 8.0 * (i / 63));
        const double z = *ground.height(p.x, p.y);
        if (z > lamp.z || house.isUnder(p)) continue; // the truth is of lights above the ground
        const bool expected = house.blocks({p.x, p.y, z}, lamp);
        shadowed += expected;
        EXPECT_EQ(test::over(shadow.triangles, p) > 0, expected) << p.x << " " << p.y;
    }
    EXPECT_GT(shadowed, 300);
}

TEST(TerrainShadow, MovedToWorldCoordinatesIsTheSameMesh) {
    const glm::dvec2 far(433000.0, 5410000.0);
    std::vector<float> heights;
    for (int j = 0; j < posts; ++j)
        for (int i = 0; i < posts; ++i) heights.push_back(float(hills(10.0 * i, 10.0 * j)));
    const HeightPyramid near({posts, posts, {0.0, 0.0}, {10.0, 10.0}, heights}),
        moved({posts, posts, far, {10.0, 10.0}, heights});
    for (Prism prism : prismsOn(near, glm::dvec2(400.0), glm::dvec2(1200.0), 40, 3))
        for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape}) {
            const TerrainShadow expected = shadowOf(near, prism, sun(77.0, 25.0), method);
            Prism there = prism;
            for (glm::dvec2& corner : there.outline) corner += far;
            const TerrainShadow found = shadowOf(moved, there, sun(77.0, 25.0), method);
            ASSERT_EQ(found.triangles.size(), expected.triangles.size());
            EXPECT_EQ(found.outcome, expected.outcome);
            for (std::size_t i = 0; i < found.triangles.size(); ++i)
                EXPECT_LT(glm::length(found.triangles[i] - glm::dvec3(far, 0.0) - expected.triangles[i]), 1e-3);
        }
}

/// Half of what the rays say is behind the crest, in the ground's own shadow.
TEST(TerrainTrial, CanLeaveOutWhatTheGroundItselfKeepsTheLightFrom) {
    const HeightPyramid ground = groundOf([](double x, double) { return 100.0 - std::abs(x - 800.0); }, posts);
    const Prism house = boxAt({785.0, 800.0}, {6.0, 6.0}, 0.0, 50.0, 105.0);
    const std::vector<Contestant> exact{{"exact", drapeMethod(0.0)}};
    const test::Share all = judge(ground, house, sun(270.0, 30.0), exact, 4000)[0];
    const test::Share sunlit = judge(ground, house, sun(270.0, 30.0), exact, 4000, test::Places::sunlit)[0];
    EXPECT_EQ(all.overlap(), 1.0);
    EXPECT_EQ(sunlit.overlap(), 1.0);
    EXPECT_GT(sunlit.either, 20);
    EXPECT_LT(sunlit.either, 0.7 * all.either);
}

TEST(TerrainShadow, EveryOutcomeHasASentenceOfItsOwn) {
    std::set<std::string> sentences;
    for (int i = 0; i <= int(TerrainOutcome::noGround); ++i) {
        const std::string one = gnomon::sentence(TerrainOutcome(i));
        EXPECT_EQ(one.back(), '.');
        EXPECT_TRUE(sentences.insert(one).second) << one;
    }
}

} // namespace
