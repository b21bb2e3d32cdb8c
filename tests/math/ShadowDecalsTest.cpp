// SPDX-License-Identifier: MIT
// Decals of shadows: on the ground to rounding, over what the fans are over and nothing else.
#include "GroundTriangles.h"
#include "Houses.h"

#include <gnomon/overlay/ShadowDecals.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

using gnomon::HeightPyramid;
using gnomon::PackedShadow;
using gnomon::PackedShadows;
using gnomon::ShadowDecals;
using test::groundOf;
using test::hills;

namespace {

const glm::dvec3 origin(800.0, 800.0, 20.0);

PackedShadows shadowsOf(const gnomon::Ground& ground, const std::vector<test::Prism>& prisms) {
    gnomon::PackedParts parts;
    for (const test::Prism& prism : prisms)
        for (const gnomon::ConvexPart& part : prism.parts()) parts.add(part);
    PackedShadows shadows;
    packedShadows(ground, parts, glm::dvec4(test::sunAt(77.0, 40.0), 0.0), gnomon::TerrainMethod::hull, 0.1, origin,
                  shadows);
    return shadows;
}

ShadowDecals decalsOf(const HeightPyramid& ground, const PackedShadows& shadows) {
    ShadowDecals decals;
    shadowDecals(ground, shadows, decals);
    return decals;
}

std::array<glm::dvec3, 3> triangle(const ShadowDecals& decals, std::size_t i) {
    const auto at = [&](std::size_t k) { return origin + glm::dvec3(decals.vertices[decals.triangles[3 * i + k]]); };
    return {at(0), at(1), at(2)};
}

double area(const std::array<glm::dvec3, 3>& t) { return 0.5 * gnomon::doubleArea(t[0], t[1], t[2]); }

double fanArea(const PackedShadow& fan) {
    double sum = 0.0;
    for (std::size_t i = 2; i < fan.cornerCount; ++i)
        sum += 0.5 * gnomon::doubleArea(fan.corners[0], fan.corners[i - 1], fan.corners[i]);
    return sum;
}

/// Floats about the origin, up to 700 m from it, are half a tenth of a millimetre off; a triangle is so on steep ground too.
constexpr double rounding = 2e-4;

void expectOn(const HeightPyramid& ground, const std::array<glm::dvec3, 3>& t) {
    for (const glm::dvec3& weights :
         {glm::dvec3(1.0, 1.0, 1.0) / 3.0, glm::dvec3(0.8, 0.1, 0.1), glm::dvec3(0.1, 0.2, 0.7)}) {
        const glm::dvec3 p = weights.x * t[0] + weights.y * t[1] + weights.z * t[2];
        ASSERT_NEAR(p.z, *ground.height(p.x, p.y), rounding);
    }
}

/// As large as the fans, none of it turned over, all of it on the ground: so it is over the same places, each once.
void expectTheFansOn(const HeightPyramid& ground, const PackedShadows& shadows, std::size_t leastPieces) {
    const ShadowDecals decals = decalsOf(ground, shadows);
    double sum = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < decals.triangles.size() / 3; ++i) {
        const auto t = triangle(decals, i);
        EXPECT_GE(area(t), -1e-6);
        sum += area(t);
        if (area(t) > 1e-3) expectOn(ground, t); // in slivers a place between the corners is mostly rounding
    }
    std::size_t fans = 0;
    for (std::size_t i = 0; i < shadows.size(); ++i)
        if (isDecal(ground, shadows[i], origin)) expected += fanArea(shadows[i]), ++fans;
    EXPECT_GT(fans, shadows.size() / 3);
    EXPECT_GT(decals.triangles.size() / 3, leastPieces);
    EXPECT_NEAR(sum, expected, 1e-5 * expected);
}

} // namespace

TEST(ShadowDecals, LieOnHillsUnderTheWholeOfEachFan) {
    const HeightPyramid ground = groundOf(hills, 160);
    expectTheFansOn(ground, shadowsOf(ground, test::prismsOn(ground, glm::dvec2(300.0), glm::dvec2(1290.0), 200, 1)),
                    2000);
}

TEST(ShadowDecals, LieOnCellsCutTheOtherWay) {
    std::vector<float> heights;
    for (int j = 0; j < 160; ++j)
        for (int i = 0; i < 160; ++i) heights.push_back(float(hills(10.0 * i, 10.0 * j)));
    const std::vector<gnomon::CellCut> cuts(159 * 159, gnomon::CellCut::falling);
    const HeightPyramid ground({160, 160, {0.0, 0.0}, {10.0, 10.0}, heights, 0.0, cuts});
    expectTheFansOn(ground, shadowsOf(ground, test::prismsOn(ground, glm::dvec2(300.0), glm::dvec2(1290.0), 100, 2)),
                    1000);
}

/// On cells of 60 m, cut either way, most fans are on one triangle.
TEST(ShadowDecals, LieOnTheTriangleOrTheTrianglesThatTheyAreOn) {
    for (const gnomon::CellCut cut : {gnomon::CellCut::rising, gnomon::CellCut::falling}) {
        std::vector<float> heights;
        for (int j = 0; j < 27; ++j)
            for (int i = 0; i < 27; ++i) heights.push_back(float(hills(60.0 * i, 60.0 * j)));
        const std::vector<gnomon::CellCut> cuts(26 * 26, cut);
        const HeightPyramid ground({27, 27, {0.0, 0.0}, {60.0, 60.0}, heights, 0.0, cuts});
        const PackedShadows shadows =
            shadowsOf(ground, test::prismsOn(ground, glm::dvec2(300.0), glm::dvec2(1290.0), 100, 3));
        expectTheFansOn(ground, shadows, 200);
    }
}

/// A box of 4 by 4 m on one triangle of 10 km.
TEST(ShadowDecals, OfAFanOnOneTriangleAreItself) {
    const HeightPyramid level({2, 2, {0.0, -500.0}, {10000.0, 10000.0}, std::vector<float>(4, 3.0f)});
    const PackedShadows shadows = shadowsOf(level, {test::boxAt({800.0, 0.0}, {4.0, 4.0}, 0.2, -5.0, 20.0)});
    ASSERT_EQ(shadows.size(), 1u);
    const ShadowDecals decals = decalsOf(level, shadows);
    EXPECT_EQ(decals.vertices, shadows.corners);
    EXPECT_EQ(decals.triangles.size(), 3 * (shadows.corners.size() - 2));
    EXPECT_EQ(decals.low.z, double(shadows.corners[0].z));
}

/// 20 by 20 m and more over posts every metre: a prism is less.
TEST(ShadowDecals, LeaveOutWhatIsOverManyCells) {
    const HeightPyramid fine({1600, 3, {0.0, 600.0}, {1.0, 30.0}, std::vector<float>(4800, 3.0f)});
    const PackedShadows shadows = shadowsOf(fine, {test::boxAt({800.0, 630.0}, {10.0, 10.0}, 0.2, -5.0, 20.0)});
    ASSERT_TRUE(shadows[0].isFan());
    EXPECT_TRUE(decalsOf(fine, shadows).triangles.empty());
}

TEST(ShadowDecals, LeaveOutWhatIsNoFan) {
    const HeightPyramid ground = groundOf(hills, 160);
    gnomon::PackedParts parts;
    parts.add(
        test::boxAt({600.0, 600.0}, {4.0, 4.0}, 0.2, hills(600.0, 600.0) - 5.0, hills(600.0, 600.0) + 20.0).parts()[0]);
    PackedShadows shadows;
    packedShadows(ground, parts, glm::dvec4(test::sunAt(77.0, 40.0), 0.0), gnomon::TerrainMethod::drape, 0.1, origin,
                  shadows);
    ASSERT_GT(shadows.triangleCount(), 0u);
    EXPECT_TRUE(decalsOf(ground, shadows).triangles.empty());
}

namespace {

std::vector<std::array<glm::dvec3, 3>> trianglesOf(const ShadowDecals& decals) {
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (std::size_t i = 0; i < decals.triangles.size() / 3; ++i) triangles.push_back(triangle(decals, i));
    return triangles;
}

double areaOf(const std::vector<std::array<glm::dvec3, 3>>& triangles) {
    double sum = 0.0;
    for (const auto& t : triangles) sum += area(t);
    return sum;
}

/// By hand, on a level ground of 30 by 30 m with posts every 10 m.
/// @param hole  makes the cell from (10, 10) to (20, 20) one.
ShadowDecals decalsOfOne(gnomon::TerrainOutcome outcome, const std::vector<glm::vec3>& corners,
                         const std::vector<unsigned>& indices, bool hole) {
    std::vector<gnomon::CellCut> cuts(9, gnomon::CellCut::rising);
    if (hole) cuts[4] = gnomon::CellCut::hole;
    const HeightPyramid ground({4, 4, glm::dvec2(origin), {10.0, 10.0}, std::vector<float>(16, 0.0f), origin.z, cuts});
    PackedShadows shadows;
    shadows.origin = origin;
    shadows.corners = corners;
    shadows.indices = indices;
    shadows.cornerEnds = {unsigned(corners.size())};
    shadows.indexEnds = {unsigned(indices.size())};
    shadows.outcomes = {outcome};
    return decalsOf(ground, shadows);
}

} // namespace

TEST(ShadowDecals, LeaveHolesOut) {
    const std::vector<glm::vec3> inside = {
        {2.0f, 2.0f, 0.0f}, {14.0f, 2.0f, 0.0f}, {14.0f, 14.0f, 0.0f}, {2.0f, 14.0f, 0.0f}};
    const ShadowDecals decals = decalsOfOne(gnomon::TerrainOutcome::fan, inside, {}, true);
    EXPECT_NEAR(areaOf(trianglesOf(decals)), 144.0 - 16.0, 1e-4);
}

/// A drape that was made on a coarser ground, 0.3 m off the one that is drawn, is put on it.
TEST(ShadowDecals, OfDrapesInPlaceOfFansLieOnTheGround) {
    const std::vector<glm::vec3> corners = {
        {2.0f, 2.0f, 0.3f}, {14.0f, 2.0f, 0.3f}, {14.0f, 14.0f, 0.3f}, {2.0f, 14.0f, 0.3f}};
    const std::vector<unsigned> both = {0, 1, 2, 0, 2, 3};
    for (const auto outcome :
         {gnomon::TerrainOutcome::steep, gnomon::TerrainOutcome::rough, gnomon::TerrainOutcome::noFan}) {
        const ShadowDecals decals = decalsOfOne(outcome, corners, both, false);
        const auto triangles = trianglesOf(decals);
        EXPECT_NEAR(areaOf(triangles), 144.0, 1e-4);
        for (const auto& t : triangles)
            for (const glm::dvec3& corner : t) EXPECT_EQ(corner.z, origin.z);
    }
}
