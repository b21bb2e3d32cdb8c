// SPDX-License-Identifier: MIT
// The shadows that a town's tiles hold, against those of each of its houses alone.
#include "Scene.h"

#include <support/TerrainTrial.h>

#include <gnomon/HeightPyramid.h>
#include <gnomon/TerrainTiles.h>

#include <osg/ShapeDrawable>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using gnomon::TerrainMethod;
using gnomon::TerrainShadowGeode;
using gnomon::TerrainTown;

namespace {

constexpr int posts = 100, houses = 600; // more than two tiles hold
constexpr double pitch = 10.0, error = 0.1;

gnomon::HeightPyramid hillyGround() {
    std::vector<float> heights;
    for (int j = 0; j < posts; ++j)
        for (int i = 0; i < posts; ++i) heights.push_back(float(test::hills(pitch * i, pitch * j)));
    return gnomon::HeightPyramid({posts, posts, {0.0, 0.0}, {pitch, pitch}, heights});
}

/// Boxes of all sizes and headings that reach 6 m into the ground, apart from one another.
osg::ref_ptr<osg::Group> townOnHills() {
    std::mt19937 dice(7);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    osg::ref_ptr<osg::Group> town = new osg::Group;
    for (int i = 0; i < houses; ++i) {
        const double x = 100.0 + 30.0 * (i % 25), y = 100.0 + 30.0 * (i / 25), height = 10.0 + 8.0 * any(dice);
        const auto size = osg::Vec3(float(4.0 + 8.0 * any(dice)), float(4.0 + 8.0 * any(dice)), float(height));
        osg::ref_ptr<osg::MatrixTransform> place =
            new osg::MatrixTransform(osg::Matrixd::rotate(6.28 * any(dice), osg::Z_AXIS) *
                                     osg::Matrixd::translate(x, y, test::hills(x, y) + height / 2.0 - 6.0));
        place->addChild(new osg::ShapeDrawable(new osg::Box(osg::Vec3(), size.x(), size.y(), size.z())));
        town->addChild(place);
    }
    return town;
}

using Corners = std::vector<std::array<float, 3>>;

/// Of a shadow's triangles, about the origin, as the tiles keep them.
Corners cornersOf(const gnomon::Drape& triangles, const glm::dvec3& origin) {
    Corners corners;
    for (const glm::dvec3& corner : triangles) {
        const glm::vec3 local(corner - origin);
        corners.push_back({local.x, local.y, local.z});
    }
    return corners;
}

/// By the way that takes one object.
std::vector<Corners> oneByOne(osg::Group& town, const gnomon::Ground& ground, const glm::dvec4& sun,
                              TerrainMethod method, const glm::dvec3& origin) {
    std::vector<Corners> result;
    for (unsigned i = 0; i < town.getNumChildren(); ++i) {
        gnomon::VertexTraverser traverser;
        town.getChild(i)->accept(traverser);
        const osg::ref_ptr<gnomon::CasterMesh> mesh = new gnomon::CasterMesh(traverser);
        for (const gnomon::ConvexPart& part : gnomon::partsOf(*mesh))
            result.push_back(cornersOf(gnomon::terrainShadow(ground, part, sun, method, error).triangles, origin));
    }
    std::sort(result.begin(), result.end());
    return result;
}

} // namespace

TEST(TerrainTown, HasTheShadowsOfEachHouseAloneBitForBit) {
    const gnomon::HeightPyramid ground = hillyGround();
    const osg::ref_ptr<osg::Group> root = townOnHills();
    TerrainTown town(false);
    town.take(*gnomon::CasterPieces::of(*root, {}, nullptr), {});
    ASSERT_GE(town.tiles().size(), 3u);
    const glm::dvec4 sun(test::sunAt(250.0, 35.0), 0.0);
    for (const auto method : {TerrainShadowGeode::HULL, TerrainShadowGeode::DRAPE}) {
        gnomon::TerrainTiles tiles;
        tiles.update(town, {ground, &ground, 0.05}, sun, {method, error, {}}, 0.0);
        std::vector<Corners> found;
        for (const auto& tile : tiles.shadows())
            for (std::size_t i = 0; i < tile->found.size(); ++i)
                found.push_back(cornersOf(tile->found.triangles(i), town.origin()));
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found.size(), std::size_t(houses));
        EXPECT_TRUE(found == oneByOne(*root, ground, sun,
                                      method == TerrainShadowGeode::HULL ? TerrainMethod::hull : TerrainMethod::drape,
                                      town.origin()));
    }
}
