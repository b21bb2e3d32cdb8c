// SPDX-License-Identifier: MIT
// How far shadows of many parts move at most while the sun turns.
#include "PackedTown.h"

#include <gnomon/geometry/ConvexHull.h>
#include <gtest/gtest.h>

#include <tuple>

using gnomon::CellCut;
using gnomon::Ground;
using gnomon::HeightPyramid;
using gnomon::movedAtMost;
using gnomon::PackedParts;
using gnomon::PackedShadows;
using gnomon::TerrainOutcome;
using test::found;
using test::groundOf;
using test::hills;
using test::pitch;
using test::posts;
using test::sun;
using test::townOn;

namespace {

/// Of each of them among the others.
std::vector<double> boundsOf(const Ground& ground, const std::vector<gnomon::ConvexPart>& parts, const glm::dvec4& then,
                             const glm::dvec4& now) {
    std::vector<gnomon::ShadowMotion> motions;
    findMotions(ground, PackedParts(parts), found(ground, PackedParts(parts), then), then, motions);
    std::vector<double> bounds;
    for (const gnomon::ShadowMotion& motion : motions)
        bounds.push_back(movedAtMost(motion, gnomon::SunTurn(gnomon::wayOf(then), gnomon::wayOf(now))));
    return bounds;
}

/// How far one part's shadow moves at most.
double boundOf(const Ground& ground, const gnomon::ConvexPart& part, const glm::dvec4& then, const glm::dvec4& now) {
    return boundsOf(ground, {part}, then, now).at(0);
}

/// The corner of a roof at height h over level ground falls h / tan e away.
TEST(ShadowMotions, GoNoFartherThanTheBoundAndOnLevelGroundByIt) {
    const HeightPyramid level({2, 2, glm::dvec2(-5000.0), glm::dvec2(10000.0), std::vector<float>(4, 3.0f)});
    const test::Prism tower = test::boxAt({0.0, 0.0}, {4.0, 4.0}, 0.2, -5.0, 43.0);
    const PackedParts packed(tower.parts());
    const glm::dvec4 then = sun(100.0, 30.0), now = sun(100.0, 31.0);
    const double expected = 40.0 / std::tan(30.0 * test::degree) - 40.0 / std::tan(31.0 * test::degree);
    EXPECT_NEAR(movedAtMost(found(level, packed, then), then, now), expected, 1e-4);
    EXPECT_EQ(movedAtMost(found(level, packed, then), then, then), 0.0);
    EXPECT_GT(movedAtMost(found(level, packed, then), then, sun(100.0, -1.0)), 1e9);
    EXPECT_GT(movedAtMost(found(level, packed, then), {0, 0, 99, 1}, {0, 1, 99, 1}), 1e9) << "a lamp";
}

/// How far the shadow of one of its corners above the ground moves at most, by rays alone.
double farthestMove(const HeightPyramid& ground, const gnomon::ConvexPart& part, const glm::dvec4& then,
                    const glm::dvec4& now) {
    double most = 0.0;
    for (const glm::dvec3& vertex : part.hull.vertices) {
        const auto a = ground.hit(vertex, -glm::dvec3(then)), b = ground.hit(vertex, -glm::dvec3(now));
        if (!a || !b || vertex.z <= *ground.height(vertex.x, vertex.y)) continue;
        most = std::max(most, glm::length(glm::dvec2(*a - *b)));
    }
    return most;
}

TEST(ShadowMotions, OnHillsNoCornerMovesByMoreThanTheBound) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto parts = townOn(ground, 60);
    double most = 0.0;
    for (const auto& part : parts) {
        const glm::dvec4 then = sun(77.0, 40.0), now = sun(79.0, 41.5);
        const double bound = movedAtMost(found(ground, PackedParts({part}), then), then, now);
        const double moved = farthestMove(ground, part, then, now);
        EXPECT_LE(moved, bound);
        most = std::max(most, moved / bound);
    }
    EXPECT_GT(most, 0.7) << "else the bound is of no use";
}

/// The same of each part alone, for turns along the light's way, across it and between.
TEST(ShadowMotions, OnHillsNoCornerMovesByMoreThanItsPartsBoundWhicheverWayTheSunTurns) {
    const HeightPyramid ground = groundOf(hills, posts);
    const glm::dvec4 then = sun(77.0, 40.0);
    double most = 0.0;
    for (const auto& part : townOn(ground, 60))
        for (const glm::dvec4& now :
             {sun(77.0, 41.0), sun(77.0, 39.0), sun(78.0, 40.0), sun(76.0, 40.0), sun(78.0, 41.0), sun(78.0, 39.0)}) {
            const double bound = boundOf(ground, part, then, now), moved = farthestMove(ground, part, then, now);
            EXPECT_LE(moved, bound);
            most = std::max(most, moved / bound);
        }
    EXPECT_GT(most, 0.9) << "else the bound is of no use";
}

/// On a plane that falls away from the sun by 0.4 a tip at height 40 under a sun with 1.5 m of shadow a metre falls on ground
/// 40 / (1 - 0.6) = 100 m lower. A turn across that way moves it as on level ground, one along it by 1 / (1 - 0.6) of that.
TEST(ShadowMotions, OnASlopeHaveABoundForEachWayThatTheSunMayTurn) {
    const auto slope = [](double x, double) { return -0.4 * x; };
    const HeightPyramid ground = groundOf(slope, posts);
    const auto tower = test::boxAt({400.0, 700.0}, {0.05, 0.05}, 0.0, -165.0, -120.0).parts()[0];
    const glm::dvec4 then(-1.5, 0.0, 1.0, 0.0);
    const double turned = 1e-4;
    EXPECT_NEAR(boundOf(ground, tower, then, {-1.5, turned, 1.0, 0.0}), 100.0 * turned, 0.02 * 100.0 * turned);
    EXPECT_NEAR(boundOf(ground, tower, then, {-1.5 + turned, 0.0, 1.0, 0.0}), 250.0 * turned, 0.02 * 250.0 * turned);
}

/// A cell half of which is level, the other half steeper than light that comes over its edge: of a hut 5 m high on the level
/// half, far from the edge and 10 m from it.
TEST(ShadowMotions, HaveABoundByThoseTrianglesOfACellThatTheyAreNear) {
    struct Case {
        CellCut cut;
        std::vector<float> heights;
        glm::dvec2 towards, far, near; ///< of the light; places of huts.
    };
    const Case cases[] = {{CellCut::rising, {0, 0, -1000, 0}, {1, -1}, {150, 50}, {105, 95}},
                          {CellCut::rising, {0, -1000, 0, 0}, {-1, 1}, {50, 150}, {95, 105}},
                          {CellCut::falling, {-1000, 0, 0, 0}, {1, 1}, {150, 150}, {105, 105}},
                          {CellCut::falling, {0, 0, 0, -1000}, {-1, -1}, {50, 50}, {95, 95}}};
    for (const Case& one : cases) {
        const HeightPyramid ground({2, 2, {0.0, 0.0}, {200.0, 200.0}, one.heights, 0.0, {one.cut}});
        const glm::dvec4 then(one.towards, 1.0, 0.0), now(one.towards * 1.001, 1.0, 0.0);
        const auto bound = [&](const glm::dvec2& place) {
            return boundOf(ground, test::boxAt(place, {1.0, 1.0}, 0.0, -1.0, 5.0).parts()[0], then, now);
        };
        EXPECT_NEAR(bound(one.far), 5.0 * 0.001 * std::sqrt(2.0), 1e-5);
        EXPECT_GT(bound(one.near), 1e9);
    }
}

/// On a slope of 1 in 10 that falls away from a low sun a tower's shadow moves much; a turn that would take it out of where
/// the ground was looked at has no bound.
TEST(ShadowMotions, HaveNoBoundBeyondTheGroundThatIsKnown) {
    const auto slope = [](double x, double) { return 200.0 - 0.1 * x; };
    const HeightPyramid ground = groundOf(slope, posts);
    const double x = 400.0, base = slope(x, 0.0);
    const PackedParts packed(test::boxAt({x, 700.0}, {4.0, 4.0}, 0.0, base - 5.0, base + 30.0).parts());
    const auto sunOf = [](double shift) {
        return glm::dvec4(-shift, 0.0, 1.0, 0.0);
    }; // metres in plan a metre of height
    const PackedShadows shadows = found(ground, packed, sunOf(7.0));
    const auto tip = [&](double shift) { return x + 30.0 * shift / (1.0 - 0.1 * shift); };
    for (const double turned : {0.0009, 0.009}) {
        const double bound = movedAtMost(shadows, sunOf(7.0), sunOf(7.0 - turned));
        EXPECT_GE(bound, tip(7.0) - tip(7.0 - turned));
        EXPECT_LT(bound, 30.0);
    }
    EXPECT_GT(movedAtMost(shadows, sunOf(7.0), sunOf(6.91)), 1e9);
}

/// On a slope that is steeper than the sun and faces it, a shadow of some 80 cells moves by less than on level ground.
TEST(ShadowMotions, HaveABoundOnASteepSlopeThatFacesTheSun) {
    const auto slope = [](double x, double) { return 0.8 * x; };
    const HeightPyramid ground = groundOf(slope, posts);
    const double x = 400.0, base = slope(x, 0.0), height = 100.0;
    const auto tower = test::boxAt({x, 700.0}, {4.0, 4.0}, 0.0, base - 5.0, base + height).parts()[0];
    const auto sunOf = [](double shift) { return glm::dvec4(-shift, 0.0, 1.0, 0.0); };
    const auto tip = [&](double shift) { return x + height * shift / (1.0 + 0.8 * shift); };
    for (const double turned : {0.0009, 0.009}) {
        const double bound = boundOf(ground, tower, sunOf(1.5), sunOf(1.5 + turned));
        EXPECT_GE(bound, tip(1.5 + turned) - tip(1.5));
        EXPECT_LT(bound, 2.0 * height * turned) << "twice what it moves by on level ground";
    }
}

/// Along furrows, level under the light's way, whose sides rise by 0.6: a tip moves along the bottom of one, or its ridge.
TEST(ShadowMotions, HaveABoundAlongFurrowsWhoseSidesAreAsSteepAsTheLight) {
    const auto furrows = [](double x, double y) { return std::lround((x + y) / pitch) % 2 ? 6.0 : 0.0; };
    const HeightPyramid ground = groundOf(furrows, posts); // rising cells: their diagonals run along (1, 1)
    const auto tower = test::boxAt({400.0, 700.0}, {2.0, 2.0}, 0.0, -5.0, 50.0).parts()[0];
    const auto sunOf = [](double shift) { return glm::dvec4(-shift, -shift, 1.0, 0.0); };
    const double turned = 0.001, most = 50.0 * std::sqrt(2.0) * turned; // from the roof to the bottom
    const double bound = boundOf(ground, tower, sunOf(0.95), sunOf(0.95 + turned));
    EXPECT_GE(bound, 44.0 / 50.0 * most) << "on a ridge";
    EXPECT_LT(bound, 3.0 * most);
}

/// A plate that the sun is in, and a tower whose shadow falls beside the ground, among houses that move little.
TEST(ShadowMotions, HaveNoBoundWhereOneMayAppear) {
    const HeightPyramid ground = groundOf([](double, double) { return 0.0; }, posts);
    const glm::dvec4 then(-1.0, 0.0, 1.0, 0.0), now(-1.0, 0.001, 1.0, 0.0);
    const auto house = test::boxAt({400.0, 700.0}, {4.0, 4.0}, 0.0, -5.0, 5.0).parts()[0];
    const auto tower = test::boxAt({1588.0, 700.0}, {1.0, 1.0}, 0.0, 4.0, 40.0).parts()[0];
    const std::vector<glm::vec3> wall = {{500, 700, -1}, {510, 700, -1}, {510, 700, 9}, {500, 700, 9}};
    const std::vector<unsigned> corners = {0, 1, 2, 0, 2, 3};
    const auto plate = gnomon::convexParts(wall.data(), wall.size(), corners.data(), corners.size());
    ASSERT_EQ(plate.size(), 1u);
    ASSERT_LT(movedAtMost(found(ground, PackedParts({house}), then), then, now), 0.1);
    for (const auto& [part, outcome] : {std::pair(plate[0], TerrainOutcome::edgeOn), {tower, TerrainOutcome::noGround}})
        for (const auto& parts : {std::vector{part}, {house, part}}) {
            const PackedShadows shadows = found(ground, PackedParts(parts), then);
            ASSERT_EQ(shadows.outcomes.back(), outcome);
            EXPECT_GT(movedAtMost(shadows, then, now), 1e9);
        }
}

/// The tallest does not count with the steepest slope, which is elsewhere. All together may be told to move by more.
TEST(ShadowMotions, MoveByNoMoreAmongOthersThanAlone) {
    const HeightPyramid ground = groundOf(hills, posts);
    const auto parts = townOn(ground, 60);
    const glm::dvec4 then = sun(77.0, 30.0), now = sun(77.1, 30.05);
    const PackedShadows shadows = found(ground, PackedParts(parts), then);
    const std::vector<double> among = boundsOf(ground, parts, then, now);
    double most = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double alone = boundOf(ground, parts[i], then, now);
        EXPECT_LE(among[i], alone * 1.001) << i;
        most = std::max(most, alone);
    }
    ASSERT_GT(most, 0.0);
    EXPECT_GE(movedAtMost(shadows, then, now), most);
    EXPECT_LT(movedAtMost(shadows, then, now), 10.0);
}

/// A level deck of 1,600 m a side with a hole, 200 m a side, in its middle.
HeightPyramid holedDeck() {
    std::vector<CellCut> cuts;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) cuts.push_back(x / 2 * 2 == 8 && y / 2 * 2 == 8 ? CellCut::hole : CellCut::rising);
    return HeightPyramid({17, 17, {0.0, 0.0}, {100.0, 100.0}, std::vector<float>(17 * 17, 0.0f), 0.0, cuts});
}

/// The same as a mesh, 200 m over a floor.
gnomon::TriangleGround deckOverFloor() {
    std::vector<gnomon::GroundTriangle> triangles = test::trianglesOf(holedDeck().field());
    const HeightPyramid floor({2, 2, {0.0, 0.0}, {1600.0, 1600.0}, std::vector<float>(4, -200.0f)});
    for (const gnomon::GroundTriangle& t : test::trianglesOf(floor.field())) triangles.push_back(t);
    return test::LooseTriangles(triangles).ground();
}

/// A tip 40 m over the deck. Its shadow goes 4 m when the light's way goes from 1.2 to 1.3, or, at the hole, from the deck to the
/// floor: 264 m.
TEST(ShadowMotions, HaveNoBoundWhereOneMayFallThroughAHole) {
    const auto towerAt = [](double x, double y) { return test::boxAt({x, y}, {1.0, 1.0}, 0.0, -1.0, 40.0).parts()[0]; };
    const auto inside = towerAt(300.0, 300.0), atEnd = towerAt(1550.0, 1540.0), atHole = towerAt(750.0, 850.0);
    const glm::dvec4 then(-1.2, 0.0, 1.0, 0.0), now(-1.3, 0.0, 1.0, 0.0);
    const auto mesh = deckOverFloor();
    const glm::dvec3 tip(750.0, 850.0, 40.0);
    ASSERT_NEAR(mesh.hit(tip, -glm::dvec3(now))->x - mesh.hit(tip, -glm::dvec3(then))->x, 264.0, 1e-6);
    const HeightPyramid grid = holedDeck();
    for (const Ground* ground : {static_cast<const Ground*>(&mesh), static_cast<const Ground*>(&grid)}) {
        const std::vector<double> bounds = boundsOf(*ground, {inside, atEnd, atHole}, then, now);
        EXPECT_NEAR(bounds[0], 4.0, 1e-3);
        EXPECT_NEAR(bounds[1], 4.0, 1e-3) << "beyond the ground's end there is nothing to fall on";
        EXPECT_GT(bounds[2], 1e9);
        const glm::dvec4 soon(-1.201, 0.0, 1.0, 0.0);
        const PackedShadows both = found(*ground, PackedParts({inside, atHole}), then);
        EXPECT_GT(movedAtMost(both, then, soon), 1e9) << "all together";
        EXPECT_LT(both.steepest, 1e-9) << "a hole is no slope, and a grid rounds level up";
        for (const auto& alone : {inside, atEnd}) // in any direction
            EXPECT_NEAR(movedAtMost(found(*ground, PackedParts({alone}), then), then, soon), 0.04, 1e-6);
    }
}

/// From a foot of 2 by 2 m in the ground, so far before the hole's middle, to a tip 10 m up and 45 m along `way`.
gnomon::ConvexPart boomTowardsHole(const glm::dvec2& way, double from) {
    const glm::dvec2 foot = glm::dvec2(900.0) - from * way;
    std::vector<glm::dvec3> corners;
    for (const auto& [middle, half, low, high] :
         {std::tuple(foot, 1.0, -1.0, 1.0), {foot + 44.5 * way, 0.5, 9.0, 10.0}})
        for (int k = 0; k < 8; ++k)
            corners.emplace_back(middle + glm::dvec2(k & 1 ? half : -half, k & 2 ? half : -half), k & 4 ? high : low);
    return {*gnomon::convexHull(corners), std::nullopt};
}

/// Whichever way it leans: its shadow lies 12 m back from its tip, before the hole; its rays pass over it.
TEST(ShadowMotions, OfABoomOverAHoleHaveNoBound) {
    const HeightPyramid grid = holedDeck();
    const gnomon::TriangleGround mesh = test::LooseTriangles(test::trianglesOf(grid.field())).ground();
    for (const Ground* ground : {static_cast<const Ground*>(&mesh), static_cast<const Ground*>(&grid)})
        for (const glm::dvec2& way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
            const glm::dvec4 then(1.2 * way, 1.0, 0.0), now(1.201 * way, 1.0, 0.0);
            const gnomon::ConvexPart over = boomTowardsHole(way, 140.0), before = boomTowardsHole(way, 320.0);
            EXPECT_GT(movedAtMost(found(*ground, PackedParts({over}), then), then, now), 1e9) << way.x << ' ' << way.y;
            EXPECT_GT(boundOf(*ground, over, then, now), 1e9) << way.x << ' ' << way.y;
            EXPECT_NEAR(boundOf(*ground, before, then, now), 0.01, 1e-6) << "a tip 10 m up";
        }
}

/// A boom of 45 m was there; what is left is a post in its foot's place, far from the hole.
TEST(ShadowMotions, OfWhatIsLeftDoNotReachAsFarAsWhatIsGone) {
    const HeightPyramid grid = holedDeck();
    const glm::dvec4 then(1.2, 0.0, 1.0, 0.0), now(1.201, 0.0, 1.0, 0.0);
    const auto post = test::boxAt({760.0, 900.0}, {1.0, 1.0}, 0.0, -1.0, 10.0).parts()[0];
    PackedParts parts({boomTowardsHole({1.0, 0.0}, 140.0), post});
    EXPECT_GT(movedAtMost(found(grid, parts, then), then, now), 1e9);
    parts.remove(0);
    EXPECT_EQ(movedAtMost(found(grid, parts, then), then, now),
              movedAtMost(found(grid, PackedParts({post}), then), then, now));
    EXPECT_LT(movedAtMost(found(grid, parts, then), then, now), 0.02);
}

/// By what is under each, as on a grid: what stands on a level part of a mesh is not moved by its cliff.
TEST(ShadowMotions, OnAMeshHaveABoundByWhatIsUnderEach) {
    const auto steps = [](double x, double) { return x < 800.0 ? 0.0 : 60.0; };
    const gnomon::TriangleGround ground =
        test::LooseTriangles(test::trianglesOf(groundOf(steps, posts).field())).ground();
    const auto low = test::boxAt({400.0, 700.0}, {1.0, 1.0}, 0.0, -1.0, 40.0).parts()[0];
    const auto high = test::boxAt({790.0, 700.0}, {1.0, 1.0}, 0.0, -1.0, 40.0).parts()[0];
    const glm::dvec4 then(-1.2, 0.0, 1.0, 0.0), now(-1.3, 0.0, 1.0, 0.0);
    const std::vector<double> bounds = boundsOf(ground, {low, high}, then, now);
    EXPECT_NEAR(bounds[0], 4.0, 1e-3);
    EXPECT_GT(bounds[1], 1e9) << "it comes near the cliff, and a mesh does not tell which way that faces";
}

} // namespace
