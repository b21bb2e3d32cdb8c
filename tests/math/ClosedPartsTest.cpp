// SPDX-License-Identifier: MIT
#include "Compare.h"

#include <gnomon/geometry/ClosedParts.h>

#include <functional>
#include <utility>

using namespace gnomon;

namespace {

/// Triangles without shared vertices, as most scenes have them.
struct Soup {
    std::vector<glm::vec3> positions;

    ClosedParts parts() const {
        std::vector<unsigned> indices(positions.size());
        for (unsigned i = 0; i < indices.size(); ++i) indices[i] = i;
        return closedParts(positions.data(), positions.size(), indices.data(), indices.size(), true);
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

TEST(ClosedParts, AreSolidsWhoseFacesLookOutwardsAndNoneOfWhichIsMissing) {
    EXPECT_EQ(tetrahedron().closedTriangles(), 4);
    EXPECT_EQ(tetrahedron().turned().closedTriangles(), 0) << "inside out";
    for (std::size_t face = 0; face < 4; ++face) EXPECT_EQ(tetrahedron().without(face).closedTriangles(), 0);
    Soup soup = tetrahedron();
    std::swap(soup.positions[0], soup.positions[1]);
    EXPECT_EQ(soup.closedTriangles(), 0) << "one face is turned round";
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

TEST(ClosedParts, ThatTouchInAVertexOrShareAnEdgeAreClosed) {
    Soup touching = tetrahedron(), sharing = tetrahedron(), opposite = tetrahedron();
    touching.add(tetrahedron().moved({1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(touching.closedTriangles(), 8);
    for (glm::vec3& position : opposite.positions) position = {-position.x, -position.y, position.z};
    sharing.add(opposite); // four triangles meet in the edge: two go each way
    EXPECT_EQ(sharing.closedTriangles(), 8);
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

TEST(ClosedParts, AreFoundFarFromTheOriginAndInAnyUnit) {
    // 2²³ + 1 is a float, the cube of it keeps no ones
    EXPECT_EQ(tetrahedron().moved({8388608.0f, -8388608.0f, 4194304.0f}).closedTriangles(), 4);
    for (const float size : {1e-12f, 1e-3f, 1e3f, 1e12f}) EXPECT_EQ(tetrahedron(size).closedTriangles(), 4);
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
            if (i > 0) soup.add(a, b, d);
            if (2 * i + 2 < around) soup.add(b, c, d);
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
    const ClosedParts found = soup.parts();
    Looked result;
    for (int i = 0; i < 97; ++i)
        for (int j = 0; j < 97; ++j) {
            const glm::dvec2 at(-1.05 + 0.0217 * i, -1.05 + 0.0219 * j); // on no edge
            Crossings own, filling;
            for (std::size_t t = 0; t + 2 < soup.positions.size(); t += 3)
                own.add(at, soup.positions[t], soup.positions[t + 1], soup.positions[t + 2]);
            for (const auto& hole : found.holes)
                for (std::size_t t = 0; t + 2 < hole.size(); t += 3)
                    filling.add(at, soup.positions[hole[t]], soup.positions[hole[t + 1]], soup.positions[hole[t + 2]]);
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
    const ClosedParts found = soup.parts();
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
            spike.add(corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]);
        }
        EXPECT_TRUE(isAll(spike.parts().holed, true)) << turn;
        EXPECT_TRUE(isAll(spike.turned().parts().holed, false)) << turn;
    }
}

// A dome is half a globe.
TEST(HoledParts, AreNotInsideOutAndHaveNoWideHole) {
    const Soup dome = globe([](int latitude, int) { return 4 * latitude >= around; });
    for (const Soup& soup : {globe(isNorth).turned(), dome}) {
        const ClosedParts found = soup.parts();
        EXPECT_TRUE(isAll(found.holed, false));
        EXPECT_TRUE(found.holes.empty());
    }
}

// Of a bowl on a post the inside looks up, and its outside is not there: under a low sun its wall's back is before its inside.
TEST(HoledParts, AreNotWhatIsJoinedInACornerAlone) {
    Soup soup = globe([](int latitude, int) { return 4 * latitude < around; }).turned();
    const glm::vec3 lowest = *std::min_element(soup.positions.begin(), soup.positions.end(),
                                               [](const auto& a, const auto& b) { return a.z < b.z; });
    soup.add(tetrahedron(6.0f).moved(lowest - glm::vec3(0.0f, 0.0f, 6.0f))); // its tip is there
    EXPECT_TRUE(isAll(soup.parts().holed, false));
}

// Were it joined to the rest over two edges of three triangles, a fin would be.
TEST(HoledParts, AreNotWhatHasAFin) {
    Soup soup = globe([](int, int) { return false; });
    const glm::vec3 a = soup.positions[0], b = soup.positions[1];
    soup.add(a, b, 1.1f * (a + b) / glm::length(a + b));
    EXPECT_TRUE(isAll(soup.parts().holed, false));
}

TEST(HoledParts, AreToldFromWhatIsClosed) {
    Soup soup = globe(isNorth);
    const std::size_t holed = soup.positions.size() / 3;
    soup.add(tetrahedron().moved({3.0f, 0.0f, 0.0f}));
    const ClosedParts found = soup.parts();
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
            soup.add(at(stack, slice), at(stack + 1, slice), at(stack + 1, slice + 1));
            soup.add(at(stack, slice), at(stack + 1, slice + 1), at(stack, slice + 1));
        }
    return soup;
}

TEST(ClosedParts, OfABallWhoseSeamRoundingLeavesOpenAreClosed) {
    const Soup round = ball(16);
    ASSERT_NE(round.positions[1], ball(16).positions[3 * 2 * 15 + 2]); // the seam: one angle, two values
    EXPECT_EQ(round.closedTriangles(), long(round.positions.size() / 3));
    EXPECT_EQ(round.turned().closedTriangles(), 0);
}

TEST(ClosedParts, StayOpenWhereASeamIsWiderThanRounding) {
    Soup gaping = tetrahedron();
    for (std::size_t i = 9; i < 12; ++i) gaping.positions[i] += 4e-6f; // the slanted face, off by 33 steps of float
    EXPECT_EQ(gaping.closedTriangles(), 0);
}

TEST(ClosedParts, OfNothingAreNone) { EXPECT_TRUE(closedParts(nullptr, 0, nullptr, 0).closed.empty()); }

TEST(WeldedVertices, AreTheFirstOfEachPositionAndMinusZeroIsZero) {
    const float next = std::nextafter(1.0f, 2.0f);
    const std::vector<glm::vec3> positions{{1, 2, 3}, {0, 0, 0}, {1, 2, 3},         {1, 2, 4},   {0, 0, 0},
                                           {1, 2, 3}, {0, 1, 0}, {-0.0f, 1, -0.0f}, {0, next, 0}};
    EXPECT_EQ(closedParts(positions.data(), positions.size(), nullptr, 0).welded,
              (std::vector<unsigned>{0, 1, 0, 3, 1, 0, 6, 6, 8}));
}
