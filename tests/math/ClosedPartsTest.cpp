// SPDX-License-Identifier: MIT
#include "Compare.h"
#include <support/Soup.h>

#include <gnomon/geometry/ClosedParts.h>
#include <gnomon/geometry/MeshEdges.h>

#include <utility>

using namespace gnomon;
using ::test::Soup;

namespace {

ClosedParts partsOf(const Soup& soup) {
    return closedParts(soup.vertices.data(), soup.vertices.size(), soup.indices.data(), soup.indices.size(), true);
}

/// How many of the triangles bound a solid.
long closedTriangles(const Soup& soup) {
    const std::vector<bool> closed = partsOf(soup).closed;
    return std::count(closed.begin(), closed.end(), true);
}

/// Corner of a tetrahedron at the origin, its other corners on the axes; faces look outwards.
Soup tetrahedron(float size = 1.0f) {
    const glm::vec3 o(0.0f), x(size, 0.0f, 0.0f), y(0.0f, size, 0.0f), z(0.0f, 0.0f, size);
    Soup soup;
    soup.triangle(o, y, x);
    soup.triangle(o, z, y);
    soup.triangle(o, x, z);
    soup.triangle(x, y, z);
    return soup;
}

} // namespace

TEST(ClosedParts, AreSolidsWhoseFacesLookOutwardsAndNoneOfWhichIsMissing) {
    EXPECT_EQ(closedTriangles(tetrahedron()), 4);
    EXPECT_EQ(closedTriangles(tetrahedron().turned()), 0) << "inside out";
    for (std::size_t face = 0; face < 4; ++face) EXPECT_EQ(closedTriangles(tetrahedron().without(face)), 0);
    Soup soup = tetrahedron();
    std::swap(soup.vertices[0], soup.vertices[1]);
    EXPECT_EQ(closedTriangles(soup), 0) << "one face is turned round";
}

TEST(ClosedParts, AreToldApartWhereNothingConnectsThem) {
    Soup soup = tetrahedron();
    soup.add(tetrahedron().without(1).moved({3.0f, 0.0f, 0.0f}));
    soup.add(tetrahedron().turned().moved({6.0f, 0.0f, 0.0f}));
    soup.add(tetrahedron().moved({9.0f, 0.0f, 0.0f}));
    const std::vector<bool> expected{true,  true,  true,  true, false, false, false, false,
                                     false, false, false, true, true,  true,  true};
    EXPECT_EQ(partsOf(soup).closed, expected);
}

TEST(ClosedParts, ThatTouchInAVertexOrShareAnEdgeAreClosed) {
    Soup touching = tetrahedron(), sharing = tetrahedron(), opposite = tetrahedron();
    touching.add(tetrahedron().moved({1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(closedTriangles(touching), 8);
    for (glm::vec3& position : opposite.vertices) position = {-position.x, -position.y, position.z};
    sharing.add(opposite); // four triangles meet in the edge: two go each way
    EXPECT_EQ(closedTriangles(sharing), 8);
}

TEST(ClosedParts, WithAFinOnAnEdgeAreOpen) {
    Soup soup = tetrahedron();
    soup.triangle({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, -1.0f, 0.0f});
    EXPECT_EQ(closedTriangles(soup), 0);
}

TEST(ClosedParts, AreNotADoubleSidedSheet) { // closed, but it encloses nothing
    Soup soup;
    soup.triangle({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
    soup.add(soup.turned());
    EXPECT_EQ(closedTriangles(soup), 0);
}

TEST(ClosedParts, MayHoldTrianglesOfNoArea) {
    Soup soup = tetrahedron();
    soup.triangle({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f});
    soup.triangle({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}); // an edge, there and back
    EXPECT_EQ(closedTriangles(soup), 6);
}

TEST(ClosedParts, AreFoundFarFromTheOriginAndInAnyUnit) {
    // 2²³ + 1 is a float, the cube of it keeps no ones
    EXPECT_EQ(closedTriangles(tetrahedron().moved({8388608.0f, -8388608.0f, 4194304.0f})), 4);
    for (const float size : {1e-12f, 1e-3f, 1e3f, 1e12f}) EXPECT_EQ(closedTriangles(tetrahedron(size)), 4);
}

TEST(ClosedParts, WithSharedVerticesAreTheSameAsWithout) {
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<unsigned> faces{0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3};
    const ClosedParts found = closedParts(corners.data(), corners.size(), faces.data(), faces.size());
    EXPECT_EQ(found.closed, std::vector<bool>(4, true));
    EXPECT_EQ(found.welded, (std::vector<unsigned>{0, 1, 2, 3}));
}

/// A ball of slices and stacks by sine and cosine: sin(pi) is not 0 and sin(2 pi) not sin(0), so its seam is open.
Soup ball(int slices) {
    const auto at = [slices](int stack, int slice) {
        const double v = glm::pi<double>() * stack / (slices / 2), u = 2.0 * glm::pi<double>() * slice / slices;
        return glm::vec3(std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v));
    };
    Soup soup;
    for (int stack = 0; stack < slices / 2; ++stack)
        for (int slice = 0; slice < slices; ++slice) {
            soup.triangle(at(stack, slice), at(stack + 1, slice), at(stack + 1, slice + 1));
            soup.triangle(at(stack, slice), at(stack + 1, slice + 1), at(stack, slice + 1));
        }
    return soup;
}

TEST(ClosedParts, OfABallWhoseSeamRoundingLeavesOpenAreClosed) {
    const Soup round = ball(16);
    ASSERT_NE(round.vertices[1], ball(16).vertices[3 * 2 * 15 + 2]); // the seam: one angle, two values
    EXPECT_EQ(closedTriangles(round), long(round.vertices.size() / 3));
    EXPECT_EQ(closedTriangles(round.turned()), 0);
}

TEST(ClosedParts, StayOpenWhereASeamIsWiderThanRounding) {
    Soup gaping = tetrahedron();
    for (std::size_t i = 9; i < 12; ++i) gaping.vertices[i] += 4e-6f; // the slanted face, off by 33 steps of float
    EXPECT_EQ(closedTriangles(gaping), 0);
}

TEST(ClosedParts, OfNothingAreNone) { EXPECT_TRUE(closedParts(nullptr, 0, nullptr, 0).closed.empty()); }

TEST(WeldedVertices, AreTheFirstOfEachPositionAndMinusZeroIsZero) {
    const float next = std::nextafter(1.0f, 2.0f);
    const std::vector<glm::vec3> positions{{1, 2, 3}, {0, 0, 0}, {1, 2, 3},         {1, 2, 4},   {0, 0, 0},
                                           {1, 2, 3}, {0, 1, 0}, {-0.0f, 1, -0.0f}, {0, next, 0}};
    EXPECT_EQ(closedParts(positions.data(), positions.size(), nullptr, 0).welded,
              (std::vector<unsigned>{0, 1, 0, 3, 1, 0, 6, 6, 8}));
}

TEST(WeldedVertices, ThatAreNearlyTheSameAreSoAcrossTheBordersOfTheGrid) {
    constexpr double reach = 0.5; // a cell is 8 wide
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 below(1.0), above(1.0);
        below[axis] = 7.8;
        above[axis] = 8.2;
        EXPECT_EQ(nearlyTheSame({below, above}, reach), (std::vector<unsigned>{0, 0})) << axis;
        EXPECT_EQ(nearlyTheSame({above, below}, reach), (std::vector<unsigned>{0, 0})) << axis;
        EXPECT_EQ(nearlyTheSame({below, above}, 0.3), (std::vector<unsigned>{0, 1})) << axis;
    }
}
