// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <gnomon/VertexTraverser.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterMesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace scene;
using gnomon::CasterMesh;
using gnomon::VertexTraverser;
using Mode = osg::PrimitiveSet::Mode;

namespace {

constexpr float nan32 = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity32 = std::numeric_limits<float>::infinity();

/// Two triangles of one array; `bad` is a corner of the second only.
osg::ref_ptr<osg::Geometry> goodAndBad(const osg::Vec3& bad) {
    return geometryOf(vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, bad}),
                      new osg::DrawArrays(Mode::TRIANGLES, 0, 6));
}

void expectOnlyTheGoodOne(osg::Node& root) {
    VertexTraverser casters;
    root.accept(casters);
    ASSERT_EQ(trianglesOf(casters).size(), 1u);
    EXPECT_EQ(trianglesOf(casters)[0], (Corners{osg::Vec3d(0, 0, 0), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0)}));
    EXPECT_EQ(casters.getInvalidTriangles(), 1u);
    for (const osg::Vec3d& v : casters.getVertices()) EXPECT_FALSE(v.isNaN());
}

} // namespace

TEST(VertexTraverserInvalid, ATriangleThatIsNotFiniteOrTooFarAwayIsLeftOutAndTheOthersStay) {
    expectOnlyTheGoodOne(*goodAndBad({0, nan32, 0}));
    expectOnlyTheGoodOne(*goodAndBad({0, 0, infinity32}));
    expectOnlyTheGoodOne(*goodAndBad({-infinity32, 0, 0}));
    // One vertex whose square overflows a float would put the mesh's origin so far away that all others fell together.
    expectOnlyTheGoodOne(*goodAndBad({0, 1e30f, 0}));
    const osg::ref_ptr<osg::Vec3dArray> doubles =
        arrayOf<osg::Vec3dArray>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {0, 1e300, 0}});
    expectOnlyTheGoodOne(*geometryOf(doubles, new osg::DrawArrays(Mode::TRIANGLES, 0, 6)));
}

TEST(VertexTraverserInvalid, AnIndexBeyondTheArrayLeavesItsTriangleOut) {
    const std::array<GLuint, 6> beyond{0, 1, 2, 3, 4, 6};
    osg::ref_ptr<osg::Geometry> geometry = goodAndBad({2, 1, 0});
    geometry->setPrimitiveSet(0, new osg::DrawElementsUInt(Mode::TRIANGLES, 6, beyond.data()));
    expectOnlyTheGoodOne(*geometry);
    (*static_cast<osg::DrawElementsUInt*>(geometry->getPrimitiveSet(0)))[5] = std::numeric_limits<GLuint>::max();
    expectOnlyTheGoodOne(*geometry);
}

TEST(VertexTraverserInvalid, ARangeBeyondTheArrayLeavesItsTrianglesOut) {
    osg::ref_ptr<osg::Geometry> geometry = triangle();
    geometry->setPrimitiveSet(0, new osg::DrawArrays(Mode::TRIANGLES, 0, 6));
    expectOnlyTheGoodOne(*geometry);
}

TEST(VertexTraverserInvalid, NegativeFirstsAndCountsAreSurvived) {
    for (const auto& [first, count] : {std::pair{-3, 3}, std::pair{0, -3}, std::pair{-1, 4}}) {
        osg::ref_ptr<osg::Geometry> geometry = triangle();
        geometry->setPrimitiveSet(0, new osg::DrawArrays(Mode::TRIANGLES, first, count));
        EXPECT_TRUE(trianglesOf(*geometry).empty());
    }
}

TEST(VertexTraverserInvalid, AQuadWithOneBadCornerKeepsTheTriangleWithoutIt) {
    osg::ref_ptr<osg::Geometry> quad =
        geometryOf(vec3s({{0, nan32, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), new osg::DrawArrays(Mode::QUADS, 0, 4));
    EXPECT_EQ(trianglesOf(*quad).size(), 1u);
}

TEST(VertexTraverserInvalid, AFourthCoordinateOfZeroIsInfinitelyFar) {
    osg::ref_ptr<osg::Vec4Array> vertices = new osg::Vec4Array(3);
    osg::ref_ptr<osg::Geometry> geometry = geometryOf(vertices, new osg::DrawArrays(Mode::TRIANGLES, 0, 3));
    VertexTraverser casters;
    geometry->accept(casters);
    EXPECT_EQ(casters.getInvalidTriangles(), 1u);
}

TEST(VertexTraverserInvalid, ATransformThatIsNotFiniteLeavesAllBelowItOut) {
    const osg::ref_ptr<osg::MatrixTransform> place = triangleAt(std::numeric_limits<double>::quiet_NaN());
    VertexTraverser casters;
    place->accept(casters);
    EXPECT_TRUE(casters.getVertices().empty());
    EXPECT_EQ(casters.getInvalidTriangles(), 1u);
    EXPECT_TRUE(std::isfinite(casters.getRounding()));
}

TEST(VertexTraverserInvalid, TheFirstCauseIsNamedByTheNearestNameAboveIt) {
    osg::ref_ptr<osg::Geode> geode = geodeOf(goodAndBad({nan32, 0, 0}).get());
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(triangleAt(0));
    root->addChild(geode);
    root->setName("town");
    const auto nameOf = [&] {
        VertexTraverser casters;
        root->accept(casters);
        return casters.getInvalidNode();
    };
    EXPECT_EQ(nameOf(), "town");
    geode->setName("church");
    EXPECT_EQ(nameOf(), "church");
    geode->setName("");
    root->setName("");
    EXPECT_EQ(nameOf(), "Geometry");
}

TEST(VertexTraverserInvalid, EmptyThingsAreNothing) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(new osg::Group);
    root->addChild(new osg::Geode);
    root->addChild(new osg::Geometry);
    root->addChild(geometryOf(vec3s({}), new osg::DrawArrays(Mode::TRIANGLES, 0, 3)));
    osg::ref_ptr<osg::Geometry> withoutVertices = new osg::Geometry;
    withoutVertices->addPrimitiveSet(new osg::DrawElementsUInt(Mode::TRIANGLES, 0));
    root->addChild(withoutVertices);
    gnomon::CasterExtraction casters;
    root->accept(casters);
    EXPECT_TRUE(casters.getVertices().empty());
    EXPECT_TRUE(casters.getTriangles().empty());
    const osg::ref_ptr<CasterMesh> mesh = new CasterMesh(casters);
    EXPECT_TRUE(mesh->empty());
    EXPECT_FALSE(mesh->bounds.valid());
}

TEST(VertexTraverserInvalid, LargeCoordinatesAreKeptAndStayFinite) {
    gnomon::CasterExtraction casters;
    geometryOf(vec3s({{1e17f, 0, 0}, {-1e17f, 0, 0}, {0, 1e17f, 0}}), new osg::DrawArrays(Mode::TRIANGLES, 0, 3))
        ->accept(casters);
    EXPECT_EQ(casters.getInvalidTriangles(), 0u);
    const osg::ref_ptr<CasterMesh> mesh = new CasterMesh(casters);
    EXPECT_EQ(mesh->triangles->size(), 3u);
    for (const osg::Vec3& v : *mesh->vertices)
        EXPECT_TRUE(std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()));
}
