// SPDX-License-Identifier: MIT
// Ground from loose triangles: against height fields cut into the same triangles, and shapes worked by hand.
#include "Compare.h"
#include "GroundTriangles.h"
#include <support/TerrainTrial.h>

#include <algorithm>
#include <ctime>

using gnomon::Ground;
using gnomon::GroundTriangle;
using gnomon::HeightPyramid;
using gnomon::TriangleGround;
using gnomon::test::near;
using gnomon::test::Random;

namespace {

constexpr int posts = 70;

TriangleGround groundOf(const std::vector<GroundTriangle>& triangles) {
    return test::LooseTriangles(triangles).ground();
}

TriangleGround cellsOf(const gnomon::HeightField& field, const glm::dvec3& offset = {}) {
    return groundOf(test::trianglesOf(field, offset));
}

/// A hilly field with a hole of 3 × 2 cells.
HeightPyramid holed() {
    return test::groundOf(
        [](double x, double y) { return y == 300.0 && (x == 400.0 || x == 410.0) ? NAN : test::steepHills(x, y); },
        posts);
}

/// Two terraces, 0 and 8 high, and the vertical cliff between them at x = 10.
std::vector<GroundTriangle> terraces() {
    const glm::dvec3 a(0, 0, 8), b(10, 0, 8), c(10, 20, 8), d(0, 20, 8);
    const glm::dvec3 e(10, 0, 0), f(30, 0, 0), g(30, 20, 0), h(10, 20, 0);
    return {{a, b, c}, {a, c, d}, {e, f, g}, {e, g, h}, {b, e, h}, {b, h, c}};
}

TEST(TriangleGround, HasTheHeightsOfTheHeightFieldThatItWasCutFrom) {
    const HeightPyramid field = holed();
    for (const glm::dvec3& offset : {glm::dvec3(0.0), glm::dvec3(433000.0, 5410000.0, 300.0)}) {
        const TriangleGround ground = cellsOf(field.field(), offset);
        Random random(1);
        int holes = 0;
        for (int i = 0; i < 20000; ++i) {
            glm::dvec2 at(random.between(-5.0, 700.0), random.between(-5.0, 700.0));
            if (i % 10 == 0) at = glm::round(at / 5.0) * 5.0; // posts, edges and diagonals
            const auto expected = field.height(at.x, at.y), found = ground.height(at.x + offset.x, at.y + offset.y);
            const bool onBorder = glm::fract(at / test::pitch) == glm::dvec2(0.0);
            if (onBorder && bool(found) != bool(expected)) continue; // a hole's own border is its neighbours', too
            ASSERT_EQ(bool(found), bool(expected)) << at.x << ' ' << at.y;
            if (!found) ++holes;
            // Coordinates of 5 410 000 are known to 10⁻⁹, heights on slopes below 1 hence too.
            else
                EXPECT_NEAR(*found - offset.z, *expected, 4e-9);
        }
        EXPECT_GT(holes, 300);
    }
}

/// From posts, edges and diagonals, and from beside the grid; along borders of cells, across posts, straight up and down.
TEST(TriangleGround, IsMetByRaysAlongTheBordersOfCellsWhereTheHeightFieldIs) {
    const HeightPyramid field = test::groundOf(test::steepHills, posts);
    const TriangleGround ground = cellsOf(field.field());
    Random random(5);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec2 at = 5.0 * glm::round(glm::dvec2(random.between(-6.0, 144.0), random.between(-6.0, 144.0)));
        const glm::dvec2 way = glm::round(glm::dvec2(random.between(-1.5, 1.5), random.between(-1.5, 1.5)));
        const glm::dvec3 start(at, random.between(-60.0, 60.0)), along(way, random.between(-1.0, 1.0));
        const auto expected = ground.hit(start, along), found = field.hit(start, along);
        ASSERT_EQ(bool(found), bool(expected)) << i;
        if (!found) continue;
        ++hits;
        EXPECT_TRUE(near(*found, *expected, 1e-9)) << i;
    }
    EXPECT_GT(hits, 5000);
}

TEST(TriangleGround, LetsNoRaySlipBetweenTrianglesThatShareAnEdgeOrAPost) {
    const HeightPyramid field = test::groundOf(test::steepHills, posts);
    const TriangleGround ground = cellsOf(field.field());
    Random random(3);
    for (int i = 0; i < 5000; ++i) {
        const int x = 1 + int(random.between(0.0, posts - 3.0)), y = 1 + int(random.between(0.0, posts - 3.0));
        const glm::dvec3 a = field.field().post(x, y), b = field.field().post(x + 1, y + 1);
        const glm::dvec3 target = i % 2 ? a : a + random.between(0.0, 1.0) * (b - a);
        const glm::dvec3 start = target + glm::dvec3(random.between(-90.0, 90.0), random.between(-90.0, 90.0), 300.0);
        for (const Ground* each : {static_cast<const Ground*>(&ground), static_cast<const Ground*>(&field)}) {
            const auto hit = each->hit(start, target - start);
            ASSERT_TRUE(hit) << i;
            EXPECT_TRUE(near(*hit, target, 1e-9));
        }
    }
}

TEST(GroundBox, IsEnteredByRaysThatGrazeItsCorners) {
    Random random(4);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 along = random.direction(), corner = random.between(1.0, 1000.0) * along;
        // Of the eight boxes around the corner's octants these are met in the corner alone, or all along.
        const glm::dvec3 side(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0), end = corner + side;
        const gnomon::RaySpan span = gnomon::spanInside({glm::min(corner, end), glm::max(corner, end)}, {}, along);
        EXPECT_LE(span.from, span.to) << i;
    }
}

TEST(TriangleGround, OfNothingIsNowhere) {
    const double nan = gnomon::test::notANumber;
    const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    const TriangleGround grounds[] = {
        {{}, {}},
        {{a, b, c}, {0, 1}},
        {{a, b, c}, {0, 1, 3}},
        {{a, b, c}, {0, 1, 1}},
        {{a, b, {2, 0, 0}}, {0, 1, 2}},
        {{a, b, {nan, 1, 0}}, {0, 1, 2}},
        {{a, b, {0, gnomon::test::infinite, 0}}, {0, 1, 2}},
    };
    for (const TriangleGround& ground : grounds) {
        EXPECT_EQ(ground.triangles(), 0u);
        EXPECT_FALSE(ground.height(0.2, 0.2));
        EXPECT_FALSE(ground.hit({0.2, 0.2, 5.0}, {0.0, 0.0, -1.0}));
        EXPECT_FALSE(ground.range({-9.0, -9.0}, {9.0, 9.0}));
    }
}

TEST(TriangleGround, OfOneTriangleIsThatTriangleWhicheverWayItTurns) {
    for (const std::vector<unsigned>& indices : {std::vector<unsigned>{0, 1, 2}, std::vector<unsigned>{2, 1, 0}}) {
        const TriangleGround ground({{0, 0, 1}, {4, 0, 1}, {0, 4, 5}}, indices);
        EXPECT_DOUBLE_EQ(*ground.height(1.0, 2.0), 3.0);
        EXPECT_DOUBLE_EQ(*ground.height(0.0, 4.0), 5.0) << "a corner";
        EXPECT_FALSE(ground.height(2.1, 2.1));
        EXPECT_FALSE(ground.height(gnomon::test::notANumber, 1.0));
        EXPECT_TRUE(near(*ground.hit({1, 2, 9}, {0, 0, -3}), glm::dvec3(1, 2, 3), 1e-12));
        EXPECT_TRUE(near(*ground.hit({1, 2, -9}, {0, 0, 3}), glm::dvec3(1, 2, 3), 1e-12)) << "from below";
        EXPECT_FALSE(ground.hit({1, 2, 9}, {0, 0, 3}));
        EXPECT_DOUBLE_EQ(ground.range({0, 0}, {4, 4})->steepest, 1.0);
    }
}

TEST(TriangleGround, HasCliffsThatStopRaysButHaveNoHeight) {
    const TriangleGround ground = groundOf(terraces());
    EXPECT_DOUBLE_EQ(*ground.height(9.9, 5.0), 8.0);
    EXPECT_DOUBLE_EQ(*ground.height(10.1, 5.0), 0.0);
    EXPECT_DOUBLE_EQ(*ground.height(10.0, 5.0), 8.0) << "the highest";
    EXPECT_TRUE(near(*ground.hit({20, 5, 6}, {-5, 1, -1}), glm::dvec3(10, 7, 4), 1e-12));
    EXPECT_TRUE(near(*ground.hit({20, 5, 4}, {0, 0, -1}), glm::dvec3(20, 5, 0), 1e-12));
    EXPECT_EQ(ground.range({10.5, 1.0}, {29.0, 19.0})->steepest, 0.0);
    EXPECT_EQ(ground.range({9.5, 1.0}, {29.0, 19.0})->steepest, gnomon::test::infinite);
}

TEST(TriangleGround, UnderABridgeIsGroundTooButTheHeightIsTheBridges) {
    const glm::dvec3 a(0, 0, 0), b(9, 0, 0), c(9, 9, 0), d(0, 9, 0);
    const glm::dvec3 e = glm::dvec3(3, 0, 5), f(6, 0, 5), g(6, 9, 5), h(3, 9, 5);
    const TriangleGround ground = groundOf({{a, b, c}, {a, c, d}, {e, f, g}, {e, g, h}});
    EXPECT_DOUBLE_EQ(*ground.height(4.0, 5.0), 5.0);
    EXPECT_DOUBLE_EQ(*ground.height(2.0, 5.0), 0.0);
    EXPECT_TRUE(near(*ground.hit({4, 5, 9}, {0, 0, -1}), glm::dvec3(4, 5, 5), 1e-12));
    EXPECT_TRUE(near(*ground.hit({4, 5, 4}, {0, 0, -1}), glm::dvec3(4, 5, 0), 1e-12));
    EXPECT_EQ(ground.range({4.0, 1.0}, {5.0, 2.0})->low, 0.0);
    EXPECT_EQ(ground.range({4.0, 1.0}, {5.0, 2.0})->high, 5.0);
}

/// Against all posts over the rectangle, a hole and the border among them.
TEST(HeightPyramid, HasNothingLowerOrHigherThanItsRange) {
    const HeightPyramid field = holed();
    Random random(9);
    const double size = (posts - 1) * test::pitch;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 low(random.between(-50.0, size), random.between(-50.0, size));
        const glm::dvec2 high = low + glm::dvec2(random.between(1.0, 150.0), random.between(1.0, 150.0));
        const auto range = field.range(low, high);
        for (int k = 0; k < 100; ++k) {
            const glm::dvec2 p(random.between(low.x, high.x), random.between(low.y, high.y));
            const auto height = field.height(p.x, p.y);
            if (!height) continue;
            ASSERT_TRUE(range);
            EXPECT_TRUE(*height >= range->low && *height <= range->high);
            EXPECT_LE(range->high - range->low, 60.0) << "of the whole";
        }
    }
    EXPECT_FALSE(field.range({-30.0, 10.0}, {-20.0, 30.0})) << "beside it";
    EXPECT_FALSE(field.range({401.0, 301.0}, {402.0, 302.0})) << "in the hole";
    EXPECT_FALSE(field.range({std::nan(""), 301.0}, {402.0, 302.0}));
}

/// A slope of a wall's steepness is among them, and a field that stands upright altogether: in plan a line.
std::vector<std::vector<GroundTriangle>> groundsForRanges() {
    std::vector<GroundTriangle> lying = test::trianglesOf(holed().field()), standing = lying;
    for (GroundTriangle& t : standing)
        for (glm::dvec3& corner : t) corner = {corner.x, -corner.z, corner.y};
    const std::vector<GroundTriangle> cliff = terraces();
    lying.insert(lying.end(), cliff.begin(), cliff.end());
    return {lying, standing};
}

TEST(TriangleGround, HasTheRangeOfThoseOfItsTrianglesWhoseBoundsTouchTheRectangle) {
    for (const std::vector<GroundTriangle>& all : groundsForRanges()) {
        const TriangleGround ground = groundOf(all);
        Random random(12);
        for (int i = 0; i < 300; ++i) {
            const glm::dvec2 low(random.between(-50.0, 700.0), random.between(-50.0, i % 2 ? 30.0 : 700.0));
            const glm::dvec2 high = low + glm::dvec2(random.between(0.0, 300.0), random.between(0.0, 300.0));
            gnomon::GroundRange expected{HUGE_VAL, -HUGE_VAL, 0.0};
            for (const GroundTriangle& t : all) {
                const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
                const auto [near, far] = std::minmax({t[0].y, t[1].y, t[2].y});
                if (right < low.x || left > high.x || far < low.y || near > high.y) continue;
                const auto [bottom, top] = std::minmax({t[0].z, t[1].z, t[2].z});
                const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
                expected = {std::min(expected.low, bottom), std::max(expected.high, top),
                            std::max(expected.steepest, std::hypot(n.x, n.y) / std::abs(n.z))};
            }
            const auto range = ground.range(low, high);
            ASSERT_EQ(range.has_value(), expected.low <= expected.high);
            if (!range) continue;
            EXPECT_EQ(range->low, expected.low);
            EXPECT_EQ(range->high, expected.high);
            if (std::isinf(expected.steepest))
                EXPECT_EQ(range->steepest, expected.steepest);
            else
                EXPECT_NEAR(range->steepest, expected.steepest, 1e-9 * expected.steepest) << "turned: other roundings";
        }
    }
}

/// A field of 10 m cells, some of which are left out, and a bridge over it.
TEST(TriangleGround, HasHolesWhereAnEdgeIsOfOneTriangleButAtItsEnds) {
    const gnomon::HeightField field = holed().field();
    std::vector<GroundTriangle> all = test::trianglesOf(field);
    const double end = (field.columns() - 1) * field.step().x, top = 100.0;
    const glm::dvec3 a(20.0, 20.0, top), b(80.0, 20.0, top), c(80.0, 30.0, top), d(20.0, 30.0, top);
    all.insert(all.end(), {{a, b, c}, {a, c, d}});
    const TriangleGround ground = groundOf(all);
    const auto holesIn = [&](double x, double y, double side) {
        const auto range = ground.range({x, y}, {x + side, y + side});
        return range && range->holes;
    };
    EXPECT_TRUE(holesIn(40.0, 15.0, 6.0)) << "at the bridge's edge";
    EXPECT_TRUE(holesIn(0.0, 0.0, end));
    const auto isHole = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < field.columns() - 1 && y < field.rows() - 1 && field.isHole(x, y);
    };
    int whole = 0, open = 0;
    for (int y = 5; y + 1 < field.rows(); ++y) // beyond the bridge
        for (int x = 0; x + 1 < field.columns(); ++x) {
            if (field.isHole(x, y)) continue;
            const bool beside = isHole(x - 1, y) || isHole(x + 1, y) || isHole(x, y - 1) || isHole(x, y + 1);
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.4) * field.step();
            EXPECT_EQ(holesIn(at.x, at.y, 0.2 * field.step().x), beside) << x << " " << y;
            ++(beside ? open : whole);
        }
    EXPECT_GT(open, 0);
    EXPECT_GT(whole, 100);
}

/// Seconds of processor time for 20 000 heights and rays on a field of posts².
double seconds(int side) {
    const HeightPyramid field = test::groundOf(test::steepHills, side);
    const TriangleGround ground = cellsOf(field.field());
    const double size = (side - 1) * test::pitch;
    Random random(5);
    const std::clock_t start = std::clock();
    double sum = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec2 at(random.between(0.0, size), random.between(0.0, size));
        sum += *ground.height(at.x, at.y);
        if (const auto hit = ground.hit({at, 60.0}, {0.3, 0.2, -0.5})) sum += hit->z;
    }
    EXPECT_TRUE(std::isfinite(sum));
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(TriangleGround, CostsLittleMoreWhereThereAreAHundredTimesAsManyTriangles) {
    EXPECT_LT(seconds(500), 20.0 * seconds(50)) << "a search through all costs 100 times as much";
}

} // namespace
