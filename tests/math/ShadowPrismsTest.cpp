// SPDX-License-Identifier: MIT
// Prisms over shadows: what they hold, by the winding number of their surface about points, in double.
#include "Houses.h"

#include <gnomon/overlay/ShadowPrisms.h>
#include <gtest/gtest.h>

#include <map>

using gnomon::Drape;
using gnomon::ShadowPrisms;
using gnomon::shadowPrisms;

namespace {

/// How often closed surfaces go round a point: the sum of their triangles' solid angles (A. Van Oosterom and
/// J. Strackee 1983) over 4 pi.
double winding(const ShadowPrisms& prisms, const std::vector<unsigned>& triangles, const glm::dvec3& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const glm::dvec3 a = glm::dvec3(prisms.vertices[triangles[i]]) - p,
                         b = glm::dvec3(prisms.vertices[triangles[i + 1]]) - p,
                         c = glm::dvec3(prisms.vertices[triangles[i + 2]]) - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (4.0 * 180.0 * test::degree);
}

Drape square(double x, double y, double side, double z = 0.0) {
    const glm::dvec3 a(x, y, z), b(x + side, y, z), c(x + side, y + side, z), d(x, y + side, z);
    return {a, b, c, a, c, d};
}

bool covers(const Drape& shadow, const glm::dvec2& p) { return test::over(shadow, p) > 0; }

TEST(ShadowPrisms, HoldWhatIsOverTheirShadowsHalfADiameterUpAndDown) {
    const Drape shadow = square(10.0, 20.0, 4.0, 7.0);
    const ShadowPrisms prisms = shadowPrisms({shadow}, {10.0, 20.0, 0.0});
    ASSERT_EQ(prisms.layers.size(), 1u);
    EXPECT_EQ(prisms.layers[0].size() / 3, 12u) << "4 n - 4 of a square";
    const double reach = 0.5 * std::sqrt(32.0);
    for (const double z : {7.0 - 0.99 * reach, 7.0, 7.0 + 0.99 * reach})
        EXPECT_NEAR(winding(prisms, prisms.layers[0], {1.0, 3.0, z}), 1.0, 1e-6) << z;
    for (const glm::dvec3& out : {glm::dvec3(1.0, 3.0, 7.0 + 1.01 * reach), glm::dvec3(1.0, 3.0, 7.0 - 1.01 * reach),
                                  glm::dvec3(-0.1, 3.0, 7.0), glm::dvec3(1.0, 4.1, 7.0)})
        EXPECT_NEAR(winding(prisms, prisms.layers[0], out), 0.0, 1e-6) << out.x << " " << out.z;
    EXPECT_NEAR(prisms.high.z, 7.0 + reach, 1e-9);
}

/// Walls within a shadow would go twice through what the stencil counts.
TEST(ShadowPrisms, HaveWallsAlongTheOutlineAlone) {
    Drape shadow;
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x) {
            Drape part = square(x * (1.0 + 1e-9), y, 1.0); // neighbours' corners as rounding leaves them
            shadow.insert(shadow.end(), part.begin(), part.end());
        }
    const ShadowPrisms prisms = shadowPrisms({shadow}, {});
    EXPECT_EQ(prisms.layers.at(0).size() / 3, 2u * 50u + 2u * 20u);
    EXPECT_EQ(prisms.vertices.size(), 2u * 36u);
}

TEST(ShadowPrisms, OfTrianglesOverOneAnotherHoldEveryPlaceThatOneCovers) {
    Drape folded = square(0.0, 0.0, 2.0);
    std::swap(folded[4], folded[5]); // one triangle is turned over
    const Drape over = square(1.0, 1.0, 2.0);
    folded.insert(folded.end(), over.begin(), over.end());
    const ShadowPrisms prisms = shadowPrisms({folded}, {});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-0.5, 3.5);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 p(place(random), place(random));
        const int expected = covers(square(0.0, 0.0, 2.0), p) || covers(over, p);
        int most = 0;
        for (const auto& layer : prisms.layers) {
            const double here = winding(prisms, layer, {p, 0.0});
            EXPECT_LT(here, 1.0 + 1e-4) << "nothing in a layer overlaps";
            most = std::max(most, static_cast<int>(std::lround(here)));
        }
        EXPECT_EQ(most, expected) << p.x << " " << p.y;
    }
}

/// A bridge and the ground below it.
TEST(ShadowPrisms, OfStoreysAreInLayersOfTheirOwn) {
    Drape storeys = square(0.0, 0.0, 2.0, 5.0);
    const Drape below = square(0.0, 0.0, 2.0, 1.0);
    storeys.insert(storeys.end(), below.begin(), below.end());
    const ShadowPrisms prisms = shadowPrisms({storeys}, {});
    ASSERT_EQ(prisms.layers.size(), 2u);
    for (const auto& layer : prisms.layers) EXPECT_NEAR(winding(prisms, layer, {1.0, 0.7, 3.0}), 1.0, 1e-6);
}

TEST(ShadowPrisms, OfOneLayerDoNotOverlapAndAllAreThere) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(0.0, 100.0), side(0.5, 12.0);
    std::vector<Drape> shadows;
    for (int i = 0; i < 150; ++i) shadows.push_back(square(place(random), place(random), side(random), place(random)));
    const glm::dvec3 origin(433000.0, 5410000.0, 200.0);
    std::vector<Drape> far = shadows;
    for (Drape& shadow : far)
        for (glm::dvec3& corner : shadow) corner += origin;
    const ShadowPrisms prisms = shadowPrisms(far, origin);
    EXPECT_GT(prisms.layers.size(), 1u);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 p(place(random), place(random), 50.0);
        double all = 0.0;
        for (const auto& layer : prisms.layers) {
            const double here = winding(prisms, layer, p);
            EXPECT_LT(here, 1.0 + 1e-4);
            all += here;
        }
        double expected = 0.0;
        for (const Drape& shadow : shadows) {
            const double reach = 0.5 * glm::length(glm::dvec2(shadow[1] - shadow[0])) * std::sqrt(2.0);
            expected += covers(shadow, glm::dvec2(p)) && std::abs(p.z - shadow[0].z) <= reach;
        }
        EXPECT_NEAR(all, expected, 1e-3) << p.x << " " << p.y;
    }
}

/// Of a tile: each holds the ground under its shadow, but for what the margin gives no more.
TEST(ShadowPrisms, OfATileHoldTheGroundUnderTheirShadowsAndNoMoreThanTheirMargin) {
    const gnomon::HeightPyramid ground =
        test::groundOf([](double x, double y) { return 20.0 * std::sin(x * 0.02) + 10.0 * std::cos(y * 0.03); }, 60);
    const glm::dvec4 sun(test::sunAt(140.0, 25.0), 0.0);
    gnomon::PackedParts parts;
    for (const test::Prism& prism : test::prismsOn(ground, glm::dvec2(150.0), glm::dvec2(450.0), 80, 3))
        for (const gnomon::ConvexPart& part : prism.parts()) parts.add(part);
    ShadowPrisms prisms;
    for (const auto method : {gnomon::TerrainMethod::drape, gnomon::TerrainMethod::hull}) { // into used memory
        gnomon::PackedShadows shadows;
        packedShadows(ground, parts, sun, method, 0.0, {300.0, 300.0, 0.0}, shadows);
        shadowPrisms(ground, shadows, 0.05, nullptr, prisms);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> place(160.0, 440.0);
        unsigned most = 0;
        for (int i = 0; i < 400; ++i) {
            const glm::dvec2 p(place(random), place(random));
            const double z = *ground.height(p.x, p.y);
            unsigned expected = 0, found = 0, far = 0;
            for (std::size_t k = 0; k < shadows.size(); ++k) expected += covers(shadows.triangles(k), p);
            for (const auto& layer : prisms.layers) {
                const int here = static_cast<int>(std::lround(winding(prisms, layer, glm::dvec3(p - 300.0, z))));
                EXPECT_LE(here, 1);
                found += unsigned(here);
                far += unsigned(std::lround(winding(prisms, layer, glm::dvec3(p - 300.0, z + 70.0))));
            }
            EXPECT_EQ(found, expected) << p.x << " " << p.y;
            EXPECT_EQ(far, 0u) << "70 m over the ground";
            most = std::max(most, found);
        }
        EXPECT_GE(prisms.mostOver, most);
        EXPECT_LE(prisms.mostOver, 30u) << "of 100 parts";
        EXPECT_GT(most, 1u);
    }
    shadowPrisms(ground, {}, 0.05, nullptr, prisms);
    EXPECT_TRUE(prisms.layers.empty() && prisms.vertices.empty());
}

TEST(ShadowPrisms, OfNothingAreNone) {
    EXPECT_TRUE(shadowPrisms({}, {}).layers.empty());
    EXPECT_TRUE(shadowPrisms({{}, {}}, {}).layers.empty());
    const glm::dvec3 point(1.0, 2.0, 3.0);
    EXPECT_TRUE(shadowPrisms({{point, point, point}}, {}).layers.empty()) << "no area";
    const double nan = std::nan("");
    EXPECT_TRUE(shadowPrisms({{point, {nan, 0.0, 0.0}, {5.0, 5.0, nan}}}, {}).layers.empty());
}

} // namespace
