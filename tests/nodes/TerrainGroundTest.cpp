// SPDX-License-Identifier: MIT
// The ground that a subgraph draws, against the heights that it was made from, and from osgTerrain's tiles.
#include "Scene.h"

#include <gnomon/TerrainGround.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/ground/TriangleGround.h>
#include <gnomon/terrain/GroundRevision.h>

#include <gtest/gtest.h>
#include <osg/LOD>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osg/Switch>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>
#include <osgUtil/Optimizer>

#include <cmath>

using namespace scene;

using gnomon::Ground;
using gnomon::groundOf;
using gnomon::groundRevision;
using gnomon::GroundTriangle;
using gnomon::HeightPyramid;

namespace {

constexpr unsigned columns = 31, rows = 21;
constexpr float pitch = 8.0f;

/// Heights of the posts, and linear in each cell's two triangles in between.
float hills(unsigned column, unsigned row) {
    return 12.0f * std::sin(float(column) * 0.4f) * std::cos(float(row) * 0.3f);
}

osg::ref_ptr<osg::HeightField> field(unsigned border = 0) {
    osg::ref_ptr<osg::HeightField> result = new osg::HeightField;
    result->allocate(columns, rows);
    result->setOrigin({-100.0f, 20.0f, 3.0f});
    result->setXInterval(pitch);
    result->setYInterval(pitch);
    result->setBorderWidth(border);
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned column = 0; column < columns; ++column) result->setHeight(column, row, hills(column, row));
    return result;
}

osg::ref_ptr<osg::Geode> drawn(const osg::ref_ptr<osg::HeightField>& shape) {
    return geodeOf(new osg::ShapeDrawable(shape.get()));
}

/// The field's triangles as a plain geometry of double vertices.
osg::ref_ptr<osg::Geode> triangles() {
    const auto shape = field();
    osg::ref_ptr<osg::Vec3dArray> vertices = new osg::Vec3dArray;
    osg::ref_ptr<osg::DrawElementsUInt> list = new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES);
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned column = 0; column < columns; ++column) {
            vertices->push_back(shape->getVertex(column, row));
            if (row + 1 == rows || column + 1 == columns) continue;
            const unsigned a = row * columns + column, d = a + columns;
            for (unsigned index : {a, a + 1, d + 1, a, d + 1, d}) list->push_back(index);
        }
    return geodeOf(geometryOf(vertices, list.get()).get());
}

/// What is the case at a place of the field's frame: (column, row) with fractions.
osg::Vec3d surface(double column, double row) {
    const auto i = std::min(unsigned(column), columns - 2), j = std::min(unsigned(row), rows - 2);
    const double u = column - i, v = row - j, a = double(hills(i, j)), b = double(hills(i + 1, j)),
                 c = double(hills(i + 1, j + 1)), d = double(hills(i, j + 1));
    const double height = u >= v ? a + u * (b - a) + v * (c - b) : a + v * (d - a) + u * (c - d);
    return {-100.0 + column * double(pitch), 20.0 + row * double(pitch), 3.0 + height};
}

/// Compares the ground's height with the surface carried to the root's frame, all over it.
void expectSurface(const Ground& ground, const osg::Matrixd& rootFromField, double tolerance) {
    for (int i = 0; i < 900; ++i) {
        const osg::Vec3d at =
            surface(0.01 + (columns - 1.02) * ((i * 37) % 900) / 900.0, 0.01 + (rows - 1.02) * i / 900.0);
        const osg::Vec3d expected = at * rootFromField;
        const auto height = ground.height(expected.x(), expected.y());
        ASSERT_TRUE(height) << i;
        ASSERT_NEAR(*height, expected.z(), tolerance) << i;
    }
}

bool isGrid(const std::shared_ptr<const Ground>& ground) { return dynamic_cast<const HeightPyramid*>(ground.get()); }

bool isEmpty(const Ground& ground) { return !ground.range(glm::dvec2(-1e9), glm::dvec2(1e9)); }

const osg::Matrixd utm = osg::Matrixd::translate(433000.3, 5410000.7, 812.4);

/// Frames that terrain stands in. Turned about z only: else it is no longer heights over a plan.
const osg::Matrixd frames[] = {
    osg::Matrixd::identity(),
    utm,
    osg::Matrixd::scale(1.0 / 3.0, 3.3, 1.5) * utm,
    osg::Matrixd::rotate(0.7, osg::Vec3d(0, 0, 1)) * utm,
    osg::Matrixd::scale(-1.0, 1.0, 1.0) * osg::Matrixd::rotate(0.7, osg::Vec3d(0, 0, 1)) * utm,
    osg::Matrixd::scale(-1.0, 1.0, 1.0) * utm,
    osg::Matrixd::rotate(-osg::PI_2, osg::Vec3d(0, 0, 1)) * utm,
};

bool isAlongAxes(const osg::Matrixd& frame) { return std::abs(frame(0, 0) * frame(0, 1)) < 1e-9; }

} // namespace

TEST(TerrainGround, HasTheHeightsThatAShapesHeightFieldDraws) {
    for (const osg::Matrixd& frame : frames) {
        const auto root = under(frame, drawn(field()));
        const auto ground = groundOf(*root);
        EXPECT_EQ(isGrid(ground), isAlongAxes(frame));
        expectSurface(*ground, frame, 1e-5); // heights times 1.5 are floats again
    }
}

TEST(TerrainGround, HasTheHeightsOfTrianglesInEveryFrame) {
    for (const osg::Matrixd& frame : frames) {
        const auto ground = groundOf(*under(frame, triangles()));
        EXPECT_EQ(isGrid(ground), isAlongAxes(frame));
        expectSurface(*ground, frame, 1e-5);
    }
}

TEST(TerrainGround, IsInTheFrameThatTheRootStandsIn) {
    const osg::ref_ptr<osg::Group> above = under(osg::Matrixd::translate(7, 7, 7), nullptr);
    const auto root = under(utm, drawn(field()));
    above->addChild(root);
    expectSurface(*groundOf(*root), utm, 1e-5);
}

TEST(TerrainGround, HoldsTheRotationOfTheFieldItself) {
    const auto shape = field();
    const osg::Quat quarter(osg::PI_2, osg::Vec3d(0, 0, 1));
    shape->setRotation(quarter);
    const osg::Vec3d origin(shape->getOrigin());
    const auto turned =
        osg::Matrixd::translate(-origin) * osg::Matrixd::rotate(quarter) * osg::Matrixd::translate(origin);
    expectSurface(*groundOf(*under(utm, drawn(shape))), turned * utm, 1e-5);
    expectSurface(*groundOf(*shape), turned, 1e-5);
}

TEST(TerrainGround, LeavesOutSkirtAndBorder) {
    const auto shape = field(2);
    shape->setSkirtHeight(50.0f);
    for (const osg::Matrixd& frame : frames) {
        const auto ground = groundOf(*under(frame, drawn(shape)));
        const osg::Vec3d inside = surface(2.1, 2.1) * frame, rim = surface(1.9, 9.0) * frame;
        EXPECT_NEAR(ground->height(inside.x(), inside.y()).value_or(1e9), inside.z(), 1e-5);
        EXPECT_FALSE(ground->height(rim.x(), rim.y()));
    }
    EXPECT_TRUE(isEmpty(*groundOf(*drawn(field(15))))) << "nothing is left within the border";
    EXPECT_TRUE(isEmpty(*groundOf(*drawn(field(2147483649u)))));
}

TEST(TerrainGround, HasHolesWhereNothingWasMeasured) {
    const float none[] = {-9999.0f, -99999.0f, -32767.0f, -32768.0f, -3.4e38f, 3.4e38f, std::nanf("")};
    for (const float value : none)
        for (const osg::Matrixd& frame : frames) {
            const auto shape = field();
            shape->setHeight(10, 12, value);
            const auto ground = groundOf(*under(frame, drawn(shape)));
            const osg::Vec3d hole = surface(9.5, 11.4) * frame, beside = surface(11.2, 11.4) * frame;
            EXPECT_FALSE(ground->height(hole.x(), hole.y())) << value;
            EXPECT_NEAR(ground->height(beside.x(), beside.y()).value_or(1e9), beside.z(), 1e-5);
        }
    EXPECT_TRUE(gnomon::isHeight(-9998.0f));
    EXPECT_TRUE(gnomon::isHeight(0.0f));
}

TEST(TerrainGround, TakesSeveralFieldsAndTrianglesTogether) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(under(osg::Matrixd::translate(1000, 0, 0), drawn(field())));
    root->addChild(under(osg::Matrixd::translate(2000, 0, 0), drawn(field())));
    root->addChild(under(osg::Matrixd::translate(3000, 0, 0), triangles()));
    const auto ground = groundOf(*root);
    EXPECT_TRUE(isGrid(ground)) << "1000 is 125 steps";
    root->addChild(triangleAt(500.0));
    EXPECT_FALSE(isGrid(groundOf(*root)));
    for (const double east : {1000.0, 2000.0, 3000.0})
        expectSurface(*ground, osg::Matrixd::translate(east, 0, 0), 1e-5);
    EXPECT_FALSE(ground->height(500.0, 50.0));
    EXPECT_FALSE(ground->height(1500.0, 50.0));
}

TEST(TerrainGround, IsOnlyWhatTheSelectionTakes) {
    const osg::ref_ptr<osg::Group> root = new osg::Group, terrain = new osg::Group;
    const auto house = triangleAt(50.0);
    house->setNodeMask(2);
    root->addChild(terrain);
    root->addChild(house);
    terrain->addChild(drawn(field()));
    EXPECT_FALSE(isGrid(groundOf(*root)));
    EXPECT_TRUE(isGrid(groundOf(*root, {terrain, ~0u})));
    EXPECT_TRUE(isGrid(groundOf(*root, {nullptr, ~2u})));
    EXPECT_FALSE(isEmpty(*groundOf(*root, {house, ~0u})));
}

TEST(TerrainGround, OfALodIsTheMostDetailedChildAndOfASwitchWhatIsOn) {
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(triangleAt(0.0), 500.0f, 1e9f);
    lod->addChild(drawn(field()), 0.0f, 500.0f);
    osg::ref_ptr<osg::Switch> both = new osg::Switch;
    both->addChild(lod, true);
    both->addChild(triangles(), false);
    EXPECT_TRUE(isGrid(groundOf(*both)));
    expectSurface(*groundOf(*both), osg::Matrixd::identity(), 1e-5);
}

TEST(TerrainGround, OfNothingOrOfASingleTriangle) {
    const osg::ref_ptr<osg::Group> empty = new osg::Group;
    EXPECT_TRUE(isEmpty(*groundOf(*empty)));
    EXPECT_FALSE(groundOf(*empty)->height(0.0, 0.0));
    const auto none = osg::ref_ptr<osg::HeightField>(new osg::HeightField);
    EXPECT_TRUE(isEmpty(*groundOf(*none))) << "a field without posts";
    EXPECT_TRUE(isEmpty(*groundOf(*drawn(none))));
    const auto one = groundOf(*triangleAt(3.0));
    EXPECT_FALSE(isEmpty(*one));
    EXPECT_EQ(one->height(3.2, 0.2), 0.0);
    const auto point = groundOf(*geodeOf(geometryOf(vec3s({{1, 1, 1}}), new osg::DrawArrays(GL_POINTS, 0, 1)).get()));
    EXPECT_TRUE(isEmpty(*point));
}

TEST(TerrainGround, IsWhatIsDrawnWhereAnOptimizerMovedTheVerticesAndLeftTheShape) {
    const osg::ref_ptr<osg::Group> above = new osg::Group;
    const auto moved = under(osg::Matrixd::scale(2.0, 2.0, 2.0), drawn(field()));
    moved->setDataVariance(osg::Object::STATIC);
    above->addChild(moved);
    osgUtil::Optimizer().optimize(above, osgUtil::Optimizer::FLATTEN_STATIC_TRANSFORMS);
    ASSERT_FALSE(above->getChild(0)->asTransform()) << "else nothing was moved";
    expectSurface(*groundOf(*above), osg::Matrixd::scale(2.0, 2.0, 2.0), 1e-3); // of floats up to 560
}

TEST(GroundRevision, TellsLevelsOfDetailThoughTheyAreDrawnOutsideToo) {
    const osg::ref_ptr<osg::Node> fine = triangleAt(0.0);
    const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(fine, 0.0f, 1e6f);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(fine);
    EXPECT_FALSE(groundRevision(*root, {}, nullptr)->hasLevels);
    root->addChild(lod);
    EXPECT_TRUE(groundRevision(*root, {}, nullptr)->hasLevels);
}

// Heights are told in the group's frame, wherever either of them stands.
TEST(GroundRevision, IsAnotherWhereTheGroundMovesAndWhereTheGroupMovesBesideIt) {
    const auto ground = under(osg::Matrixd::translate(0.0, 0.0, 5.0), triangleAt(3.0)),
               group = under(osg::Matrixd(), new osg::Group);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(ground);
    root->addChild(group);
    osg::ref_ptr<const gnomon::GroundRevision> known;
    const auto height = [&] {
        known = groundRevision(*group, {ground, ~0u}, known);
        return known->ground->height(3.2, 0.2).value_or(1e9);
    };
    EXPECT_NEAR(height(), 5.0, 1e-5); // heights are floats
    ground->setMatrix(osg::Matrixd::translate(0.0, 0.0, 7.0));
    EXPECT_NEAR(height(), 7.0, 1e-5);
    group->setMatrix(osg::Matrixd::translate(0.0, 0.0, 1.0));
    EXPECT_NEAR(height(), 6.0, 1e-5);
    EXPECT_EQ(groundRevision(*group, {ground, ~0u}, known), known) << "all stands still";
}

namespace tiles {
namespace {

constexpr unsigned posts = 33;
constexpr double side = 3141.7, east = 433000.0, north = 5410000.0; ///< of a tile and of the first one's corner.

/// Over the whole map, tiles after one another along x.
float hills(unsigned tile, unsigned column, unsigned row) {
    const auto x = float(tile * (posts - 1) + column);
    return 800.0f + 90.0f * std::sin(x * 0.2f) * std::cos(float(row) * 0.25f);
}

osg::ref_ptr<osg::HeightField> field(unsigned tile) {
    osg::ref_ptr<osg::HeightField> result = new osg::HeightField;
    result->allocate(posts, posts);
    for (unsigned row = 0; row < posts; ++row)
        for (unsigned column = 0; column < posts; ++column) result->setHeight(column, row, hills(tile, column, row));
    return result;
}

osg::ref_ptr<osgTerrain::Locator> locator(unsigned tile) {
    osg::ref_ptr<osgTerrain::Locator> result = new osgTerrain::Locator;
    result->setTransformAsExtents(east + tile * side, north, east + (tile + 1) * side, north + side);
    return result;
}

osg::ref_ptr<osgTerrain::TerrainTile> tileOf(osgTerrain::Layer* layer, unsigned tile) {
    layer->setLocator(locator(tile));
    osg::ref_ptr<osgTerrain::TerrainTile> result = new osgTerrain::TerrainTile;
    result->setElevationLayer(layer);
    return result;
}

osg::ref_ptr<osgTerrain::TerrainTile> tile(unsigned number, const osg::ref_ptr<osg::HeightField>& heights) {
    return tileOf(new osgTerrain::HeightFieldLayer(heights.get()), number);
}

double postX(unsigned tile, unsigned column) { return east + side * (tile + column / double(posts - 1)); }
double postY(unsigned row) { return north + side * row / double(posts - 1); }

/// To 1 mm at every post that is not at the border: tiles are drawn in floats about their middles.
void expectPosts(const Ground& ground, unsigned tile, double scale = 1.0) {
    for (unsigned row = 1; row + 1 < posts; ++row)
        for (unsigned column = 1; column + 1 < posts; ++column)
            ASSERT_NEAR(ground.height(postX(tile, column), postY(row)).value_or(1e9),
                        scale * double(hills(tile, column, row)), 1e-3)
                << column << ", " << row;
}

} // namespace

TEST(TerrainTile, IsAGridAtItsPlaceOnTheMapWithoutItsSkirt) {
    const auto heights = field(0);
    const auto plain = groundOf(*tile(0, heights));
    EXPECT_TRUE(isGrid(plain));
    expectPosts(*plain, 0);
    EXPECT_FALSE(plain->height(east - 1.0, north + 100.0));
    heights->setSkirtHeight(40.0f);
    const auto skirted = groundOf(*tile(0, heights));
    EXPECT_TRUE(isGrid(skirted));
    expectPosts(*skirted, 0);
}

TEST(TerrainTile, IsCutAsItIsDrawn) {
    const auto root = tile(0, field(0));
    const auto ground = groundOf(*root);
    int compared = 0;
    for (const scene::Corners& t : scene::trianglesOf(*root)) {
        const osg::Vec3d middle = (t[0] + t[1] + t[2]) / 3.0;
        ASSERT_NEAR(ground->height(middle.x(), middle.y()).value_or(1e9), middle.z(), 1e-3);
        ++compared;
    }
    EXPECT_EQ(compared, int(2 * (posts - 1) * (posts - 1)));
}

TEST(TerrainTile, MakesOneGridWithItsNeighbours) {
    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    for (unsigned number = 0; number < 3; ++number) {
        const auto next = tile(number, field(number));
        next->setTileID({0, int(number), 0});
        terrain->addChild(next);
    }
    const auto ground = groundOf(*terrain);
    EXPECT_TRUE(isGrid(ground));
    for (unsigned number = 0; number < 3; ++number) expectPosts(*ground, number);
    EXPECT_TRUE(ground->height(postX(1, 0), postY(5) + 1.0));
}

TEST(TerrainTile, IsAsHighAsTheTerrainDrawsIt) {
    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    terrain->setVerticalScale(2.0f);
    terrain->addChild(tile(0, field(0)));
    expectPosts(*groundOf(*terrain), 0, 2.0);
}

TEST(TerrainTile, HasHolesWhereItsOperatorFindsNoData) {
    const auto heights = field(0);
    heights->setHeight(10, 12, -500.0f);
    const auto root = tile(0, heights);
    root->getElevationLayer()->setValidDataOperator(new osgTerrain::NoDataValue(-500.0f));
    const auto ground = groundOf(*root);
    EXPECT_FALSE(ground->height(postX(0, 10), postY(12)));
    EXPECT_FALSE(ground->height(postX(0, 10) - 20.0, postY(12) + 20.0));
    EXPECT_TRUE(ground->height(postX(0, 9) + 10.0, postY(11) + 10.0)) << "a cell with three heights is drawn by half";
    for (const auto& [column, row] : {std::pair{8u, 12u}, {12u, 12u}, {10u, 10u}, {10u, 14u}})
        EXPECT_NEAR(ground->height(postX(0, column), postY(row)).value_or(1e9), double(hills(0, column, row)), 1e-3);
}

TEST(TerrainTile, MayHaveItsHeightsInAnImage) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(posts, posts, 1, GL_LUMINANCE, GL_FLOAT);
    for (unsigned row = 0; row < posts; ++row)
        for (unsigned column = 0; column < posts; ++column)
            *reinterpret_cast<float*>(image->data(column, row)) = hills(0, column, row);
    expectPosts(*groundOf(*tileOf(new osgTerrain::ImageLayer(image), 0)), 0);
}

} // namespace tiles
