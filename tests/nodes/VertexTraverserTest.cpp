// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/DrawableTriangles.h>

#include <osg/MatrixTransform>
#include <osg/PrimitiveRestartIndex>
#include <osg/PrimitiveSetIndirect>
#include <osg/ShapeDrawable>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>

using namespace scene;
using gnomon::CasterMesh;
using gnomon::VertexTraverser;
using Mode = osg::PrimitiveSet::Mode;

namespace {

/// Seven vertices told apart by x; their places make no two triangles alike.
osg::ref_ptr<osg::Vec3Array> sevenVertices() {
    return vec3s({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}, {4, 0, 1}, {5, 2, 0}, {6, 0, 3}});
}

using Indices = std::vector<std::array<int, 3>>;

/// The corners by x, the lowest first: turning a triangle round does not change it.
Indices turned(const std::vector<Corners>& triangles) {
    Indices result;
    for (const Corners& c : triangles) {
        std::array<int, 3> x{};
        for (std::size_t i = 0; i < 3; ++i) x[i] = static_cast<int>(c[i].x());
        std::rotate(x.begin(), std::min_element(x.begin(), x.end()), x.end());
        result.push_back(x);
    }
    return result;
}

Indices indicesOf(osg::PrimitiveSet* primitives) {
    return turned(trianglesOf(*geometryOf(sevenVertices(), primitives)));
}

Indices indicesOf(Mode mode) { return indicesOf(new osg::DrawArrays(mode, 0, 7)); }

template <class Array>
osg::Vec3d lastVertexOf(const osg::ref_ptr<Array>& array) {
    VertexTraverser casters;
    geometryOf(array, new osg::DrawArrays(Mode::TRIANGLES, 0, 3))->accept(casters);
    return casters.getVertices().size() == 3 ? casters.getVertices().back() : osg::Vec3d(-1, -1, -1);
}

template <class Array>
osg::ref_ptr<Array> threeVertices(const typename Array::ElementDataType& last) {
    osg::ref_ptr<Array> array = new Array(3);
    (*array)[2] = last;
    return array;
}

/// Of a list that is drawn with primitive restart.
Indices restarted(osg::PrimitiveSet* primitives, GLenum mode, unsigned index = 0) {
    const osg::ref_ptr<osg::Geometry> geometry = geometryOf(sevenVertices(), primitives);
    osg::StateSet& set = *geometry->getOrCreateStateSet();
    set.setMode(mode, osg::StateAttribute::ON);
    set.setAttribute(new osg::PrimitiveRestartIndex(index));
    return turned(trianglesOf(*geometry));
}

template <class Elements, class Index>
osg::ref_ptr<Elements> elements(GLenum mode, std::initializer_list<Index> indices) {
    return new Elements(mode, static_cast<unsigned>(indices.size()), std::data(indices));
}

template <class Elements>
osg::DefaultIndirectCommandDrawElements& commandsOf(const osg::ref_ptr<Elements>& set) {
    return static_cast<osg::DefaultIndirectCommandDrawElements&>(*set->getIndirectCommandArray());
}

osg::Vec3d areaVector(const Corners& c) { return ((c[1] - c[0]) ^ (c[2] - c[0])) / 2.0; }

} // namespace

// The expected lists are those of the OpenGL specification, 2.6.1 (compatibility), written out for seven vertices.

TEST(VertexTraverserModes, MakeTheTrianglesOfTheSpecification) {
    const Indices fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}};
    const std::pair<Mode, Indices> modes[] = {
        {Mode::TRIANGLES, {{0, 1, 2}, {3, 4, 5}}}, // without an incomplete last one
        {Mode::TRIANGLE_STRIP, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}, {4, 5, 6}}},
        {Mode::TRIANGLE_FAN, fan},
        {Mode::POLYGON, fan},
        {Mode::QUADS, {{0, 1, 3}, {1, 2, 3}}},
        {Mode::QUAD_STRIP, {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}}},
        {Mode::TRIANGLES_ADJACENCY, {{0, 2, 4}}}, // neighbours are no corners
        {Mode::TRIANGLE_STRIP_ADJACENCY, {{0, 2, 4}}}};
    for (const auto& [mode, expected] : modes) EXPECT_EQ(indicesOf(mode), expected) << mode;
    for (int mode = Mode::POINTS; mode <= Mode::POLYGON; ++mode)
        EXPECT_TRUE(indicesOf(new osg::DrawArrays(static_cast<Mode>(mode), 0, 2)).empty()) << "two vertices, " << mode;
}

TEST(VertexTraverserModes, PointsAndLinesHaveVerticesButNoTriangles) {
    for (Mode mode : {Mode::POINTS, Mode::LINES, Mode::LINE_STRIP, Mode::LINE_LOOP}) {
        VertexTraverser casters;
        geometryOf(sevenVertices(), new osg::DrawArrays(mode, 0, 7))->accept(casters);
        EXPECT_EQ(casters.getVertices().size(), 7u) << mode;
        EXPECT_TRUE(casters.getTriangles().empty()) << mode;
        EXPECT_EQ(casters.getInvalidTriangles(), 0u) << mode;
    }
}

TEST(VertexTraverserIndices, EachRangeBeginsAnewAtItsFirst) {
    EXPECT_EQ(indicesOf(new osg::DrawArrays(Mode::TRIANGLES, 4, 3)), (Indices{{4, 5, 6}}));
    osg::ref_ptr<osg::DrawArrayLengths> fans = new osg::DrawArrayLengths(Mode::TRIANGLE_FAN, 0);
    fans->push_back(3);
    fans->push_back(4);
    EXPECT_EQ(indicesOf(fans.get()), (Indices{{0, 1, 2}, {3, 4, 5}, {3, 5, 6}}));
    osg::ref_ptr<osg::MultiDrawArrays> strips = new osg::MultiDrawArrays(Mode::TRIANGLE_STRIP);
    strips->add(1, 3);
    strips->add(3, 4);
    EXPECT_EQ(indicesOf(strips.get()), (Indices{{1, 2, 3}, {3, 4, 5}, {4, 6, 5}}));
}

TEST(VertexTraverserIndices, OfAllThreeWidthsAreReadAndTwoEqualOnesMakeNoTriangle) {
    EXPECT_EQ(indicesOf(elements<osg::DrawElementsUByte, GLubyte>(Mode::TRIANGLES, {6, 2, 1})), (Indices{{1, 6, 2}}));
    EXPECT_EQ(indicesOf(elements<osg::DrawElementsUShort, GLushort>(Mode::TRIANGLES, {6, 2, 1})), (Indices{{1, 6, 2}}));
    EXPECT_EQ(indicesOf(elements<osg::DrawElementsUInt, GLuint>(Mode::TRIANGLES, {0, 1, 1, 2, 2, 0, 6, 2, 1})),
              (Indices{{1, 6, 2}}));
}

// OpenGL 4.6, 10.3.6: the next index begins another primitive of the same kind, in lists alone.
TEST(VertexTraverserIndices, ARestartBeginsAStripAFanOrALoopAnew) {
    constexpr GLenum fixed = 0x8D69; // GL_PRIMITIVE_RESTART_FIXED_INDEX
    const auto strips = elements<osg::DrawElementsUInt, GLuint>(Mode::TRIANGLE_STRIP, {1, 2, 3, 4, 0, 4, 5, 6});
    EXPECT_EQ(restarted(strips, GL_PRIMITIVE_RESTART), (Indices{{1, 2, 3}, {2, 4, 3}, {4, 5, 6}}));
    EXPECT_EQ(indicesOf(strips).size(), 5u) << "where no restart is on: one triangle has no area in the list";
    const auto fans = elements<osg::DrawElementsUShort, GLushort>(Mode::TRIANGLE_FAN, {0, 1, 2, 3, 6, 6, 3, 4, 5, 6});
    EXPECT_EQ(restarted(fans, GL_PRIMITIVE_RESTART, 6), (Indices{{0, 1, 2}, {0, 2, 3}, {3, 4, 5}}));
    const auto bytes = elements<osg::DrawElementsUByte, GLubyte>(Mode::TRIANGLES, {0, 1, 255, 2, 3, 4, 5, 255, 6});
    EXPECT_EQ(restarted(bytes, fixed), (Indices{{2, 3, 4}}));
    const auto shorts = elements<osg::DrawElementsUShort, GLushort>(Mode::POLYGON, {0, 1, 2, 65535, 3, 4, 5});
    EXPECT_EQ(restarted(shorts, fixed, 2), (Indices{{0, 1, 2}, {3, 4, 5}})) << "whatever the index of the other kind";
    EXPECT_EQ(restarted(new osg::DrawArrays(Mode::TRIANGLE_STRIP, 0, 4), GL_PRIMITIVE_RESTART, 2),
              (Indices{{0, 1, 2}, {1, 3, 2}}));
    const auto loop = elements<osg::DrawElementsUInt, GLuint>(Mode::LINE_LOOP, {0, 1, 2, 6, 3, 4});
    EXPECT_TRUE(restarted(loop, GL_PRIMITIVE_RESTART, 6).empty());
}

TEST(VertexTraverserIndices, CommandsInABufferAreReadAsOpenGlReadsThem) {
    const auto one = elements<osg::DrawElementsIndirectUShort, GLushort>(Mode::TRIANGLES, {0, 1, 2, 0, 2, 3});
    commandsOf(one).push_back({3, 1, 0, 0, 0});
    commandsOf(one).push_back({3, 1, 3, 2, 0}); // from the fourth index on, each 2 more
    EXPECT_EQ(indicesOf(one), (Indices{{0, 1, 2}}));
    one->setFirstCommandToDraw(1);
    EXPECT_EQ(indicesOf(one), (Indices{{2, 4, 5}}));
    const auto several = elements<osg::MultiDrawElementsIndirectUInt, GLuint>(Mode::TRIANGLE_FAN, {0, 1, 2, 3});
    commandsOf(several).push_back({3, 1, 1, 0, 0});
    commandsOf(several).push_back({4, 0, 0, 0, 0}); // of no instance
    commandsOf(several).push_back({4, 2, 0, 3, 0}); // once, as what is instanced is
    EXPECT_EQ(indicesOf(several), (Indices{{1, 2, 3}, {3, 4, 5}, {3, 5, 6}}));
    several->setNumCommandsToDraw(2);
    EXPECT_EQ(indicesOf(several), (Indices{{1, 2, 3}}));
    EXPECT_EQ(restarted(several, GL_PRIMITIVE_RESTART, 1), Indices());
    const osg::ref_ptr<osg::MultiDrawArraysIndirect> arrays = new osg::MultiDrawArraysIndirect(Mode::TRIANGLE_STRIP);
    auto& ranges = static_cast<osg::DefaultIndirectCommandDrawArrays&>(*arrays->getIndirectCommandArray());
    for (const unsigned first : {0u, 1u, 3u}) ranges.push_back({3, 1, first, 0});
    arrays->setFirstCommandToDraw(1);
    arrays->setNumCommandsToDraw(2);
    EXPECT_EQ(indicesOf(arrays), (Indices{{1, 2, 3}, {3, 4, 5}}));
}

TEST(VertexTraverserIndices, CommandsThatDrawNothingMayBeAProgramsToWrite) {
    const auto set = elements<osg::DrawElementsIndirectUInt, GLuint>(Mode::TRIANGLES, {0, 1, 2});
    const osg::ref_ptr<osg::Geometry> geometry = geometryOf(sevenVertices(), set);
    EXPECT_TRUE(gnomon::drawsItself(*geometry)) << "no command";
    commandsOf(set).push_back({3, 0, 0, 0, 0});
    EXPECT_TRUE(gnomon::drawsItself(*geometry)) << "no instance";
    commandsOf(set)[0].instanceCount = 1;
    EXPECT_FALSE(gnomon::drawsItself(*geometry));
}

TEST(VertexTraverserIndices, VerticesAreSharedBetweenTrianglesAndThePrimitivesOfADrawable) {
    osg::ref_ptr<osg::Geometry> geometry = geometryOf(sevenVertices(), new osg::DrawArrays(Mode::TRIANGLE_STRIP, 0, 5));
    geometry->addPrimitiveSet(new osg::DrawArrays(Mode::TRIANGLES, 0, 3));
    VertexTraverser casters;
    geometry->accept(casters);
    EXPECT_EQ(casters.getVertices().size(), 5u); // the last two are not used
    EXPECT_EQ(casters.getTriangles().size(), 3u * 4u);
}

TEST(VertexTraverserIndices, AnArrayOfManyDrawablesIsNotCopiedWhole) {
    const osg::ref_ptr<osg::Vec3Array> shared = new osg::Vec3Array(3000);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    for (int i = 0; i < 1000; ++i)
        geode->addDrawable(geometryOf(shared, new osg::DrawArrays(Mode::TRIANGLES, 3 * i, 3)));
    VertexTraverser casters;
    geode->accept(casters);
    EXPECT_EQ(casters.getVertices().size(), 3000u);
}

TEST(VertexTraverserArrays, OfEveryTypeAreRead) {
    const osg::Vec3d utm(691606.123456789, 5335798.987654321, 519.5);
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec2Array>({1, 2})), osg::Vec3d(1, 2, 0));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3Array>({1, 2, 3})), osg::Vec3d(1, 2, 3));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec2dArray>({1, 2})), osg::Vec3d(1, 2, 0));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3dArray>(utm)), utm);
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec2sArray>({1, -2})), osg::Vec3d(1, -2, 0));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3sArray>({1, -2, 300})), osg::Vec3d(1, -2, 300));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3bArray>({1, -2, 3})), osg::Vec3d(1, -2, 3));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3ubArray>({1, 2, 200})), osg::Vec3d(1, 2, 200));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3usArray>({1, 2, 60000})), osg::Vec3d(1, 2, 60000));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3iArray>({1, -2, 70000})), osg::Vec3d(1, -2, 70000));
    EXPECT_EQ(lastVertexOf(threeVertices<osg::Vec3uiArray>({1, 2, 70000})), osg::Vec3d(1, 2, 70000));
}

TEST(VertexTraverserArrays, TheFourthCoordinateDivides) {
    EXPECT_EQ(lastVertexOf(arrayOf<osg::Vec4Array>({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 4, 6, 2}})), osg::Vec3d(1, 2, 3));
    EXPECT_EQ(lastVertexOf(arrayOf<osg::Vec4dArray>({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 4, 6, 2}})), osg::Vec3d(1, 2, 3));
    EXPECT_EQ(lastVertexOf(arrayOf<osg::Vec4sArray>({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 4, 6, 2}})), osg::Vec3d(1, 2, 3));
}

/// As the OpenGL specification has it, 2.3.5 of 4.2.
TEST(VertexTraverserArrays, NormalisedIntegersOfAnAttributeEndAtOne) {
    const auto last = [](osg::Array* array) {
        array->setNormalize(true);
        const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexAttribArray(0, array, osg::Array::BIND_PER_VERTEX);
        geometry->addPrimitiveSet(new osg::DrawArrays(Mode::TRIANGLES, 0, 3));
        VertexTraverser casters;
        geometry->accept(casters);
        return casters.getVertices().size() == 3 ? casters.getVertices().back() : osg::Vec3d(9, 9, 9);
    };
    EXPECT_EQ(last(threeVertices<osg::Vec3sArray>({32767, -32767, -32768}).get()), osg::Vec3d(1, -1, -1));
    EXPECT_EQ(last(threeVertices<osg::Vec3ubArray>({255, 0, 51}).get()), osg::Vec3d(1, 0, 0.2f));
}

TEST(VertexTraverserArrays, AttributeZeroStandsInForAMissingVertexArray) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexAttribArray(0, sevenVertices().get(), osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawArrays(Mode::TRIANGLES, 0, 3));
    EXPECT_EQ(trianglesOf(*geometry).size(), 1u);
}

TEST(VertexTraverserTransforms, ThirtyTwoNestedTransformsMultiply) {
    // Each doubles x about the origin of its parent and moves by 1: x -> 2x + 1, 32 times, sends x to 2^32 (x + 1) - 1.
    osg::ref_ptr<osg::Node> root = geodeOf(triangle().get());
    for (int i = 0; i < 32; ++i) {
        root = under(osg::Matrix::scale(2, 1, 1) * osg::Matrix::translate(1, 0, 0), root);
    }
    const Corners corners = trianglesOf(*root).at(0);
    EXPECT_EQ(corners[0], osg::Vec3d(std::ldexp(1.0, 32) - 1.0, 0, 0));
    EXPECT_EQ(corners[1], osg::Vec3d(std::ldexp(1.0, 33) - 1.0, 0, 0));
    EXPECT_EQ(corners[2], osg::Vec3d(std::ldexp(1.0, 32) - 1.0, 1, 0));
}

TEST(VertexTraverserTransforms, ABoxLooksOutwardsHoweverMirrored) {
    for (const osg::Vec3d& scale : {osg::Vec3d(1, 1, 1), osg::Vec3d(-1, 1, 1), osg::Vec3d(1, -2, 3),
                                    osg::Vec3d(-1, -1, -1), osg::Vec3d(-2, -1, 1)}) {
        osg::ref_ptr<osg::Geode> box = geodeOf(new osg::ShapeDrawable(new osg::Box(osg::Vec3(5, 6, 7), 2, 4, 6)));
        const std::vector<Corners> triangles = trianglesOf(*under(osg::Matrix::scale(scale), box));
        double volume = 0.0;
        for (const Corners& c : triangles) volume += areaVector(c) * c[0] / 3.0;
        EXPECT_EQ(triangles.size(), 12u);
        EXPECT_NEAR(volume, 48.0 * std::abs(scale.x() * scale.y() * scale.z()), 1e-11); // sums of products below 10000
    }
}

TEST(VertexTraverserTransforms, TheRootsOwnTransformCountsAndItsParentsDoNot) {
    const osg::ref_ptr<osg::MatrixTransform> root = triangleAt(3),
                                             parent = under(osg::Matrix::translate(100, 0, 0), root);
    EXPECT_EQ(startsOf(*root), (std::vector<double>{3}));
}

TEST(VertexTraverserRounding, IsHalfAFloatStepOfTheLargestCoordinate) {
    VertexTraverser casters; // 1024: floats below it are 2^-14 apart, and a value is off by half of that at most
    osg::ref_ptr<osg::Vec3Array> vertices = vec3s({{0, 0, 0}, {1024, 0, 0}, {0, 1, 0}});
    geometryOf(vertices, new osg::DrawArrays(Mode::TRIANGLES, 0, 3))->accept(casters);
    EXPECT_NEAR(casters.getRounding(), std::ldexp(1.0, -14), std::ldexp(1.0, -23)); // the 1 in y adds a little
}

TEST(VertexTraverserRounding, IsScaledByTheTransformAndNotByItsTranslation) {
    const auto far = under(osg::Matrix::scale(8, 8, 8) * osg::Matrix::translate(6e6, 0, 0), geodeOf(triangle().get()));
    VertexTraverser near, placed;
    triangle()->accept(near);
    far->accept(placed);
    EXPECT_GT(near.getRounding(), 0.0);
    EXPECT_DOUBLE_EQ(placed.getRounding(), 8.0 * near.getRounding());
}

TEST(VertexTraverserRounding, DoublesHaveNone) {
    VertexTraverser casters;
    geometryOf(threeVertices<osg::Vec3dArray>({1e6, 1, 1}), new osg::DrawArrays(Mode::TRIANGLES, 0, 3))
        ->accept(casters);
    EXPECT_EQ(casters.getRounding(), 0.0);
}

TEST(VertexTraverserNearest, IsNearestInSpace) {
    VertexTraverser casters;
    geometryOf(vec3s({{0, 0, 0}, {4, 0, 0}, {1, 0, 50}}), new osg::DrawArrays(Mode::TRIANGLES, 0, 3))->accept(casters);
    EXPECT_EQ(casters.nearestVertex({1.2, 0, 0}), osg::Vec3d(0, 0, 0));
    EXPECT_EQ(casters.nearestVertex({1.2, 0, 40}), osg::Vec3d(1, 0, 50));
    EXPECT_EQ(casters.nearestVertex({2, 0, 0}), osg::Vec3d(0, 0, 0)) << "of equals the first";
}

TEST(VertexTraverserNearest, ThereIsNoneInAnEmptySceneOrForAPointThatIsNotFinite) {
    VertexTraverser empty, casters;
    triangle()->accept(casters);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(empty.nearestVertex({0, 0, 0}));
    EXPECT_FALSE(casters.nearestVertex({nan, 0, 0}));
    EXPECT_FALSE(casters.nearestVertex({infinity, 0, 0}));
}

TEST(VertexTraverser, ResetForgetsTheSceneBefore) {
    VertexTraverser casters;
    triangle()->accept(casters);
    casters.reset();
    EXPECT_TRUE(casters.getVertices().empty());
    triangleAt(7)->accept(casters);
    ASSERT_EQ(trianglesOf(casters).size(), 1u);
    EXPECT_EQ(trianglesOf(casters)[0][0], osg::Vec3d(7, 0, 0));
}

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
