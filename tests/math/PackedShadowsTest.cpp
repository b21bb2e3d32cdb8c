// SPDX-License-Identifier: MIT
// Shadows of many parts at once, against those of the parts one by one.
#include "PackedTown.h"

#include <gnomon/onterrain/TerrainShadow.h>
#include <gnomon/simd/ShadowKernel.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <set>
#include <thread>

using gnomon::Drape;
using gnomon::Ground;
using gnomon::HeightPyramid;
using gnomon::PackedParts;
using gnomon::PackedShadows;
using gnomon::packedShadows;
using gnomon::TerrainMethod;
using gnomon::TerrainOutcome;
using gnomon::terrainShadow;
using test::found;
using test::groundOf;
using test::hills;
using test::origin;
using test::pitch;
using test::posts;
using test::sun;
using test::townOn;

namespace {

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

TEST(PackedShadows, AreThoseOfThePartsOneByOneBitForBit) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto parts = townOn(ground, 120);
    const PackedParts packed(parts);
    for (const glm::dvec4& light : lights)
        for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape})
            expectAsOneByOne(ground, parts, found(ground, packed, light, method), light, method);
}

TEST(PackedShadows, AreTheSameBitForBitWithAndWithoutSimd) {
    const auto& kernels = gnomon::shadowKernels();
    ASSERT_GE(kernels.size(), 2u) << "one is without SIMD";
    for (const HeightPyramid& ground : {groundOf(hills, posts), mountains(), patched()}) {
        const PackedParts packed(townOn(ground, 200));
        for (const glm::dvec4& light : lights)
            for (const TerrainMethod method : {TerrainMethod::hull, TerrainMethod::drape}) {
                const PackedShadows best = found(ground, packed, light, method);
                for (const gnomon::ShadowKernel& kernel : kernels)
                    expectSame(best, found(ground, packed, light, method, 0.1, &kernel), kernel.instructions);
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

TEST(PackedShadows, OfPartsAddedAndRemovedAreThoseOfWhatIsThere) {
    const HeightPyramid ground = groundOf(hills, posts);
    auto parts = townOn(ground, 40);
    PackedParts packed({parts.begin(), parts.begin() + 10});
    const PackedParts others({parts.begin() + 10, parts.begin() + 20});
    for (std::size_t i = 0; i < others.size(); ++i) packed.add(others, i);
    for (std::size_t i = 20; i < parts.size(); ++i) packed.add(parts[i]);
    packed.remove(5);
    parts[5] = parts.back(); // of another shape
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

} // namespace
