// SPDX-License-Identifier: MIT
// Shadows of many parts at once, against those of the parts one by one; and how far they move.
#include "GroundTriangles.h"
#include "Houses.h"

#include <gnomon/ConvexParts.h>
#include <gnomon/PackedShadows.h>
#include <gnomon/ShadowKernel.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <set>
#include <thread>

using gnomon::CellCut;
using gnomon::Drape;
using gnomon::Ground;
using gnomon::HeightPyramid;
using gnomon::movedAtMost;
using gnomon::PackedParts;
using gnomon::PackedShadows;
using gnomon::packedShadows;
using gnomon::TerrainMethod;
using gnomon::TerrainOutcome;
using gnomon::terrainShadow;
using test::groundOf;
using test::hills;
using test::pitch;
using test::sunAt;

namespace {

constexpr int posts = 160;

const glm::dvec3 origin(800.0, 800.0, 20.0);

std::vector<gnomon::ConvexPart> townOn(const Ground& ground, int count) {
    std::vector<gnomon::ConvexPart> parts;
    for (const test::Prism& prism : test::prismsOn(ground, glm::dvec2(300.0), glm::dvec2(1290.0), count, 1))
        for (gnomon::ConvexPart& part : prism.parts()) parts.push_back(std::move(part));
    return parts;
}

glm::dvec4 sun(double azimuth, double elevation) { return glm::dvec4(sunAt(azimuth, elevation), 0.0); }

PackedShadows found(const Ground& ground, const PackedParts& parts, const glm::dvec4& light,
                    TerrainMethod method = TerrainMethod::hull, double error = 0.1) {
    PackedShadows shadows;
    packedShadows(ground, parts, light, method, error, origin, shadows);
    return shadows;
}

/// How far one part's shadow moves at most.
double boundOf(const Ground& ground, const gnomon::ConvexPart& part, const glm::dvec4& then, const glm::dvec4& now) {
    PackedShadows shadows;
    std::vector<gnomon::ShadowMotion> motions;
    packedShadows(ground, PackedParts({part}), then, TerrainMethod::hull, 0.1, origin, shadows);
    findMotions(ground, PackedParts({part}), shadows, then, motions);
    return movedAtMost(motions.at(0), gnomon::SunTurn(gnomon::wayOf(then), gnomon::wayOf(now)));
}

/// As the parts' one by one, their corners rounded about the origin.
void expectAsOneByOne(const Ground& ground, const std::vector<gnomon::ConvexPart>& parts, const PackedShadows& shadows,
                      const glm::dvec4& light, TerrainMethod method) {
    ASSERT_EQ(shadows.size(), parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const gnomon::TerrainShadow expected = terrainShadow(ground, parts[i], light, method, 0.1);
        const Drape triangles = shadows.triangles(i);
        ASSERT_EQ(shadows[i].outcome, expected.outcome) << i;
        ASSERT_EQ(triangles.size(), expected.triangles.size()) << i;
        for (std::size_t k = 0; k < triangles.size(); ++k)
            ASSERT_EQ(glm::vec3(triangles[k] - origin), glm::vec3(expected.triangles[k] - origin)) << i;
    }
}

/// Mountains on posts far apart, as an elevation model of 3 arc-seconds has them: steeper than a low sun.
HeightPyramid mountains() {
    std::vector<float> heights;
    for (int j = 0; j < 24; ++j)
        for (int i = 0; i < 24; ++i) heights.push_back(float(4.0 * hills(92.0 * i, 75.0 * j)));
    return HeightPyramid({24, 24, {0.0, 0.0}, {75.0, 92.0}, heights});
}

/// Hills with cells cut both ways, some left out, and posts without height.
HeightPyramid patched() {
    std::vector<float> heights;
    std::vector<gnomon::CellCut> cuts;
    for (int j = 0; j < posts; ++j)
        for (int i = 0; i < posts; ++i) heights.push_back(float(hills(pitch * i, pitch * j)));
    for (int i = 0; i < (posts - 1) * (posts - 1); ++i)
        cuts.push_back(gnomon::CellCut(i % 101 == 0 ? 2 : i * 7 / 3 % 2));
    for (std::size_t i = 700; i < heights.size(); i += 997) heights[i] = std::nanf("");
    return HeightPyramid({posts, posts, {0.0, 0.0}, {pitch, pitch}, heights, 0.0, cuts});
}

const glm::dvec4 lights[] = {sun(77.0, 60.0), sun(200.0, 30.0), sun(310.0, 8.0), {800.0, 800.0, 150.0, 1.0}};

void expectSame(const PackedShadows& a, const PackedShadows& b, const std::string& where) {
    EXPECT_EQ(a.outcomes, b.outcomes) << where;
    EXPECT_EQ(a.cornerEnds, b.cornerEnds) << where;
    EXPECT_EQ(a.indices, b.indices) << where;
    ASSERT_EQ(a.corners.size(), b.corners.size()) << where;
    EXPECT_EQ(std::memcmp(a.corners.data(), b.corners.data(), a.corners.size() * sizeof(glm::vec3)), 0) << where;
}

struct ChosenKernel {
    explicit ChosenKernel(const std::string& name) { gnomon::chooseShadowKernel(name); }
    ~ChosenKernel() { gnomon::chooseShadowKernel(gnomon::shadowKernels().back()); }
};

TEST(PackedShadows, AreThoseOfThePartsOneByOneBitForBit) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto parts = townOn(ground, 120);
    const PackedParts packed(parts);
    for (const glm::dvec4& light : lights)
        for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape})
            expectAsOneByOne(ground, parts, found(ground, packed, light, method), light, method);
}

TEST(PackedShadows, AreTheSameBitForBitWithAndWithoutSimd) {
    const auto kernels = gnomon::shadowKernels();
    ASSERT_GE(kernels.size(), 2u) << "one is without SIMD";
    for (const HeightPyramid& ground : {groundOf(hills, posts), mountains(), patched()}) {
        const PackedParts packed(townOn(ground, 200));
        for (const glm::dvec4& light : lights)
            for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape}) {
                const PackedShadows best = found(ground, packed, light, method);
                for (const std::string& name : kernels) {
                    const ChosenKernel chosen(name);
                    EXPECT_EQ(gnomon::shadowKernel().instructions, name);
                    expectSame(best, found(ground, packed, light, method), name);
                }
            }
    }
}

TEST(PackedShadows, AreTheSameBitForBitForOneThreadAndForMany) {
    const HeightPyramid ground = patched();
    const auto parts = townOn(ground, 400);
    std::vector<PackedParts> tiles;
    for (std::size_t i = 0; i < parts.size(); i += 50)
        tiles.emplace_back(std::vector(parts.begin() + long(i), parts.begin() + long(std::min(i + 50, parts.size()))));
    for (const glm::dvec4& light : lights) {
        std::vector<PackedShadows> one;
        for (const PackedParts& tile : tiles) one.push_back(found(ground, tile, light));
        std::vector<std::vector<PackedShadows>> many(4, std::vector<PackedShadows>(tiles.size()));
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < many.size(); ++t)
            threads.emplace_back([&, t] {
                for (std::size_t i = 0; i < tiles.size(); ++i) {
                    const std::size_t tile = (i + 2 * t) % tiles.size(); // each another at one time
                    many[t][tile] = found(ground, tiles[tile], light);
                }
            });
        for (std::thread& thread : threads) thread.join();
        for (const auto& of : many)
            for (std::size_t i = 0; i < tiles.size(); ++i) expectSame(one[i], of[i], "tile " + std::to_string(i));
    }
}

/// Parts of many kinds over and over: what a part is found together with differs, its shadow does not.
TEST(PackedShadows, OfAHundredThousandPartsAreThoseOfEachWhateverItIsFoundWith) {
    const HeightPyramid ground = groundOf(hills, posts);
    const PackedParts few(townOn(ground, 160));
    const PackedShadows expected = found(ground, few, sun(200.0, 30.0));
    PackedParts many;
    std::mt19937 random(1);
    std::vector<std::size_t> which;
    for (int i = 0; i < 100000; ++i) {
        which.push_back(random() % few.size());
        many.add(few, which.back());
    }
    const PackedShadows all = found(ground, many, sun(200.0, 30.0));
    ASSERT_EQ(all.size(), which.size());
    for (std::size_t i = 0; i < which.size(); ++i) {
        const gnomon::PackedShadow a = all[i], b = expected[which[i]];
        ASSERT_EQ(a.outcome, b.outcome) << i;
        ASSERT_EQ(a.cornerCount, b.cornerCount) << i;
        ASSERT_EQ(std::memcmp(a.corners, b.corners, a.cornerCount * sizeof(glm::vec3)), 0) << i;
        ASSERT_TRUE(std::equal(a.indices, a.indices + a.indexCount, b.indices, b.indices + b.indexCount)) << i;
    }
}

/// Without the gentle ground's short cut, on triangles: other ways to the same places.
TEST(PackedShadows, OnAGridAreThoseOnItsTriangles) {
    const HeightPyramid ground = groundOf(hills, posts);
    const gnomon::TriangleGround loose = test::LooseTriangles(test::trianglesOf(ground.field())).ground();
    const PackedParts packed(townOn(ground, 60));
    for (const glm::dvec4& light : lights) {
        const PackedShadows grid = found(ground, packed, light), triangles = found(loose, packed, light);
        ASSERT_EQ(grid.outcomes, triangles.outcomes);
        for (std::size_t i = 0; i < grid.size(); ++i) {
            if (!grid[i].isFan()) continue;
            ASSERT_EQ(grid[i].cornerCount, triangles[i].cornerCount) << i;
            for (std::size_t k = 0; k < grid[i].cornerCount; ++k)
                EXPECT_LT(glm::length(grid[i].corners[k] - triangles[i].corners[k]), 1e-3f) << "floats of 1000 m: 6e-5";
        }
    }
}

double areaInPlan(const Drape& triangles) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const glm::dvec2 a(triangles[i]), b(triangles[i + 1]), c(triangles[i + 2]);
        sum += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    }
    return sum;
}

/// Against the ground's triangles clipped one by one, which know nothing of numbers.
TEST(PackedShadows, DrapesCoverWhatThePlanesDoAndHaveEachCornerOnce) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto parts = townOn(ground, 60);
    for (const glm::dvec4& light : lights) {
        const PackedShadows drapes = found(ground, PackedParts(parts), light, TerrainMethod::drape, 0.0);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (drapes[i].outcome != TerrainOutcome::draped) continue;
            const auto planes = gnomon::convexShadow(parts[i].hull, light);
            ASSERT_TRUE(planes) << i;
            const Drape expected = gnomon::drape(ground, *planes, 0.0);
            EXPECT_NEAR(areaInPlan(drapes.triangles(i)), areaInPlan(expected), 0.1)
                << "m^2; floats of 1000 m are off by 6e-5 along edges of some 1000 m in all";
            std::set<std::array<float, 3>> places;
            for (std::size_t k = 0; k < drapes[i].cornerCount; ++k)
                places.insert({drapes[i].corners[k].x, drapes[i].corners[k].y, drapes[i].corners[k].z});
            EXPECT_EQ(places.size(), drapes[i].cornerCount) << i;
        }
    }
}

TEST(PackedShadows, OfPartsAddedMovedAndRemovedAreThoseOfWhatIsThere) {
    const HeightPyramid ground = groundOf(hills, posts);
    auto parts = townOn(ground, 40);
    PackedParts packed({parts.begin(), parts.begin() + 10});
    const PackedParts others({parts.begin() + 10, parts.begin() + 20});
    for (std::size_t i = 0; i < others.size(); ++i) packed.add(others, i);
    for (std::size_t i = 20; i < parts.size(); ++i) packed.add(parts[i]);
    std::swap(parts[3], parts[17]); // of another shape
    packed.replace(3, parts[3]);
    packed.replace(17, parts[17]);
    packed.remove(5);
    parts[5] = parts.back();
    parts.pop_back();
    packed.remove(parts.size() - 1);
    parts.pop_back();
    const glm::dvec4 light = sun(140.0, 35.0);
    expectAsOneByOne(ground, parts, found(ground, packed, light), light, TerrainMethod::hull);
}

TEST(PackedShadows, OfNothingAreNoneAndOfALightThatIsNoneToo) {
    const HeightPyramid ground = groundOf(hills, posts);
    EXPECT_EQ(found(ground, {}, sun(10.0, 30.0)).size(), 0u);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const PackedParts packed(townOn(ground, 8));
    for (const glm::dvec4& light : {glm::dvec4(nan, 0.0, 1.0, 0.0), glm::dvec4(0.0), sun(10.0, -5.0)}) {
        const PackedShadows none = found(ground, packed, light);
        EXPECT_EQ(none.size(), packed.size());
        EXPECT_TRUE(none.corners.empty());
        EXPECT_TRUE(none.indices.empty());
    }
}

/// The corner of a roof at height h over level ground falls h / tan e away.
TEST(PackedShadows, MoveByNoMoreThanTheBoundAndOnLevelGroundByIt) {
    const HeightPyramid level({2, 2, glm::dvec2(-5000.0), glm::dvec2(10000.0), std::vector<float>(4, 3.0f)});
    const test::Prism tower = test::boxAt({0.0, 0.0}, {4.0, 4.0}, 0.2, -5.0, 43.0);
    const PackedParts packed(tower.parts());
    const glm::dvec4 then = sun(100.0, 30.0), now = sun(100.0, 31.0);
    const double expected = 40.0 / std::tan(30.0 * test::degree) - 40.0 / std::tan(31.0 * test::degree);
    EXPECT_NEAR(movedAtMost(found(level, packed, then), then, now), expected, 1e-4);
    EXPECT_EQ(movedAtMost(found(level, packed, then), then, then), 0.0);
    EXPECT_GT(movedAtMost(found(level, packed, then), then, sun(100.0, -1.0)), 1e9);
    EXPECT_GT(movedAtMost(found(level, packed, then), {0, 0, 99, 1}, {0, 1, 99, 1}), 1e9) << "a lamp";
}

/// How far, of a bound, one of its corners above the ground moves at most; none by more.
double mostOfBound(const HeightPyramid& ground, const gnomon::ConvexPart& part, const glm::dvec4& then,
                   const glm::dvec4& now, double bound) {
    double most = 0.0;
    for (const glm::dvec3& vertex : part.hull.vertices) {
        const auto a = ground.hit(vertex, -glm::dvec3(then)), b = ground.hit(vertex, -glm::dvec3(now));
        if (!a || !b || vertex.z <= *ground.height(vertex.x, vertex.y)) continue;
        const double moved = glm::length(glm::dvec2(*a - *b));
        EXPECT_LE(moved, bound);
        most = std::max(most, moved / bound);
    }
    return most;
}

/// Where a roof's corner falls, by rays alone.
TEST(PackedShadows, OnHillsNoCornerMovesByMoreThanTheBound) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto parts = townOn(ground, 60);
    double most = 0.0;
    for (const auto& part : parts) {
        const glm::dvec4 then = sun(77.0, 40.0), now = sun(79.0, 41.5);
        const double bound = movedAtMost(found(ground, PackedParts({part}), then), then, now);
        most = std::max(most, mostOfBound(ground, part, then, now, bound));
    }
    EXPECT_GT(most, 0.7) << "else the bound is of no use";
}

/// The same of each part alone, for turns along the light's way, across it and between.
TEST(PackedShadows, OnHillsNoCornerMovesByMoreThanItsPartsBoundWhicheverWayTheSunTurns) {
    const HeightPyramid ground = groundOf(hills, posts);
    const glm::dvec4 then = sun(77.0, 40.0);
    double most = 0.0;
    for (const auto& part : townOn(ground, 60))
        for (const glm::dvec4& now :
             {sun(77.0, 41.0), sun(77.0, 39.0), sun(78.0, 40.0), sun(76.0, 40.0), sun(78.0, 41.0), sun(78.0, 39.0)}) {
            const double bound = boundOf(ground, part, then, now);
            most = std::max(most, mostOfBound(ground, part, then, now, bound));
        }
    EXPECT_GT(most, 0.9) << "else the bound is of no use";
}

/// On a plane that falls away from the sun by 0.4 a tip at height 40 under a sun with 1.5 m of shadow a metre falls on ground
/// 40 / (1 - 0.6) = 100 m lower. A turn across that way moves it as on level ground, one along it by 1 / (1 - 0.6) of that.
TEST(PackedShadows, OnASlopeHaveABoundForEachWayThatTheSunMayTurn) {
    const auto slope = [](double x, double) { return -0.4 * x; };
    const HeightPyramid ground = groundOf(slope, posts);
    const auto tower = test::boxAt({400.0, 700.0}, {0.05, 0.05}, 0.0, -165.0, -120.0).parts()[0];
    const glm::dvec4 then(-1.5, 0.0, 1.0, 0.0);
    const double turned = 1e-4;
    EXPECT_NEAR(boundOf(ground, tower, then, {-1.5, turned, 1.0, 0.0}), 100.0 * turned, 0.02 * 100.0 * turned);
    EXPECT_NEAR(boundOf(ground, tower, then, {-1.5 + turned, 0.0, 1.0, 0.0}), 250.0 * turned, 0.02 * 250.0 * turned);
}

/// A cell half of which is level, the other half steeper than light that comes over its edge: of a hut 5 m high on the level
/// half, far from the edge and 10 m from it.
TEST(PackedShadows, HaveABoundByThoseTrianglesOfACellThatTheyAreNear) {
    struct Case {
        CellCut cut;
        std::vector<float> heights;
        glm::dvec2 towards, far, near; ///< of the light; places of huts.
    };
    const Case cases[] = {{CellCut::rising, {0, 0, -1000, 0}, {1, -1}, {150, 50}, {105, 95}},
                          {CellCut::rising, {0, -1000, 0, 0}, {-1, 1}, {50, 150}, {95, 105}},
                          {CellCut::falling, {-1000, 0, 0, 0}, {1, 1}, {150, 150}, {105, 105}},
                          {CellCut::falling, {0, 0, 0, -1000}, {-1, -1}, {50, 50}, {95, 95}}};
    for (const Case& one : cases) {
        const HeightPyramid ground({2, 2, {0.0, 0.0}, {200.0, 200.0}, one.heights, 0.0, {one.cut}});
        const glm::dvec4 then(one.towards, 1.0, 0.0), now(one.towards * 1.001, 1.0, 0.0);
        const auto bound = [&](const glm::dvec2& place) {
            return boundOf(ground, test::boxAt(place, {1.0, 1.0}, 0.0, -1.0, 5.0).parts()[0], then, now);
        };
        EXPECT_NEAR(bound(one.far), 5.0 * 0.001 * std::sqrt(2.0), 1e-5);
        EXPECT_GT(bound(one.near), 1e9);
    }
}

/// On a slope of 1 in 10 that falls away from a low sun a tower's shadow moves much; a turn that would take it out of where
/// the ground was looked at has no bound.
TEST(PackedShadows, HaveNoBoundBeyondTheGroundThatIsKnown) {
    const auto slope = [](double x, double) { return 200.0 - 0.1 * x; };
    const HeightPyramid ground = groundOf(slope, posts);
    const double x = 400.0, base = slope(x, 0.0);
    const PackedParts packed(test::boxAt({x, 700.0}, {4.0, 4.0}, 0.0, base - 5.0, base + 30.0).parts());
    const auto sunOf = [](double shift) {
        return glm::dvec4(-shift, 0.0, 1.0, 0.0);
    }; // metres in plan a metre of height
    const PackedShadows shadows = found(ground, packed, sunOf(7.0));
    const auto tip = [&](double shift) { return x + 30.0 * shift / (1.0 - 0.1 * shift); };
    for (const double turned : {0.0009, 0.009}) {
        const double bound = movedAtMost(shadows, sunOf(7.0), sunOf(7.0 - turned));
        EXPECT_GE(bound, tip(7.0) - tip(7.0 - turned));
        EXPECT_LT(bound, 30.0);
    }
    EXPECT_GT(movedAtMost(shadows, sunOf(7.0), sunOf(6.91)), 1e9);
}

/// On a slope that is steeper than the sun and faces it, a shadow of some 80 cells moves by less than on level ground.
TEST(PackedShadows, HaveABoundOnASteepSlopeThatFacesTheSun) {
    const auto slope = [](double x, double) { return 0.8 * x; };
    const HeightPyramid ground = groundOf(slope, posts);
    const double x = 400.0, base = slope(x, 0.0), height = 100.0;
    const auto tower = test::boxAt({x, 700.0}, {4.0, 4.0}, 0.0, base - 5.0, base + height).parts()[0];
    const auto sunOf = [](double shift) { return glm::dvec4(-shift, 0.0, 1.0, 0.0); };
    const auto tip = [&](double shift) { return x + height * shift / (1.0 + 0.8 * shift); };
    for (const double turned : {0.0009, 0.009}) {
        const double bound = boundOf(ground, tower, sunOf(1.5), sunOf(1.5 + turned));
        EXPECT_GE(bound, tip(1.5 + turned) - tip(1.5));
        EXPECT_LT(bound, 2.0 * height * turned) << "twice what it moves by on level ground";
    }
}

/// Along furrows, level under the light's way, whose sides rise by 0.6: a tip moves along the bottom of one, or its ridge.
TEST(PackedShadows, HaveABoundAlongFurrowsWhoseSidesAreAsSteepAsTheLight) {
    const auto furrows = [](double x, double y) { return std::lround((x + y) / pitch) % 2 ? 6.0 : 0.0; };
    const HeightPyramid ground = groundOf(furrows, posts); // rising cells: their diagonals run along (1, 1)
    const auto tower = test::boxAt({400.0, 700.0}, {2.0, 2.0}, 0.0, -5.0, 50.0).parts()[0];
    const auto sunOf = [](double shift) { return glm::dvec4(-shift, -shift, 1.0, 0.0); };
    const double turned = 0.001, most = 50.0 * std::sqrt(2.0) * turned; // from the roof to the bottom
    const double bound = boundOf(ground, tower, sunOf(0.95), sunOf(0.95 + turned));
    EXPECT_GE(bound, 44.0 / 50.0 * most) << "on a ridge";
    EXPECT_LT(bound, 3.0 * most);
}

/// A plate that the sun is in, and a tower whose shadow falls beside the ground, among houses that move little.
TEST(PackedShadows, HaveNoBoundWhereOneMayAppear) {
    const HeightPyramid ground = groundOf([](double, double) { return 0.0; }, posts);
    const glm::dvec4 then(-1.0, 0.0, 1.0, 0.0), now(-1.0, 0.001, 1.0, 0.0);
    const auto house = test::boxAt({400.0, 700.0}, {4.0, 4.0}, 0.0, -5.0, 5.0).parts()[0];
    const auto tower = test::boxAt({1588.0, 700.0}, {1.0, 1.0}, 0.0, 4.0, 40.0).parts()[0];
    const std::vector<glm::vec3> wall = {{500, 700, -1}, {510, 700, -1}, {510, 700, 9}, {500, 700, 9}};
    const std::vector<unsigned> corners = {0, 1, 2, 0, 2, 3};
    const auto plate = gnomon::convexParts(wall.data(), wall.size(), corners.data(), corners.size());
    ASSERT_EQ(plate.size(), 1u);
    ASSERT_LT(movedAtMost(found(ground, PackedParts({house}), then), then, now), 0.1);
    for (const auto& [part, outcome] : {std::pair(plate[0], TerrainOutcome::edgeOn), {tower, TerrainOutcome::noGround}})
        for (const auto& parts : {std::vector{part}, {house, part}}) {
            const PackedShadows shadows = found(ground, PackedParts(parts), then);
            ASSERT_EQ(shadows.outcomes.back(), outcome);
            EXPECT_GT(movedAtMost(shadows, then, now), 1e9);
        }
}

/// The tallest does not count with the steepest slope, which is elsewhere. All together may be told to move by more.
TEST(PackedShadows, MoveByNoMoreAmongOthersThanAlone) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto parts = townOn(ground, 60);
    const glm::dvec4 then = sun(77.0, 30.0), now = sun(77.1, 30.05);
    const PackedShadows shadows = found(ground, PackedParts(parts), then);
    std::vector<gnomon::ShadowMotion> motions;
    findMotions(ground, PackedParts(parts), shadows, then, motions);
    double most = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double alone = boundOf(ground, parts[i], then, now);
        const double among = movedAtMost(motions[i], gnomon::SunTurn(gnomon::wayOf(then), gnomon::wayOf(now)));
        EXPECT_LE(among, alone * 1.001) << i;
        most = std::max(most, alone);
    }
    ASSERT_GT(most, 0.0);
    EXPECT_GE(movedAtMost(shadows, then, now), most);
    EXPECT_LT(movedAtMost(shadows, then, now), 10.0);
}

} // namespace
