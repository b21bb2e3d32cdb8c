// SPDX-License-Identifier: MIT
// Casters in two layers: which of them is made anew when.
#include "Scene.h"

#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/CasterTable.h>
#include <gnomon/casters/RaySceneCache.h>
#include <gnomon/planar/PlanarCasters.h>

#include <gtest/gtest.h>
#include <osg/observer_ptr>

#include <memory>
#include <vector>

using gnomon::CasterLayers;
using gnomon::Casters;

namespace {

/// Boxes would do as well: a row of triangles, any of which can be moved or taken out.
struct Row {
    explicit Row(int count, const osg::Vec3d& at = {}) : corner(at) {
        for (int i = 0; i < count; ++i) add(10.0 * i);
    }
    void add(double x) {
        root->addChild(scene::under(osg::Matrixd::translate(corner + osg::Vec3d(x, 0, 0)), scene::triangle()));
    }
    void move(unsigned i, const osg::Vec3d& to) {
        static_cast<osg::MatrixTransform&>(*root->getChild(i)).setMatrix(osg::Matrixd::translate(corner + to));
    }
    /// What casts now.
    const CasterLayers* next() {
        kept.push_back(table->casters(*root, {}, nullptr));
        return casters = &kept.back()->layers();
    }

    osg::Vec3d corner;
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<gnomon::CasterTable> table = new gnomon::CasterTable;
    std::vector<osg::ref_ptr<const Casters>> kept; ///< all so far.
    const CasterLayers* casters = nullptr;         ///< of the last.
};

/// Enough triangles for a mesh of its own.
osg::ref_ptr<osg::Geode> body() {
    const osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (int i = 0; i < 300; ++i)
        for (const osg::Vec3& corner : {osg::Vec3(0, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 1)})
            corners->push_back(corner + osg::Vec3(0, 0, 0.1f * float(i)));
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(corners);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 900));
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

TEST(CasterLayers, AllStandStillAtFirst) {
    Row row(5);
    const auto first = row.next();
    EXPECT_EQ(first->still->triangles, 5u);
    EXPECT_EQ(first->moving->triangles, 0u);
    EXPECT_EQ(first->origin, osg::Vec3d(20.5, 0.5, 0.0));
    EXPECT_EQ(first->reach, glm::dvec3(20.5, 0.5, 0.0));
    EXPECT_EQ(row.next(), first);
}

TEST(CasterLayers, ThatAreRetiredLeaveNothingInCaches) {
    Row row(5);
    gnomon::RaySceneCache trees;
    gnomon::PlanarCasterCache flattened;
    const auto traced = [&] { return trees.of(*row.kept.back(), "a test"); };
    const auto flat = [&] { return flattened.of(*row.kept.back(), {0.0, 0.0, 1.0, 1.0}, 1, 8); };
    row.next();
    const std::weak_ptr<const gnomon::RayScene> tree = traced();
    const osg::observer_ptr<gnomon::PlanarCasters> plane = flat().get();
    row.move(2, {21.0, 0.0, 3.0});
    row.next();
    traced();
    flat();
    EXPECT_TRUE(tree.expired());
    EXPECT_FALSE(plane.valid());
}

/// Where nothing casts any more: planar keeps neither the mesh of a body nor the arrays that it was made of.
TEST(CasterLayers, OfBodiesThatAreGoneLeaveNothingInPlanarsCache) {
    Row row(0);
    row.root->addChild(body());
    gnomon::PlanarCasterCache flattened;
    row.next();
    flattened.of(*row.kept.back(), {0.0, 0.0, 1.0, 1.0}, 1, 8);
    const osg::observer_ptr<const gnomon::CasterMesh> mesh = row.casters->still->meshes.front().mesh.get();
    row.root->removeChildren(0, 1);
    row.next();
    row.kept.clear();
    EXPECT_TRUE(mesh.valid());
    flattened.letGo();
    for (int call = 0; call < 300; ++call) row.table->casters(*row.root, {}, nullptr);
    EXPECT_FALSE(mesh.valid());
}

TEST(CasterLayers, WhatMovesIsTakenFromThoseThatStandOnce) {
    for (const unsigned which : {0u, 2u, 4u}) {
        Row row(5);
        row.next();
        row.move(which, {21.0, 0.0, 3.0});
        const auto started = row.next();
        EXPECT_EQ(started->still->triangles, 4u) << which;
        EXPECT_EQ(started->moving->triangles, 1u) << which;
        EXPECT_EQ(started->origin, osg::Vec3d(20.5, 0.5, 0.0)) << "which stays";
        for (int step = 1; step < 200; ++step) {
            row.move(which, {21.0 + 0.1 * step, 0.0, 3.0});
            const auto now = row.next();
            ASSERT_EQ(now->still, started->still) << which << ", " << step;
            EXPECT_EQ(now->moving->triangles, 1u);
        }
    }
}

TEST(CasterLayers, WhatComesMovesAndWhatGoesIsGone) {
    Row row(5);
    const auto first = row.next();
    row.add(25.0);
    EXPECT_EQ(row.next()->still, first->still);
    EXPECT_EQ(row.casters->moving->triangles, 1u);
    row.root->removeChild(5);
    EXPECT_EQ(row.next()->still, first->still);
    EXPECT_EQ(row.casters->moving->triangles, 0u);
    row.root->removeChild(1);
    EXPECT_EQ(row.next()->still->triangles, 4u);
    EXPECT_EQ(row.casters->moving->triangles, 0u);
}

// Two have moved; one of them rests while the other makes 60 moves.
TEST(CasterLayers, WhatHasComeToRestStandsStillAgainWhenTheOthersAreMadeAnew) {
    for (const bool rests : {false, true}) {
        Row row(200);
        row.next();
        for (unsigned i : {3u, 7u}) row.move(i, {5.0, 2.0, 0.0});
        row.next();
        EXPECT_EQ(row.casters->moving->triangles, 2u);
        for (int step = 0; step < (rests ? 60 : 50); ++step) {
            row.move(7, {5.0, 2.0, 0.1 * step});
            row.next();
        }
        EXPECT_EQ(row.casters->moving->triangles, 2u);
        row.move(9, {5.0, 3.0, 0.0});
        EXPECT_EQ(row.next()->moving->triangles, rests ? 2u : 3u);
        EXPECT_EQ(row.casters->still->triangles, rests ? 198u : 197u);
    }
}

// 20 that came one by one rest among five that stood: to make them again and again would soon cost more than all.
TEST(CasterLayers, WhatHasComeToRestStandsStillAgainOnceItHasCostAsMuchAsAll) {
    Row row(5);
    row.next();
    for (int i = 0; i < 20; ++i) row.add(1.0 * i);
    row.next();
    row.move(0, {0.0, 3.0, 0.0});
    row.next();
    int moves = 0;
    for (; moves < 100 && row.casters->moving->triangles > 1; ++moves) {
        row.move(0, {0.0, 3.0, 0.1 * (moves + 1)});
        row.next();
    }
    EXPECT_EQ(moves, 60) << "20 triangles are made again with the 59th, 40 with the 60th; 24 are the cost of all";
    EXPECT_EQ(row.casters->still->triangles, 24u);
}

TEST(CasterLayers, ThatAreTheSameInAnotherOrderStandStill) {
    Row row(5);
    row.next();
    const gnomon::CasterList& list = row.kept.back()->list;
    const osg::ref_ptr<const Casters> turned = new Casters({list.rbegin(), list.rend()}, 1);
    gnomon::KnownCasters known;
    const CasterLayers now(*turned, &row.kept.back()->layers(), known);
    EXPECT_EQ(now.moving->triangles, 0u);
    EXPECT_EQ(now.still->triangles, 5u);
}

/// Largest distance of a drawn vertex from where it ought to be: each triangle's corner.
double worst(const CasterLayers& casters, const osg::Vec3d& corner) {
    return (osg::Vec3d(casters.moving->loose->vertices->front()) + casters.origin - corner).length();
}

// At 6,400 km a float's step is half a metre. Something drives 5 km, alone or out of a scene of 50 m: floats about the middle
// of all have steps of half a millimetre at 4 km to 8, and of less than a micrometre about the thing itself.
TEST(CasterLayers, ThatMoveFarFromTheCentreOfTheEarthStayWhereTheyAre) {
    const osg::Vec3d earth(4.2e6, 1.7e6, 4.5e6);
    for (const auto& [others, off] : {std::pair(0, 1e-6), {5, 0.0005}}) {
        Row row(others + 1, earth);
        row.next();
        for (int step = 0; step <= 100; ++step) {
            const osg::Vec3d place(50.0 * step, 7.0, 0.3 * step);
            row.move(0, place);
            EXPECT_LE(worst(*row.next(), earth + place), off) << others << ", " << step;
        }
        EXPECT_EQ(row.casters->still->triangles, std::size_t(others));
    }
}

TEST(CasterLayers, WithoutTrianglesAreNeitherStillNorMoving) {
    Row row(2);
    const auto first = row.next();
    row.root->addChild(scene::geometryOf(scene::vec3s({{0, 0, 0}, {1, 0, 0}}), new osg::DrawArrays(GL_LINES, 0, 2)));
    EXPECT_EQ(row.next()->moving, first->moving);
    EXPECT_EQ(row.casters->still, first->still);
}

TEST(CasterLayers, AreMadeForThoseWhoAsk) {
    Row row(5);
    const auto first = row.table->casters(*row.root, {}, nullptr);
    EXPECT_FALSE(first->hasLayers()) << "a list is enough for some";
    const CasterLayers* layers = &first->layers();
    row.move(0, {0.0, 3.0, 0.0});
    row.table->casters(*row.root, {}, nullptr); // nobody asks
    row.move(1, {0.0, 4.0, 0.0});
    EXPECT_EQ(row.next()->still->triangles, 3u) << "from those that were asked for last";
    EXPECT_EQ(row.casters->moving->triangles, 2u);
    EXPECT_EQ(&first->layers(), layers);
}

} // namespace
