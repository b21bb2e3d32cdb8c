// SPDX-License-Identifier: MIT
#include "Compare.h"

#include <gnomon/ClosedParts.h>

#include <utility>

using namespace gnomon;

namespace {

/// Triangles without shared vertices, as most scenes have them.
struct Soup {
    std::vector<glm::vec3> positions;

    ClosedParts parts() const {
        std::vector<unsigned> indices(positions.size());
        for (unsigned i = 0; i < indices.size(); ++i) indices[i] = i;
        return closedParts(positions.data(), positions.size(), indices.data(), indices.size());
    }
    /// How many of the triangles bound a solid.
    long closedTriangles() const {
        const std::vector<bool> closed = parts().closed;
        return std::count(closed.begin(), closed.end(), true);
    }
    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        for (const glm::vec3& corner : {a, b, c}) positions.push_back(corner);
    }
    void add(const Soup& other) { positions.insert(positions.end(), other.positions.begin(), other.positions.end()); }
    Soup moved(const glm::vec3& by) const {
        Soup result = *this;
        for (glm::vec3& position : result.positions) position += by;
        return result;
    }
    /// Every triangle looks the other way.
    Soup turned() const {
        Soup result = *this;
        for (std::size_t i = 0; i + 2 < result.positions.size(); i += 3)
            std::swap(result.positions[i + 1], result.positions[i + 2]);
        return result;
    }
    Soup without(std::size_t triangle) const {
        Soup result = *this;
        const auto first = result.positions.begin() + static_cast<std::ptrdiff_t>(3 * triangle);
        result.positions.erase(first, first + 3);
        return result;
    }
};

/// Corner of a tetrahedron at the origin, its other corners on the axes; faces look outwards.
Soup tetrahedron(float size = 1.0f) {
    const glm::vec3 o(0.0f), x(size, 0.0f, 0.0f), y(0.0f, size, 0.0f), z(0.0f, 0.0f, size);
    Soup soup;
    soup.add(o, y, x);
    soup.add(o, z, y);
    soup.add(o, x, z);
    soup.add(x, y, z);
    return soup;
}

} // namespace

TEST(ClosedParts, AreSolidsWhoseFacesLookOutwards) { EXPECT_EQ(tetrahedron().closedTriangles(), 4); }

TEST(ClosedParts, AreNotWhatIsTurnedInsideOut) { EXPECT_EQ(tetrahedron().turned().closedTriangles(), 0); }

TEST(ClosedParts, AreNotWhatLacksAFace) {
    for (std::size_t face = 0; face < 4; ++face) EXPECT_EQ(tetrahedron().without(face).closedTriangles(), 0);
}

TEST(ClosedParts, AreNotWhatHasOneFaceTurnedRound) {
    Soup soup = tetrahedron();
    std::swap(soup.positions[0], soup.positions[1]);
    EXPECT_EQ(soup.closedTriangles(), 0);
}

TEST(ClosedParts, AreToldApartWhereNothingConnectsThem) {
    Soup soup = tetrahedron();
    soup.add(tetrahedron().without(1).moved({3.0f, 0.0f, 0.0f}));
    soup.add(tetrahedron().turned().moved({6.0f, 0.0f, 0.0f}));
    soup.add(tetrahedron().moved({9.0f, 0.0f, 0.0f}));
    const std::vector<bool> expected{true,  true,  true,  true, false, false, false, false,
                                     false, false, false, true, true,  true,  true};
    EXPECT_EQ(soup.parts().closed, expected);
}

TEST(ClosedParts, ThatTouchInAVertexAreOneAndStillClosed) {
    Soup soup = tetrahedron();
    soup.add(tetrahedron().moved({1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(soup.closedTriangles(), 8);
}

TEST(ClosedParts, ThatShareAnEdgeAreClosed) { // four triangles meet in it: two go each way
    Soup soup = tetrahedron(), opposite = tetrahedron();
    for (glm::vec3& position : opposite.positions) position = {-position.x, -position.y, position.z};
    soup.add(opposite);
    EXPECT_EQ(soup.closedTriangles(), 8);
}

TEST(ClosedParts, WithAFinOnAnEdgeAreOpen) {
    Soup soup = tetrahedron();
    soup.add({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, -1.0f, 0.0f});
    EXPECT_EQ(soup.closedTriangles(), 0);
}

TEST(ClosedParts, AreNotADoubleSidedSheet) { // closed, but it encloses nothing
    Soup soup;
    soup.add({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
    soup.add(soup.turned());
    EXPECT_EQ(soup.closedTriangles(), 0);
}

TEST(ClosedParts, MayHoldTrianglesOfNoArea) {
    Soup soup = tetrahedron();
    soup.add({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f});
    soup.add({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}); // an edge, there and back
    EXPECT_EQ(soup.closedTriangles(), 6);
}

TEST(ClosedParts, AreFoundFarFromTheOrigin) { // 2²³ + 1 is a float, the cube of it keeps no ones
    EXPECT_EQ(tetrahedron().moved({8388608.0f, -8388608.0f, 4194304.0f}).closedTriangles(), 4);
}

TEST(ClosedParts, AreFoundInAnyUnit) {
    for (const float size : {1e-12f, 1e-3f, 1e3f, 1e12f}) EXPECT_EQ(tetrahedron(size).closedTriangles(), 4);
}

TEST(ClosedParts, WithSharedVerticesAreTheSameAsWithout) {
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<unsigned> faces{0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3};
    const ClosedParts found = closedParts(corners.data(), corners.size(), faces.data(), faces.size());
    EXPECT_EQ(found.closed, std::vector<bool>(4, true));
    EXPECT_EQ(found.welded, (std::vector<unsigned>{0, 1, 2, 3}));
}

TEST(ClosedParts, OfNothingAreNone) {
    const ClosedParts found = closedParts(nullptr, 0, nullptr, 0);
    EXPECT_TRUE(found.closed.empty());
    EXPECT_TRUE(found.welded.empty());
}

TEST(WeldedVertices, AreTheFirstOfEachPosition) {
    const std::vector<glm::vec3> positions{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {1, 2, 4}, {0, 0, 0}, {1, 2, 3}};
    EXPECT_EQ(closedParts(positions.data(), positions.size(), nullptr, 0).welded,
              (std::vector<unsigned>{0, 1, 0, 3, 1, 0}));
}

TEST(WeldedVertices, TakeMinusZeroForZeroAndNothingElseForEqual) {
    const float next = std::nextafter(1.0f, 2.0f);
    const std::vector<glm::vec3> positions{{0.0f, 1.0f, 0.0f}, {-0.0f, 1.0f, -0.0f}, {0.0f, next, 0.0f}};
    EXPECT_EQ(closedParts(positions.data(), positions.size(), nullptr, 0).welded, (std::vector<unsigned>{0, 0, 2}));
}
