// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/EdgeWidths.h>
#include <gnomon/mapfit/MapFit.h>
#include <gnomon/mapfit/SeenEdges.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gnomon;

namespace {

const glm::dmat4 here(1.0);
const glm::dvec3 north(0.0, 1.0, 0.0);
const SeenEdges::Box ground{{-5, -5, 0}, {5, 5, 0}}, house{{-0.5, -0.5, 0}, {0.5, 0.5, 1}};
const glm::dvec2 pixels(200.0);

/// From above, ten wide.
glm::dmat4 plan() {
    return glm::ortho(-5.0, 5.0, -5.0, 5.0, 0.0, 100.0) * glm::lookAt(glm::dvec3(0, 0, 50), glm::dvec3(0.0), north);
}
/// The widest cell of the grid in plan().
constexpr double cell = 10.0 / 48.0;

/// 20 wide about the origin, as the sun at noon sees it.
const glm::dmat4 mapFromAbove = glm::translate(here, {0.5, 0.5, 0.0}) * glm::scale(here, {0.05, 0.05, 1.0});

/// Distance of a place of the ground from the outline of a square about the middle.
double offSquare(const glm::dvec3& place, const glm::dvec2& middle, double half) {
    const glm::dvec2 beyond = glm::abs(glm::dvec2(place) - middle) - half;
    return beyond.x > 0.0 && beyond.y > 0.0 ? glm::length(beyond) : std::abs(std::max(beyond.x, beyond.y));
}

std::vector<SeenPlace> edgesOf(const glm::dvec4& light, const glm::dmat4& view, const glm::dmat4& map,
                               const std::vector<SeenEdges::Box>& receivers) {
    SeenEdges seen(view, wholeScreen, light);
    for (const SeenEdges::Box& box : receivers) seen.addReceiver(box, here);
    seen.addCasters(receivers, map);
    return seen.edges();
}

double usual(const std::vector<SeenPlace>& places, const glm::dmat4& view, const glm::dmat4& map, double share = 0.95) {
    EdgeWidths widths(view, pixels);
    for (const SeenPlace& place : places) widths.add(place, map);
    return widths.usual(share);
}

const SeenPlace onGround{{1, 2, 0}, {0, 0, 1}, {}};

} // namespace

// The shadow of a unit cube under a sun at 45 degrees: the cube's own square, which the cube hides, and the next one.
TEST(SeenEdges, LieAlongTheShadowOfABoxUnderASun) {
    const glm::dvec4 sun(glm::normalize(glm::dvec3(1, 0, 1)), 0.0);
    const glm::dmat4 map = mapFromAbove * glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1); // x - z
    const std::vector<SeenPlace> edges = edgesOf(sun, plan(), map, {ground, house});
    ASSERT_GT(edges.size(), 20u);
    for (const SeenPlace& edge : edges) {
        EXPECT_NEAR(edge.place.z, 0.0, 1e-9) << "a cube shadows nothing of itself";
        EXPECT_LT(offSquare(edge.place, {-1.0, 0.0}, 0.5), 1.5 * cell) << edge.place.x << " " << edge.place.y;
    }
}

TEST(SeenEdges, KnowWhichWayTheyGo) {
    const glm::dmat4 map = mapFromAbove * glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1); // x - z
    const SeenEdges::Box tower{{-0.5, -1.5, 0}, {0.5, 1.5, 3}};
    const glm::dvec4 sun(glm::normalize(glm::dvec3(1, 0, 1)), 0.0);
    int along = 0, across = 0;
    for (const SeenPlace& edge : edgesOf(sun, plan(), map, {ground, tower})) {
        const bool inMiddle = std::abs(edge.place.y) < 1.0;              // of the side that the roof's edge throws
        const bool onFlank = edge.place.x > -2.8 && edge.place.x < -1.0; // where the shadow follows the sun's way
        across += inMiddle && edge.edge.x == 0.0 && edge.edge.y != 0.0 ? 1 : 0;
        along += onFlank && edge.edge.y == 0.0 ? 1 : 0;
        EXPECT_FALSE(inMiddle && edge.edge.x != 0.0);
        EXPECT_FALSE(onFlank && edge.edge.y != 0.0);
    }
    EXPECT_GT(along, 10);
    EXPECT_GT(across, 5);
}

TEST(SeenEdges, LieAlongTheShadowOfABoxUnderALamp) {
    const glm::dvec4 lamp(0, 0, 2, 1);
    const LightFrame frame = lampFrame(glm::dvec3(lamp), {0, 0, -1}, 1.0);
    const glm::dmat4 toMap(0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 1, 0, 0.5, 0.5, 0, 1); // of x/w and y/w within 5
    const std::vector<SeenPlace> edges = edgesOf(lamp, plan(), toMap * frame.lightFromScene, {ground, house});
    ASSERT_GT(edges.size(), 20u);
    for (const SeenPlace& edge : edges) EXPECT_LT(offSquare(edge.place, {0.0, 0.0}, 1.0), 1.5 * cell);
}

// Whatever hills a ground has, most of it lies about half-way up.
TEST(SeenEdges, OfHillsLieHalfWayUp) {
    const glm::dvec4 sun(glm::normalize(glm::dvec3(1, 0, 1)), 0.0);
    const glm::dmat4 map = mapFromAbove * glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1); // x - z
    const SeenEdges::Box hills{{-5, -5, -0.5}, {5, 5, 0.5}};
    const std::vector<SeenPlace> edges = edgesOf(sun, plan(), map, {hills, house});
    ASSERT_GT(edges.size(), 20u);
    for (const SeenPlace& edge : edges) EXPECT_NEAR(edge.place.z, 0.0, 1e-9);
}

TEST(SeenEdges, AreOnlyWhereTheLightShinesAndTheEyeSees) {
    const glm::dvec4 below(0, 0, -1, 0), noon(0, 0, 1, 0);
    EXPECT_TRUE(edgesOf(below, plan(), mapFromAbove, {ground, house}).empty());
    EXPECT_TRUE(edgesOf(noon, plan(), mapFromAbove, {ground, house}).empty()) << "the house hides its shadow";
    const SeenEdges::Box roof{{-5, -5, 4}, {5, 5, 4}}; // all of its shadow is below it
    EXPECT_TRUE(edgesOf(noon, plan(), mapFromAbove, {ground, house, roof}).empty());
    const SeenEdges::Box plate{{-1, -1, 3}, {1, 1, 3}};
    const glm::dmat4 slanted = glm::perspective(1.0, 1.0, 0.1, 100.0) *
                               glm::lookAt(glm::dvec3(0, -20, 12), glm::dvec3(0.0), glm::dvec3(0, 0, 1));
    for (const SeenPlace& edge : edgesOf(noon, slanted, mapFromAbove, {ground, plate}))
        EXPECT_LT(offSquare(edge.place, {0.0, 0.0}, 1.0), 1.0);
    EXPECT_FALSE(edgesOf(noon, slanted, mapFromAbove, {ground, plate}).empty());
}

// The room's box holds the lamp and the eye. It is seen from inside, and does not darken itself.
TEST(SeenEdges, AreSeenInARoomFromInside) {
    const SeenEdges::Box room{{-3, -3, 0}, {3, 3, 3}}, table{{-0.5, -0.5, 0.9}, {0.5, 0.5, 1.0}};
    const glm::dvec4 lamp(0, 0, 2, 1);
    const LightFrame frame = lampFrame(glm::dvec3(lamp), {0, 0, -1}, 1.0);
    const glm::dmat4 toMap(0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 1, 0, 0.5, 0.5, 0, 1);
    const glm::dmat4 view = glm::perspective(1.2, 1.0, 0.1, 100.0) *
                            glm::lookAt(glm::dvec3(-2.8, -2.8, 2.8), glm::dvec3(0.0), glm::dvec3(0, 0, 1));
    const std::vector<SeenPlace> edges = edgesOf(lamp, view, toMap * frame.lightFromScene, {room, table});
    ASSERT_GT(edges.size(), 20u);
    for (const SeenPlace& edge : edges) {
        EXPECT_NEAR(edge.place.z, 0.0, 1e-9);
        EXPECT_LT(offSquare(edge.place, {0.0, 0.0}, 1.0), 0.4) << "a table at half the lamp's height: twice its side";
    }
}

// A pixel is a 20th wide, the map 20: each of its sides is 400 pixels.
TEST(EdgeWidths, AreAMapsSideInPixelsWhereLightAndEyeAreAbove) {
    for (const double share : {0.5, 0.95, 1.0})
        EXPECT_NEAR(usual({onGround}, plan(), mapFromAbove, share), 400.0, 1e-6);
}

// Under a sun at 30 degrees an edge across its way is moved twice as far, an edge along it not more.
TEST(EdgeWidths, AreStretchedAlongTheWayOfTheLightOnly) {
    const glm::dmat4 slanted = mapFromAbove * glm::scale(here, {0.5, 1.0, 1.0});
    EXPECT_NEAR(usual({{{1, 2, 0}, {0, 0, 1}, {1, 0}}}, plan(), slanted), 400.0, 1e-6);
    EXPECT_NEAR(usual({{{1, 2, 0}, {0, 0, 1}, {0, 1}}}, plan(), slanted), 800.0, 1e-6);
    double low = 0.0, high = 1000.0; // what 95 % of edges in all directions are off by, by bisection
    for (int round = 0; round < 60; ++round) {
        const double tried = (low + high) / 2.0;
        double within = 0.0;
        constexpr int directions = 3600;
        for (int i = 0; i < directions; ++i) {
            const double angle = std::acos(-1.0) * i / directions;
            const double width = 400.0 * std::hypot(2.0 * std::sin(angle), std::cos(angle));
            within += std::min(tried / width, 1.0) / directions;
        }
        (within < 0.95 ? low : high) = tried;
    }
    EXPECT_NEAR(usual({onGround}, plan(), slanted), low / 0.95, 0.02 * low) << "six directions stand for all";
}

// Half of the edges are 400 pixels wide, half 800: x/2/400 + x/2/800 = 0.95 beyond 400 gives x = 720.
TEST(EdgeWidths, AreThoseOfTheWidestWhereTheseAreMany) {
    EdgeWidths widths(plan(), pixels);
    widths.add(onGround, mapFromAbove);
    widths.add(onGround, glm::translate(here, {0.25, 0.25, 0.0}) * glm::scale(here, {0.5, 0.5, 1.0}) * mapFromAbove);
    EXPECT_NEAR(widths.usual(0.95), 720.0 / 0.95, 1e-6);
    EXPECT_NEAR(widths.usual(0.5), 800.0 / 3.0 / 0.5, 1e-6);
}

TEST(EdgeWidths, AreNotOfWhatIsBehindTheEye) {
    const glm::dmat4 view = glm::perspective(1.0, 1.0, 0.1, 100.0) *
                            glm::lookAt(glm::dvec3(0, 0, 5), glm::dvec3(0, 0, 10), glm::dvec3(0, 1, 0));
    EdgeWidths widths(view, pixels);
    widths.add(onGround, mapFromAbove);
    EXPECT_TRUE(widths.empty());
}
