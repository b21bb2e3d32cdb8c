// SPDX-License-Identifier: MIT
// Casters as convex pieces: their shadows together against rays at the casters' triangles in double.
#include <support/Soup.h>

#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/geometry/ConvexPolygons.h>
#include <gnomon/ground/GroundSearch.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using gnomon::ConvexPart;
using gnomon::convexParts;
using test::Soup;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

std::vector<ConvexPart> partsOf(const Soup& soup) {
    return convexParts(soup.vertices.data(), soup.vertices.size(), soup.indices.data(), soup.indices.size());
}

Soup box() {
    Soup soup;
    soup.box({-3, -2, 0}, {3, 2, 5});
    return soup;
}

/// Upright over the filled squares of a plan, pitch 2, 4 high: "XX", "X." is an L.
Soup onPlan(const std::vector<std::string>& plan, bool floor = true) {
    Soup soup;
    const auto filled = [&](int x, int y) {
        return y >= 0 && y < int(plan.size()) && x >= 0 && x < int(plan[y].size()) && plan[y][x] == 'X';
    };
    const glm::dvec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 4);
    for (int j = 0; j < int(plan.size()); ++j)
        for (int i = 0; i < int(plan[j].size()); ++i) {
            if (!filled(i, j)) continue;
            const glm::dvec3 low(2.0 * i - 3.0, 2.0 * j - 3.0, 0.0);
            soup.quad(low + z, x, y);
            if (floor) soup.quad(low, y, x);
            if (!filled(i, j - 1)) soup.quad(low, x, z);
            if (!filled(i, j + 1)) soup.quad(low + y, z, x);
            if (!filled(i - 1, j)) soup.quad(low, z, y);
            if (!filled(i + 1, j)) soup.quad(low + x, y, z);
        }
    return soup;
}

/// Six corners, fanned from the inner one; walls of two triangles each.
Soup lShape() {
    Soup soup;
    const std::vector<glm::dvec3> rim{{0, 0, 0}, {0, 3, 0}, {-3, 3, 0}, {-3, -3, 0}, {3, -3, 0}, {3, 0, 0}};
    const glm::dvec3 up(0, 0, 4);
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::dvec3 &a = rim[i], &b = rim[(i + 1) % 6];
        soup.quad(a, b - a, up);
        if (i > 0 && i < 5) soup.triangle(rim[0] + up, a + up, b + up);
    }
    return soup;
}

/// A roof that stands out over the walls.
Soup gable(double eaves) {
    Soup soup;
    soup.box({-3, -2, 0}, {3, 2, 4});
    soup = soup.without(2, 2); // its lid
    for (const double side : {-1.0, 1.0})
        soup.triangle({side * 3, -2 * side, 4}, {side * 3, 2 * side, 4}, {side * 3, 0, 6});
    const glm::dvec3 along(6, 0, 0), low(-3, -2 - eaves, 4 - eaves);
    soup.quad(low, along, glm::dvec3(-3, 0, 6) - low);
    soup.quad(glm::dvec3(-3, 0, 6), along, glm::dvec3(0, 2 + eaves, -2 - eaves));
    return soup;
}

Soup tank(int sides, double radius, double low, double high, bool cone = false) {
    Soup soup;
    const auto at = [&](int i, double z) {
        const double angle = 360.0 * degree * (i % sides) / sides;
        return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    const glm::dvec3 top(0, 0, high);
    for (int i = 0; i < sides; ++i) {
        soup.triangle(at(i, cone ? low : high), at(i + 1, cone ? low : high), top);
        if (cone) continue;
        soup.triangle(at(i, low), at(i + 1, low), at(i + 1, high));
        soup.triangle(at(i, low), at(i + 1, high), at(i, high));
    }
    return soup;
}

Soup both(Soup a, const Soup& b) {
    a.add(b);
    return a;
}

Soup fin() {
    Soup soup;
    soup.quad({1, -3, 0}, {1, -1, 0}, {0, 0, 4});
    soup.quad({1, -3, 0}, {0, 0, 4}, {1, -1, 0});
    return soup;
}

Soup cross() {
    Soup soup;
    soup.quad({-3, 0, 0}, {6, 0, 0}, {0, 0, 5});
    soup.quad({0, -3, 0}, {0, 6, 0}, {0, 0, 5});
    return soup;
}

Soup tree() { return both(tank(12, 0.5, 0.0, 3.0), tank(16, 2.5, 2.0, 7.0, true)); }

/// Of different heights, wall at wall with shared corners.
Soup twoHouses() {
    Soup soup;
    soup.box({-3, -2, 0}, {0, 2, 5});
    soup.box({0, -2, 0}, {3, 2, 3});
    return soup;
}

Soup bowl() {
    Soup soup;
    soup.sphere({0, 0, 2}, 3.0, 12);
    Soup half;
    for (std::size_t t = 0; t < soup.size(); ++t)
        if (soup.corner(t, 0).z < 2.1 && soup.corner(t, 1).z < 2.1 && soup.corner(t, 2).z < 2.1)
            half.triangle(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2));
    return half;
}

/// Turned about the middle of the caster; its floor stays level if `upright`.
Soup turned(const Soup& soup, std::mt19937& random, bool upright) {
    const glm::dvec3 up = upright ? glm::dvec3(0, 0, 1) : test::randomDirection(random);
    const glm::dvec3 right = glm::normalize(glm::cross(test::randomDirection(random), up));
    const glm::dvec3 forward = glm::cross(up, right);
    Soup result;
    for (const glm::vec3& v : soup.vertices)
        result.vertices.emplace_back(double(v.x) * right + double(v.y) * forward + double(v.z) * up);
    result.indices = soup.indices;
    return result;
}

bool isBlocked(const Soup& soup, const glm::dvec3& point, const glm::dvec3& sun) {
    const double infinite = std::numeric_limits<double>::infinity();
    return std::isfinite(test::bruteForce(soup, {point, sun, infinite}).distance);
}

/// Points where rays a little to all sides agree; the others are too near to the shadow's rim for single precision.
bool isSure(const Soup& soup, const glm::dvec3& point, const glm::dvec3& sun, bool blocked) {
    for (int i = 0; i < 6; ++i) {
        glm::dvec3 off(0.0);
        off[i % 3] = i < 3 ? 3e-5 : -3e-5;
        if (isBlocked(soup, point + off, sun) != blocked) return false;
    }
    return true;
}

struct Tally {
    int wrong = 0, unsure = 0, shadowed = 0;
};

/// Whether a way towards the sun meets a face of a part.
bool isBlocked(const ConvexPart& part, const glm::dvec3& from, const glm::dvec3& sun) {
    if (part.front && !(glm::dot(glm::dvec3(*part.front), sun) > 0.0)) return false; // others cast its shadow
    const auto corner = [&](unsigned i) { return part.hull.vertices[i]; };
    for (const gnomon::ConvexHull::Face& face : part.hull.faces)
        for (std::size_t i = 2; i < face.corners.size(); ++i)
            if (gnomon::meet({corner(face.corners[0]), corner(face.corners[i - 1]), corner(face.corners[i])}, from,
                             sun))
                return true;
    return false;
}

void compare(const Soup& soup, const glm::dvec3& sun, int points, std::mt19937& random, Tally& tally) {
    const std::vector<ConvexPart> parts = partsOf(soup);
    std::uniform_real_distribution<double> along(-0.2, 1.2), off(-5.0, 5.0);
    for (int i = 0; i < points; ++i) {
        const glm::dvec3 back = sun * (8.0 / sun.z); // from the top to the ground and somewhat on
        const glm::dvec3 point = glm::dvec3(off(random), off(random), 7.0) - back * along(random);
        const bool found =
            std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return isBlocked(part, point, sun); });
        const bool expected = isBlocked(soup, point, sun);
        tally.shadowed += expected;
        if (found == expected) continue;
        (isSure(soup, point, sun, expected) ? tally.wrong : tally.unsure) += 1;
    }
}

struct Case {
    const char* name;
    Soup soup;
    std::size_t most; ///< parts, standing upright.
};

std::vector<Case> cases() {
    return {{"box", box(), 1},
            {"box without floor", box().without(0, 2), 1},
            {"box without lid", box().without(2, 2), 5},
            {"L", lShape(), 2},
            {"L of squares", onPlan({"XX", "X."}), 2},
            {"U without floor", onPlan({"X.X", "XXX"}, false), 3},
            {"courtyard", onPlan({"XXX", "X.X", "XXX"}), 4},
            {"L without a wall", lShape().without(2, 2), 7},
            {"L with a wall of two sides that stands out", both(onPlan({"XX", "X."}), fin()), 12},
            {"gabled house", gable(0.0), 1},
            {"gabled house with eaves", gable(0.5), 9},
            {"tank", tank(20, 3.0, 0.0, 5.0), 1},
            {"cross of plates", cross(), 2},
            {"tree", tree(), 2},
            {"two houses", twoHouses(), 10},
            {"bowl", bowl(), 36}};
}

TEST(ConvexParts, TogetherHoldExactlyThePointsWhoseWayToTheSunIsBlocked) {
    std::mt19937 random(11);
    for (const Case& it : cases()) {
        Tally tally;
        for (int turn = 0; turn < 6; ++turn) {
            const Soup soup = turned(it.soup, random, turn < 4);
            for (const double elevation : {60.0, 30.0, 10.0}) {
                const double azimuth = 2.0 * turn + elevation;
                const glm::dvec3 sun(std::sin(azimuth) * std::cos(elevation * degree),
                                     std::cos(azimuth) * std::cos(elevation * degree), std::sin(elevation * degree));
                compare(soup, sun, 600, random, tally);
            }
        }
        EXPECT_EQ(tally.wrong, 0) << it.name;
        EXPECT_LT(tally.unsure, 4) << it.name;
        EXPECT_GT(tally.shadowed, 200) << it.name;
    }
}

TEST(ConvexParts, AreFewWhereTheCasterStandsUpright) {
    std::mt19937 random(12);
    for (const Case& it : cases()) {
        EXPECT_LE(partsOf(it.soup).size(), it.most) << it.name;
        if (it.most >= 5) continue; // coplanar faces are cut otherwise once they are rounded
        EXPECT_LE(partsOf(turned(it.soup, random, true)).size(), it.most) << it.name << ", turned";
    }
}

TEST(ConvexParts, OfAClosedPartHaveFrontsAndSomeAreTurnedAway) {
    const glm::dvec4 sun(0.3, 0.4, 0.8, 0.0);
    std::size_t away = 0;
    for (const ConvexPart& part : partsOf(twoHouses())) {
        ASSERT_TRUE(part.front);
        EXPECT_GT(part.front->z, -0.5) << "what looks down is left out";
        away += !(glm::dot(*part.front, sun) > 0.0);
    }
    EXPECT_GE(away, 3u);
    for (const ConvexPart& part : partsOf(box().without(2, 2))) EXPECT_FALSE(part.front) << "open";
}

TEST(ConvexParts, DoubledTrianglesCountOnce) {
    for (const Soup& soup : {box(), lShape(), box().without(2, 2)}) {
        EXPECT_EQ(partsOf(both(soup, soup.turned())).size(), partsOf(soup).size());
    }
}

TEST(ConvexParts, OfAWallWithAHoleAreNotItsHull) {
    Soup soup = box();
    soup = soup.without(4); // half of a wall
    EXPECT_GT(partsOf(soup).size(), 1u);
    soup.triangle({-3, -2, 0}, {3, -2, 0}, {-3, -2, 5}); // as much area again, but over what is there
    EXPECT_GT(partsOf(soup).size(), 1u);
}

/// Of sides 6, 6 and t, and 6, t and t.
TEST(ConvexParts, OfPlatesAndNeedlesAreOneUnlessAFaceIsMissing) {
    std::mt19937 random(13);
    for (const double thin : {0.3, 0.03, 3e-3, 3e-4})
        for (const glm::dvec3& half : {glm::dvec3(3, 3, thin), glm::dvec3(3, thin, 3), glm::dvec3(thin, thin, 3)})
            for (int turn = 0; turn < 4; ++turn) {
                Soup soup;
                soup.box(-half, half);
                EXPECT_EQ(partsOf(turned(soup, random, true)).size(), 1u) << thin;
                EXPECT_EQ(partsOf(turned(soup.without(0, 2), random, true)).size(), 1u) << thin << ", without floor";
                for (std::size_t face = 2; face < 12; face += 2) {
                    EXPECT_GT(partsOf(turned(soup.without(face, 2), random, true)).size(), 1u) << thin << " " << face;
                    EXPECT_GT(partsOf(turned(soup.without(face), random, true)).size(), 1u) << thin << " " << face;
                }
            }
}

/// 0.1 wide and deep in a box of 6 x 4 x 5: a millionth of its size times its surface is more than that holds.
TEST(ConvexParts, OfABoxWithASmallPitAreNotItsHull) {
    Soup soup = box().without(2, 2); // its lid
    const auto corner = [](int i, double half, double z) {
        const int k = i % 4;
        return glm::dvec3(k == 0 || k == 3 ? -1 : 1, k < 2 ? -1 : 1, 0) * glm::dvec3(half, half, 0) +
               glm::dvec3(0, 0, z);
    };
    const auto rim = [&](int i) { return glm::dvec3(3, 2, 1) * corner(i, 1.0, 5.0); };
    for (int i = 0; i < 4; ++i) {
        soup.triangle(rim(i), rim(i + 1), corner(i, 0.05, 5.0));
        soup.triangle(rim(i + 1), corner(i + 1, 0.05, 5.0), corner(i, 0.05, 5.0));
        soup.triangle(corner(i, 0.05, 5.0), corner(i + 1, 0.05, 5.0), corner(i, 0.05, 4.9));
        soup.triangle(corner(i + 1, 0.05, 5.0), corner(i + 1, 0.05, 4.9), corner(i, 0.05, 4.9));
    }
    EXPECT_GT(partsOf(soup).size(), 1u) << "a hole down to nothing";
    soup.triangle(corner(0, 0.05, 4.9), corner(1, 0.05, 4.9), corner(2, 0.05, 4.9));
    soup.triangle(corner(0, 0.05, 4.9), corner(2, 0.05, 4.9), corner(3, 0.05, 4.9));
    EXPECT_GT(partsOf(soup).size(), 1u);
}

/// Schoenhardt's: a prism on a triangle, turned by 30 degrees, its sides folded in. All corners are on its hull, which is
/// larger by three tetrahedra. Folded out it is its hull.
TEST(ConvexParts, OfASolidThatIsFoldedInBetweenCornersOfItsHullAreNotThat) {
    const auto at = [](int i, double z) {
        const double angle = (120.0 * i + 30.0 * (z > 0.0)) * degree;
        return glm::dvec3(3.0 * std::cos(angle), 3.0 * std::sin(angle), z);
    };
    for (const bool in : {true, false}) {
        Soup soup;
        soup.triangle(at(0, 4.0), at(1, 4.0), at(2, 4.0));
        soup.triangle(at(2, 0.0), at(1, 0.0), at(0, 0.0));
        for (int i = 0; i < 3; ++i)
            if (in) {
                soup.triangle(at(i, 0.0), at(i + 1, 0.0), at(i + 1, 4.0));
                soup.triangle(at(i, 0.0), at(i + 1, 4.0), at(i, 4.0));
            } else {
                soup.triangle(at(i, 0.0), at(i + 1, 0.0), at(i, 4.0));
                soup.triangle(at(i + 1, 0.0), at(i + 1, 4.0), at(i, 4.0));
            }
        EXPECT_EQ(partsOf(soup).size() > 1, in);
    }
}

/// What is inside of a solid casts nothing that it does not cast itself.
TEST(ConvexParts, OfABoxWithASheetInsideAreItsHull) {
    Soup soup = box();
    soup.quad({-3, -2, 0}, {6, 0, 0}, {0, 4, 5});
    EXPECT_EQ(partsOf(soup).size(), 1u);
}

TEST(ConvexParts, OfBrokenTrianglesAreThoseOfTheOthers) {
    Soup soup = box();
    const auto count = static_cast<unsigned>(soup.vertices.size());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    soup.triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    soup.triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    soup.triangle({0, 0, 0}, {nan, 1, 1}, {2, 0, 2});
    soup.triangle({0, 0, 0}, {1, 1, 1}, {std::numeric_limits<double>::infinity(), 0, 2});
    soup.indices.insert(soup.indices.end(), {0, 1, count + 100, 0, 1}); // two indices too many, too
    EXPECT_EQ(partsOf(soup).size(), 1u);
    EXPECT_TRUE(partsOf(Soup()).empty());
    Soup star; // five plates at one edge, and a Moebius strip's odd sense
    for (int i = 0; i < 5; ++i) star.quad({0, 0, 0}, {std::cos(1.2 * i), std::sin(1.2 * i), 0}, {0, 0, 3});
    EXPECT_EQ(partsOf(star).size(), 5u);
}

/// Triangles from (0, -1) to each two neighbours of a row of points.
std::vector<gnomon::ConvexPolygon> polygonsUnder(const std::vector<glm::dvec3>& row) {
    std::vector<glm::dvec3> points = row;
    points.emplace_back(0.0, -1.0, 0.0);
    std::vector<gnomon::Corners> triangles;
    for (unsigned i = 0; i + 1 < row.size(); ++i) triangles.push_back({unsigned(row.size()), i + 1, i});
    return gnomon::convexPolygons(points, triangles, 1e-6);
}

TEST(ConvexPolygons, FollowAHollowCurveHoweverFineItIs) {
    std::vector<glm::dvec3> straight, hollow;
    for (int i = -100; i <= 100; ++i) {
        const double x = 0.01 * i;
        straight.emplace_back(x, double(float(0.3 * x)), 0.0); // rounded: turns of some 10⁻⁶, to both sides
        hollow.emplace_back(x, 5e-5 * x * x, 0.0);             // each turn is 10⁻⁶, always to the right
    }
    EXPECT_LE(polygonsUnder(straight).size(), 25u);
    EXPECT_GT(polygonsUnder(hollow).size(), 25u);
    for (const gnomon::ConvexPolygon& polygon : polygonsUnder(hollow)) {
        double from = 1.0, to = -1.0;
        for (const unsigned c : polygon.corners)
            if (c < hollow.size()) from = std::min(from, hollow[c].x), to = std::max(to, hollow[c].x);
        EXPECT_LE(5e-5 * (to - from) * (to - from) / 4.0, 1e-6) << "what a chord leaves out";
    }
}

/// Of a grid of 8 × 8 squares those that are wanted, 2 high.
std::vector<gnomon::ConvexPolygon> polygonsOfGrid(const std::function<bool(unsigned, unsigned)>& wanted, double& area) {
    std::vector<glm::dvec3> points;
    std::vector<gnomon::Corners> triangles;
    for (unsigned y = 0; y < 9; ++y)
        for (unsigned x = 0; x < 9; ++x) {
            points.emplace_back(x, y, 2.0);
            const unsigned a = 9 * y + x;
            if (x < 8 && y < 8 && wanted(x, y))
                triangles.insert(triangles.end(), {{a, a + 1, a + 10}, {a, a + 10, a + 9}});
        }
    const auto polygons = gnomon::convexPolygons(points, triangles, 1e-6);
    area = 0.0;
    for (const gnomon::ConvexPolygon& polygon : polygons)
        for (std::size_t i = 2; i < polygon.corners.size(); ++i) {
            const glm::dvec3 &a = points[polygon.corners[0]], &b = points[polygon.corners[i - 1]],
                             &c = points[polygon.corners[i]];
            const double part = 0.5 * glm::cross(b - a, c - a).z;
            EXPECT_GT(part, 0.0) << "not convex";
            area += part;
        }
    return polygons;
}

TEST(ConvexPolygons, CoverWhatTheTrianglesCover) {
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
        bool wanted[8][8];
        double cells = 0.0, area = 0.0;
        for (auto& row : wanted)
            for (bool& cell : row) cells += (cell = random() % 4 > 0);
        polygonsOfGrid([&](unsigned x, unsigned y) { return wanted[y][x]; }, area);
        EXPECT_DOUBLE_EQ(area, cells) << i;
    }
}

TEST(ConvexPolygons, OfAGridAreOne) {
    double area = 0.0;
    const auto polygons = polygonsOfGrid([](unsigned, unsigned) { return true; }, area);
    ASSERT_EQ(polygons.size(), 1u);
    EXPECT_EQ(polygons[0].corners.size(), 4u);
    EXPECT_DOUBLE_EQ(polygons[0].plane.z, 1.0);
    EXPECT_DOUBLE_EQ(polygons[0].plane.w, -2.0);
}

} // namespace
