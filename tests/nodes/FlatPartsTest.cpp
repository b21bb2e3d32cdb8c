// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <gnomon/FlatParts.h>

#include <osg/ShapeDrawable>

#include <gtest/gtest.h>

#include <cmath>

using namespace scene;
using gnomon::FlatPart;
using gnomon::flatParts;
using Mode = osg::PrimitiveSet::Mode;

namespace {

/// n × n squares of side `side` in the plane through `corner` along `u` and `v`, as one indexed Geometry.
template <class Array = osg::Vec3Array>
osg::ref_ptr<osg::Geometry> grid(unsigned n, const osg::Vec3d& corner, const osg::Vec3d& u, const osg::Vec3d& v) {
    osg::ref_ptr<Array> vertices = new Array;
    osg::ref_ptr<osg::DrawElementsUInt> quads = new osg::DrawElementsUInt(Mode::QUADS);
    for (unsigned j = 0; j <= n; ++j)
        for (unsigned i = 0; i <= n; ++i) vertices->push_back(typename Array::ElementDataType(corner + u * i + v * j));
    for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i) {
            const unsigned at = j * (n + 1) + i;
            for (unsigned index : {at, at + 1, at + n + 2, at + n + 1}) quads->push_back(index);
        }
    return geometryOf(vertices, quads.get());
}

osg::Vec3d normalOf(const FlatPart& part) { return {part.plane.x(), part.plane.y(), part.plane.z()}; }

} // namespace

TEST(FlatParts, AGroundOfOneQuadOrOfManyIsOnePlaneThatLooksUp) {
    for (const auto& [quads, side] : {std::pair(1, 10.0), {50, 0.2}}) {
        const auto parts = flatParts(*grid(unsigned(quads), {-5, -5, 2}, {side, 0, 0}, {0, side, 0}));
        ASSERT_EQ(parts.size(), 1u);
        EXPECT_EQ(parts[0].plane, osg::Vec4d(0, 0, 1, -2));
        EXPECT_NEAR(parts[0].area, 100.0, 1e-4); // 0.2 is not a float: the corners are off by 5e-7 of ten at most
    }
}

TEST(FlatParts, ASlopeWhoseCornersAreRoundedIsOnePlane) {
    // Slope 1:3 and 1:7: no corner is a float, so every triangle has a plane a little of its own.
    const auto parts = flatParts(*grid(40, {100.1, 200.2, 30.3}, {0.7, 0, 0.7 / 3}, {0, 0.9, 0.9 / 7}));
    ASSERT_EQ(parts.size(), 1u);
    osg::Vec3d normal(-1.0 / 3, -1.0 / 7, 1);
    const double area = 28.0 * 36.0 * normal.length();
    normal.normalize();
    EXPECT_LT((normalOf(parts[0]) - normal).length(), 1e-6); // a rounding of 2e-5 at most, over a width of 28
    EXPECT_NEAR(parts[0].area, area, 1e-2);                  // the same on either side
}

TEST(FlatParts, ASlopeInDoublesIsOnePlaneFarAwayToo) {
    const auto slope = grid<osg::Vec3dArray>(40, {6.4e6, 6.4e6, 30.3}, {0.7, 0, 0.7 / 3}, {0, 0.9, 0.9 / 7});
    EXPECT_EQ(flatParts(*slope).size(), 1u);
}

TEST(FlatParts, ABoxHasSixTheLargestFirst) {
    const osg::ref_ptr<osg::ShapeDrawable> box = new osg::ShapeDrawable(new osg::Box(osg::Vec3(1, 2, 3), 2, 4, 8));
    const auto parts = flatParts(*box);
    ASSERT_EQ(parts.size(), 6u);
    const double areas[] = {32, 32, 16, 16, 8, 8};    // 4 × 8, 2 × 8, 2 × 4
    const double depths[] = {-1, -1, -2, -2, -4, -4}; // of the centre behind each side
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_DOUBLE_EQ(parts[i].area, areas[i]);
        EXPECT_DOUBLE_EQ(normalOf(parts[i]) * osg::Vec3d(1, 2, 3) + parts[i].plane.w(), depths[i]);
        EXPECT_DOUBLE_EQ(std::abs(normalOf(parts[i])[static_cast<int>(i / 2)]), 1.0);
    }
}

TEST(FlatParts, PlanesAStepApartAreTwo) {
    osg::ref_ptr<osg::Group> steps = new osg::Group;
    steps->addChild(grid(4, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    steps->addChild(grid(3, {4, 0, 0.001}, {1, 0, 0}, {0, 1, 0}));
    const auto parts = flatParts(*steps);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_DOUBLE_EQ(parts[0].area, 16.0);
    EXPECT_DOUBLE_EQ(parts[1].area, 9.0);
    EXPECT_NEAR(parts[1].plane.w(), -0.001, 1e-10); // a float of that size
}

TEST(FlatParts, TwoSidesOfASheetAreTwo) {
    osg::ref_ptr<osg::Group> sheet = new osg::Group;
    sheet->addChild(grid(1, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    sheet->addChild(grid(1, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}));
    const auto parts = flatParts(*sheet);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(normalOf(parts[0]), -normalOf(parts[1]));
}

TEST(FlatParts, AMirroredGroundStillLooksUp) {
    const auto parts = flatParts(*under(osg::Matrix::scale(1, -1, 1), grid(1, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}).get()));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(normalOf(parts[0]), osg::Vec3d(0, 0, 1));
}

TEST(FlatParts, AreTheSameInAnyUnitAndFarAway) {
    for (double scale : {1e-3, 1.0, 1e3})
        for (double away : {0.0, 6.4e6}) {
            osg::ref_ptr<osg::ShapeDrawable> box = new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 2, 4, 8));
            const osg::Matrixd matrix = osg::Matrix::scale(scale, scale, scale) * osg::Matrix::translate(away, away, 0);
            const auto parts = flatParts(*under(matrix, box.get()));
            ASSERT_EQ(parts.size(), 6u) << scale << ' ' << away;
            EXPECT_NEAR(parts[0].area, 32.0 * scale * scale, 1e-5 * scale * scale); // doubles at 6.4e6 are 1e-9 apart
        }
}

TEST(FlatParts, ASphereHasManyAndOnlyTheLargestAreReturned) {
    const osg::ref_ptr<osg::ShapeDrawable> sphere = new osg::ShapeDrawable(new osg::Sphere);
    EXPECT_GT(flatParts(*sphere, 100000).size(), 100u);
    const auto parts = flatParts(*sphere, 10);
    ASSERT_EQ(parts.size(), 10u);
    for (std::size_t i = 1; i < 10; ++i) EXPECT_GE(parts[i - 1].area, parts[i].area);
}

TEST(FlatParts, AnEmptySceneHasNone) {
    EXPECT_TRUE(flatParts(*osg::ref_ptr<osg::Group>(new osg::Group)).empty());
    EXPECT_TRUE(
        flatParts(*geometryOf(vec3s({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), new osg::DrawArrays(Mode::TRIANGLES, 0, 3)))
            .empty())
        << "a triangle of no area has no plane";
}
