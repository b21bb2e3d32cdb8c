// SPDX-License-Identifier: MIT
#include "Compare.h"
#include <support/Soup.h>

#include <gnomon/geometry/ClosedParts.h>
#include <gnomon/geometry/MeshEdges.h>

#include <functional>
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

namespace {

constexpr int around = 24; // meridians of a globe, and twice its circles of latitude

/// A globe's triangles but those that are left out; they look outwards.
Soup globe(const std::function<bool(int latitude, int longitude)>& isLeftOut) {
    constexpr double pi = 3.14159265358979323846;
    const auto place = [&](int latitude, int longitude) {
        const double down = pi * latitude / (around / 2), turn = 2.0 * pi * (longitude % around) / around;
        const double radius = latitude == 0 || 2 * latitude == around ? 0.0 : std::sin(down);
        return glm::vec3(radius * std::cos(turn), radius * std::sin(turn), std::cos(down));
    };
    Soup soup;
    for (int i = 0; 2 * i < around; ++i)
        for (int j = 0; j < around; ++j) {
            if (isLeftOut(i, j)) continue;
            const glm::vec3 a = place(i, j), b = place(i + 1, j), c = place(i + 1, j + 1), d = place(i, j + 1);
            if (i > 0) soup.triangle(a, b, d);
            if (2 * i + 2 < around) soup.triangle(b, c, d);
        }
    return soup;
}

/// How often the line through a place along z meets triangles from the front (seen from +z) and from behind.
struct Crossings {
    int front = 0, back = 0;

    void add(const glm::dvec2& at, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
            return (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);
        };
        const double ab = side(a, b), bc = side(b, c), ca = side(c, a);
        front += ab > 0.0 && bc > 0.0 && ca > 0.0;
        back += ab < 0.0 && bc < 0.0 && ca < 0.0;
    }
};

/// What lights that look along z see of a soup, and of what fills its holes.
struct Looked {
    int behindNoFront = 0, frontless = 0; ///< places where backs are not in pairs with fronts: off the holes, in all.
};

Looked look(const Soup& soup) {
    const ClosedParts found = partsOf(soup);
    Looked result;
    for (int i = 0; i < 97; ++i)
        for (int j = 0; j < 97; ++j) {
            const glm::dvec2 at(-1.05 + 0.0217 * i, -1.05 + 0.0219 * j); // on no edge
            Crossings own, filling;
            for (std::size_t t = 0; t + 2 < soup.vertices.size(); t += 3)
                own.add(at, soup.vertices[t], soup.vertices[t + 1], soup.vertices[t + 2]);
            for (const auto& hole : found.holes)
                for (std::size_t t = 0; t + 2 < hole.size(); t += 3)
                    filling.add(at, soup.vertices[hole[t]], soup.vertices[hole[t + 1]], soup.vertices[hole[t + 2]]);
            EXPECT_EQ(own.front + filling.front, own.back + filling.back);
            result.frontless += own.back > own.front;
            result.behindNoFront += own.back > own.front && filling.front == 0;
        }
    return result;
}

bool isAll(const std::vector<bool>& values, bool value) {
    return std::all_of(values.begin(), values.end(), [value](bool each) { return each == value; });
}

bool isNorth(int latitude, int) { return latitude < 2; }

} // namespace

// A cap and a window are missing: through both backs are seen; where none is seen through a hole it has a front.
TEST(HoledParts, ShowBacksThroughTheirHolesAlone) {
    const Soup soup = globe([](int latitude, int longitude) {
        return isNorth(latitude, longitude) || (latitude >= 4 && latitude < 6 && longitude >= 3 && longitude < 6);
    });
    const ClosedParts found = partsOf(soup);
    EXPECT_TRUE(isAll(found.closed, false));
    EXPECT_TRUE(isAll(found.holed, true));
    EXPECT_EQ(found.holes.size(), 2u);
    const Looked looked = look(soup);
    EXPECT_GT(looked.frontless, 100);
    EXPECT_EQ(looked.behindNoFront, 0);
}

// Seen from its tip all of a spike's volume is beneath what fills its foot, and from the foot none: by the order of its
// triangles the one or the other is looked from.
TEST(HoledParts, AreWhatHasAVolumeWithTheirHolesFilled) {
    const glm::vec3 tip(0.0f, 0.0f, 4.0f);
    const std::vector<glm::vec3> foot{
        {-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.5f, 0.0f}, {-0.5f, 0.5f, 0.0f}};
    for (const unsigned turn : {0u, 1u, 2u}) {
        Soup spike;
        for (unsigned i = 0; i < 4; ++i) {
            const glm::vec3 corners[]{foot[i], foot[(i + 1) % 4], tip};
            spike.triangle(corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]);
        }
        EXPECT_TRUE(isAll(partsOf(spike).holed, true)) << turn;
        EXPECT_TRUE(isAll(partsOf(spike.turned()).holed, false)) << turn;
    }
}

// A dome is half a globe.
TEST(HoledParts, AreNotInsideOutAndHaveNoWideHole) {
    const Soup dome = globe([](int latitude, int) { return 4 * latitude >= around; });
    for (const Soup& soup : {globe(isNorth).turned(), dome}) {
        const ClosedParts found = partsOf(soup);
        EXPECT_TRUE(isAll(found.holed, false));
        EXPECT_TRUE(found.holes.empty());
    }
}

// Of a bowl on a post the inside looks up, and its outside is not there: under a low sun its wall's back is before its inside.
TEST(HoledParts, AreNotWhatIsJoinedInACornerAlone) {
    Soup soup = globe([](int latitude, int) { return 4 * latitude < around; }).turned();
    const glm::vec3 lowest = *std::min_element(soup.vertices.begin(), soup.vertices.end(),
                                               [](const auto& a, const auto& b) { return a.z < b.z; });
    soup.add(tetrahedron(6.0f).moved(lowest - glm::vec3(0.0f, 0.0f, 6.0f))); // its tip is there
    EXPECT_TRUE(isAll(partsOf(soup).holed, false));
}

// Were it joined to the rest over two edges of three triangles, a fin would be.
TEST(HoledParts, AreNotWhatHasAFin) {
    Soup soup = globe([](int, int) { return false; });
    const glm::vec3 a = soup.vertices[0], b = soup.vertices[1];
    soup.triangle(a, b, 1.1f * (a + b) / glm::length(a + b));
    EXPECT_TRUE(isAll(partsOf(soup).holed, false));
}

TEST(HoledParts, AreToldFromWhatIsClosed) {
    Soup soup = globe(isNorth);
    const std::size_t holed = soup.vertices.size() / 3;
    soup.add(tetrahedron().moved({3.0f, 0.0f, 0.0f}));
    const ClosedParts found = partsOf(soup);
    EXPECT_EQ(std::count(found.holed.begin(), found.holed.end(), true), std::ptrdiff_t(holed));
    EXPECT_EQ(std::count(found.closed.begin(), found.closed.end(), true), 4);
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
