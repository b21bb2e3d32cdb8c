// SPDX-License-Identifier: MIT
// Bitmaps of shadows: areas and edges by hand, and the ground under them.
#include "GroundTriangles.h"
#include "Houses.h"

#include <gnomon/overlay/ShadowBitmap.h>
#include <gtest/gtest.h>

#include <cmath>

using gnomon::HeightPyramid;
using gnomon::PackedShadows;
using gnomon::ShadowBitmap;

namespace {

const glm::dvec3 origin(800.0, 800.0, 20.0);

/// 100 by 100 m from the origin on, posts every 10 m, as high as x. @param hole  makes the cell from (30, 30) one.
HeightPyramid slope(gnomon::CellCut cut = gnomon::CellCut::rising, bool hole = false) {
    std::vector<float> heights;
    for (int y = 0; y <= 10; ++y)
        for (int x = 0; x <= 10; ++x) heights.push_back(float(10 * x));
    std::vector<gnomon::CellCut> cuts(100, cut);
    if (hole) cuts[33] = gnomon::CellCut::hole;
    return HeightPyramid({11, 11, glm::dvec2(origin), {10.0, 10.0}, heights, origin.z, cuts});
}

/// A fan of each polygon, corners in plan about the origin.
PackedShadows fans(const std::vector<std::vector<glm::vec2>>& polygons) {
    PackedShadows shadows;
    shadows.origin = origin;
    for (const auto& polygon : polygons) {
        for (const glm::vec2& corner : polygon) shadows.corners.emplace_back(corner, corner.x);
        shadows.cornerEnds.push_back(unsigned(shadows.corners.size()));
        shadows.indexEnds.push_back(0);
        shadows.outcomes.push_back(gnomon::TerrainOutcome::fan);
    }
    return shadows;
}

ShadowBitmap bitmapOf(const HeightPyramid& ground, const PackedShadows& shadows, double texel) {
    ShadowBitmap bitmap;
    shadowBitmap(ground, shadows, texel, bitmap);
    return bitmap;
}

/// Takes each texel, and where its middle is.
template <class Take>
void eachTexel(const ShadowBitmap& bitmap, const Take& take) {
    for (int y = 0; y < bitmap.rows * ShadowBitmap::high; ++y)
        for (int x = 0; x < bitmap.columns * ShadowBitmap::wide; ++x)
            take(bitmap.isSet(x, y), bitmap.low + bitmap.texel * (glm::dvec2(x, y) + 0.5));
}

double areaOf(const ShadowBitmap& bitmap) {
    double area = 0.0;
    eachTexel(bitmap, [&](bool isSet, const glm::dvec2&) { area += isSet ? bitmap.texel * bitmap.texel : 0.0; });
    return area;
}

const std::vector<glm::vec2> turned = {{50.0f, 46.0f}, {54.0f, 50.0f}, {50.0f, 54.0f}, {46.0f, 50.0f}};

} // namespace

/// A square on its corner, |x - 50| + |y - 50| <= 4, of 32 square metres; rounding of its corners is below 1e-4 m.
TEST(ShadowBitmap, HoldsTheTexelsWhoseMiddlesAreInAShadow) {
    for (const double texel : {0.05, 0.3, 1.7}) {
        const ShadowBitmap bitmap = bitmapOf(slope(), fans({turned}), texel);
        int seen = 0;
        eachTexel(bitmap, [&](bool isSet, const glm::dvec2& at) {
            const double off = 4.0 - std::abs(at.x - 50.0) - std::abs(at.y - 50.0);
            EXPECT_TRUE(std::abs(off) <= 1e-4 || isSet == (off > 0.0)) << at.x << " " << at.y;
            seen += isSet;
        });
        EXPECT_GT(seen, 0);
        // What an edge goes through are at most 1.5 texels a texel's length of it, of which half are too many or too few.
        EXPECT_NEAR(areaOf(bitmap), 32.0, 0.75 * 16.0 * std::sqrt(2.0) * texel);
    }
}

/// Pixels beside it are taken for the nearest at its border.
TEST(ShadowBitmap, IsEmptyAtItsBorder) {
    const ShadowBitmap bitmap =
        bitmapOf(slope(), fans({turned, {{20.0f, 20.0f}, {28.0f, 20.0f}, {28.0f, 28.0f}}}), 0.5);
    const int right = bitmap.columns * ShadowBitmap::wide - 1, top = bitmap.rows * ShadowBitmap::high - 1;
    for (int i = 0; i <= right; ++i) EXPECT_FALSE(bitmap.isSet(i, 0) || bitmap.isSet(i, top));
    for (int i = 0; i <= top; ++i) EXPECT_FALSE(bitmap.isSet(0, i) || bitmap.isSet(right, i));
}

/// A fan whose first corner alone sees all others: an L of 2.5 square metres, whose hull has 3.
TEST(ShadowBitmap, FollowsFansThatAreNotConvex) {
    const ShadowBitmap bitmap = bitmapOf(
        slope(), fans({{{21.0f, 21.0f}, {20.0f, 22.0f}, {20.0f, 20.0f}, {22.0f, 20.0f}, {22.0f, 21.0f}}}), 0.01);
    EXPECT_NEAR(areaOf(bitmap), 2.5, 0.05) << "the L, not its hull";
}

/// Cells under the bounds of a shadow, cut as the ground is, and no holes.
TEST(ShadowBitmap, LiesOnTheGroundsOwnTriangles) {
    for (const auto cut : {gnomon::CellCut::rising, gnomon::CellCut::falling}) {
        const ShadowBitmap bitmap =
            bitmapOf(slope(cut, true), fans({turned, {{25.0f, 35.0f}, {38.0f, 35.0f}, {38.0f, 38.0f}}}), 0.5);
        // Four cells about (50, 50), and two of which one is a hole.
        ASSERT_EQ(bitmap.triangles.size(), 3u * 2u * 5u);
        double area = 0.0;
        for (std::size_t i = 0; i < bitmap.triangles.size(); i += 3) {
            glm::dvec3 corners[3];
            for (std::size_t k = 0; k < 3; ++k) {
                corners[k] = glm::dvec3(bitmap.vertices[bitmap.triangles[i + k]]);
                EXPECT_NEAR(corners[k].z, corners[k].x, 1e-4);
            }
            const double one = 0.5 * gnomon::doubleArea(corners[0], corners[1], corners[2]);
            EXPECT_NEAR(one, 50.0, 1e-3) << "counter-clockwise, half a cell";
            area += one;
            // Of a rising cell the longest edge goes up to the right.
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 edge = corners[(k + 1) % 3] - corners[k];
                if (glm::length(glm::dvec2(edge)) > 12.0) {
                    EXPECT_EQ(edge.x * edge.y > 0.0, cut == gnomon::CellCut::rising);
                }
            }
        }
        EXPECT_NEAR(area, 500.0, 1e-2);
    }
}

TEST(ShadowBitmap, OfNothingIsEmpty) {
    const ShadowBitmap bitmap = bitmapOf(slope(), fans({}), 0.5);
    EXPECT_TRUE(bitmap.bytes.empty() && bitmap.triangles.empty());
}
