// SPDX-License-Identifier: MIT
// Ground from osgTerrain's tiles, against the heights in their layers.
#include "Scene.h"

#include <gnomon/TerrainGround.h>
#include <gnomon/ground/HeightPyramid.h>

#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <gtest/gtest.h>

#include <cmath>

using gnomon::Ground;
using gnomon::groundOf;
using gnomon::GroundTriangle;

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

bool isGrid(const std::shared_ptr<const Ground>& ground) {
    return dynamic_cast<const gnomon::HeightPyramid*>(ground.get());
}

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
