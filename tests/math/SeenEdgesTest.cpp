// SPDX-License-Identifier: MIT
#include <support/Soup.h>

#include <gnomon/mapfit/MapFit.h>
#include <gnomon/mapfit/SeenEdges.h>
#include <metrics/BoundaryDistance.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

using namespace gnomon;

namespace {

const glm::dmat4 here(1.0);
const glm::dvec3 north(0.0, 1.0, 0.0);
const PlacedBox ground{{-5, -5, 0}, {5, 5, 0}}, house{{-0.5, -0.5, 0}, {0.5, 0.5, 1}};
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
                               const std::vector<PlacedBox>& receivers) {
    SeenEdges seen(view, pixels, wholeScreen, light);
    for (const PlacedBox& box : receivers) seen.addReceiver(box), seen.addCaster(box);
    seen.addMap(map);
    return seen.edges();
}

double widthOf(const EdgeWidths::Edge& edge) { return edge.width; }

double usual(const std::vector<SeenPlace>& places, const glm::dmat4& view, const glm::dmat4& map, double share = 0.95) {
    EdgeWidths widths(view, pixels);
    for (const SeenPlace& place : places) widths.add(place, map);
    return widths.usual(share, widthOf);
}

const SeenPlace onGround{{1, 2, 0}, {0, 0, 1}, {}};

/// Objects as one mesh.
struct Objects : test::Soup {
    void beginObject() { parts.push_back(size()); }
    PlacedTriangles placed() const { return {vertices.data(), vertices.size(), indices.data(), size(), here, parts}; }
    std::vector<std::size_t> parts;
};

Objects onAGround(const std::function<void(Objects&)>& add) {
    Objects objects;
    objects.beginObject();
    objects.quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
    objects.beginObject();
    add(objects);
    return objects;
}

std::vector<SeenPlace> edgesOf(const glm::dvec4& light, const glm::dmat4& view, const glm::dmat4& map,
                               const Objects& objects) {
    SeenEdges seen(view, pixels, wholeScreen, light);
    seen.addMesh(objects.placed());
    seen.addMap(map);
    return seen.edges();
}

/// A sun at 45 degrees to the east, and a map that looks along its way: x - z.
const glm::dvec4 sunInTheEast(glm::normalize(glm::dvec3(1, 0, 1)), 0.0);
const glm::dmat4 mapFromTheEast = mapFromAbove * glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1);

/// A lamp two above the middle, and a map of x/w and y/w within 5.
const glm::dvec4 lamp(0, 0, 2, 1);
glm::dmat4 mapOfLamp() {
    const glm::dmat4 toMap(0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 1, 0, 0.5, 0.5, 0, 1);
    return toMap * lampFrame(glm::dvec3(lamp), {0, 0, -1}, 1.0).lightFromScene;
}

} // namespace

// The shadow of a unit cube under a sun at 45 degrees: the cube's own square, which the cube hides, and the next one.
TEST(SeenEdges, LieAlongTheShadowOfABoxOrOfItsTrianglesUnderASun) {
    const Objects objects = onAGround([](Objects& all) { all.box(house.low, house.high); });
    for (const std::vector<SeenPlace>& edges : {edgesOf(sunInTheEast, plan(), mapFromTheEast, {ground, house}),
                                                edgesOf(sunInTheEast, plan(), mapFromTheEast, objects)}) {
        ASSERT_GT(edges.size(), 20u);
        for (const SeenPlace& edge : edges) {
            EXPECT_NEAR(edge.place.z, 0.0, 1e-9) << "a cube shadows nothing of itself";
            EXPECT_LT(offSquare(edge.place, {-1.0, 0.0}, 0.5), 1.5 * cell) << edge.place.x << " " << edge.place.y;
            EXPECT_FALSE(edge.across < 1.0) << "twenty pixels";
            EXPECT_FALSE(edge.folded);
        }
    }
}

TEST(SeenEdges, KnowWhichWayTheyGo) {
    const PlacedBox tower{{-0.5, -1.5, 0}, {0.5, 1.5, 3}};
    int along = 0, across = 0;
    for (const SeenPlace& edge : edgesOf(sunInTheEast, plan(), mapFromTheEast, {ground, tower})) {
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
    const std::vector<SeenPlace> edges = edgesOf(lamp, plan(), mapOfLamp(), {ground, house});
    ASSERT_GT(edges.size(), 20u);
    for (const SeenPlace& edge : edges) EXPECT_LT(offSquare(edge.place, {0.0, 0.0}, 1.0), 1.5 * cell);
}

// Whatever hills a ground has, most of it lies about half-way up.
TEST(SeenEdges, OfHillsLieHalfWayUp) {
    const PlacedBox hills{{-5, -5, -0.5}, {5, 5, 0.5}};
    const std::vector<SeenPlace> edges = edgesOf(sunInTheEast, plan(), mapFromTheEast, {hills, house});
    ASSERT_GT(edges.size(), 20u);
    for (const SeenPlace& edge : edges) EXPECT_NEAR(edge.place.z, 0.0, 1e-9);

    SeenEdges whole(plan(), pixels, wholeScreen, sunInTheEast);
    whole.addReceiver(hills, SeenEdges::Relief::Whole);
    ASSERT_FALSE(whole.facing().empty());
    for (const SeenPlace& place : whole.facing()) EXPECT_NEAR(place.place.z, 0.5, 1e-9);
}

TEST(SeenEdges, AreOnlyWhereTheLightShinesAndTheEyeSees) {
    const glm::dvec4 below(0, 0, -1, 0), noon(0, 0, 1, 0);
    EXPECT_TRUE(edgesOf(below, plan(), mapFromAbove, {ground, house}).empty());
    EXPECT_TRUE(edgesOf(noon, plan(), mapFromAbove, {ground, house}).empty()) << "the house hides its shadow";
    const PlacedBox roof{{-5, -5, 4}, {5, 5, 4}}; // all of its shadow is below it
    EXPECT_TRUE(edgesOf(noon, plan(), mapFromAbove, {ground, house, roof}).empty());
    const PlacedBox plate{{-1, -1, 3}, {1, 1, 3}};
    const glm::dmat4 slanted = glm::perspective(1.0, 1.0, 0.1, 100.0) *
                               glm::lookAt(glm::dvec3(0, -20, 12), glm::dvec3(0.0), glm::dvec3(0, 0, 1));
    for (const SeenPlace& edge : edgesOf(noon, slanted, mapFromAbove, {ground, plate}))
        EXPECT_LT(offSquare(edge.place, {0.0, 0.0}, 1.0), 1.0);
    EXPECT_FALSE(edgesOf(noon, slanted, mapFromAbove, {ground, plate}).empty());
}

// The room's box holds the lamp and the eye. It is seen from inside, and does not darken itself.
TEST(SeenEdges, AreSeenInARoomFromInside) {
    const PlacedBox room{{-3, -3, 0}, {3, 3, 3}}, table{{-0.5, -0.5, 0.9}, {0.5, 0.5, 1.0}};
    const glm::dmat4 view = glm::perspective(1.2, 1.0, 0.1, 100.0) *
                            glm::lookAt(glm::dvec3(-2.8, -2.8, 2.8), glm::dvec3(0.0), glm::dvec3(0, 0, 1));
    const std::vector<SeenPlace> edges = edgesOf(lamp, view, mapOfLamp(), {room, table});
    ASSERT_GT(edges.size(), 20u);
    for (const SeenPlace& edge : edges) {
        EXPECT_NEAR(edge.place.z, 0.0, 1e-9);
        EXPECT_LT(offSquare(edge.place, {0.0, 0.0}, 1.0), 0.4) << "a table at half the lamp's height: twice its side";
    }
}

// A step: the upper part shadows the lower one of the same object, which a box would not.
TEST(SeenEdges, OfTrianglesAreSeenOnAnObjectThatShadowsItself) {
    const Objects objects = onAGround([](Objects& all) {
        all.quad({-3, -2, 1}, {4, 0, 0}, {0, 4, 0}); // the lower level, from x = -3 to 1
        all.quad({1, -2, 1}, {0, 4, 0}, {0, 0, 1});
        all.quad({1, -2, 2}, {2, 0, 0}, {0, 4, 0}); // the upper one
    });
    int onStep = 0;
    for (const SeenPlace& edge : edgesOf(sunInTheEast, plan(), mapFromTheEast, objects))
        if (edge.place.z > 0.5 && std::abs(edge.place.y) < 1.8) {
            EXPECT_NEAR(edge.place.z, 1.0, 1e-6);
            EXPECT_NEAR(edge.place.x, 0.0, 1.1 * cell) << "as far from the riser as that is high";
            ++onStep;
        }
    EXPECT_GT(onStep, 10);
}

/// Four wide and h above the ground, seen through from above, as the bowl of a lamp is whose faces are culled.
std::vector<Contact> contactsUnderAPlate(double h, bool oneSided, const glm::dmat4& map) {
    const Objects objects = onAGround([h](Objects& all) { all.quad({-2, 2, h}, {4, 0, 0}, {0, -4, 0}); });
    PlacedTriangles placed = objects.placed();
    placed.oneSided = {false, oneSided};
    SeenEdges seen(plan(), pixels, wholeScreen, sunInTheEast);
    seen.addMesh(placed);
    seen.addMap(map);
    std::vector<Contact> contacts;
    seen.edges(&contacts);
    return contacts;
}

/// Under a sun at 45 degrees depth changes by a texel a texel, on the ground and on the plate: three quarters of that and a half are
/// allowed, and the plate is its height times the root of two away.
TEST(SeenEdges, ContactsAreUnderWhatNearlyTouchesAndTellTheTexelThatTheyNeed) {
    const glm::dmat4 map = mapFromAbove * sunFrame(glm::dvec3(sunInTheEast)).lightFromScene;
    const double h = 0.1, texel = h * std::sqrt(2.0) / 1.25, pixel = 10.0 / 200.0, mapSide = 20.0;
    const std::vector<Contact> contacts = contactsUnderAPlate(h, true, map);
    const double each = 200.0 * 200.0 / (SeenEdges::columns * SeenEdges::rows), shadow = 4.0 / pixel * 4.0 / pixel;
    EXPECT_NEAR(double(contacts.size()) * each, shadow, 0.15 * shadow) << "all but a rim of two pixels";
    EdgeWidths widths(plan(), pixels);
    for (const Contact& contact : contacts) {
        EXPECT_NEAR(contact.place.z, 0.0, 1e-9);
        EXPECT_GE(offSquare(contact.place, {-h, 0.0}, 2.0), 1.5 * pixel - 1e-9);
        EXPECT_NEAR(contact.texel, texel, 1e-6);
        widths.addContact(contact, each, map);
    }
    EXPECT_NEAR(widths.leak(0.99 * mapSide / texel), std::sqrt(shadow), 0.1 * std::sqrt(shadow));
    EXPECT_EQ(widths.leak(1.01 * mapSide / texel), 0.0);
    EXPECT_TRUE(contactsUnderAPlate(h, false, map).empty()) << "the plate is seen, and it is lit";
    EXPECT_TRUE(contactsUnderAPlate(1.0, true, map).empty()) << "twenty pixels above the ground";
}

// Rods of a fifth of a pixel to three. They are met as seldom as they are narrow, and each has two outlines, as those of eight
// pixels have. Some of them are taken as chance.
TEST(SeenEdges, CountNarrowShadowsByTheirLengthAndTellTheirWidth) {
    const double pixel = 2.0 * 7.9 * std::tan(0.2) / 200.0;
    const glm::dmat4 below = glm::perspective(0.4, 1.0, 1.0, 100.0) * // the rods
                             glm::lookAt(glm::dvec3(0, 0, 7.9), glm::dvec3(0.0), glm::dvec3(0.37, 1.0, 0.0));
    const auto edgesOfRods = [&](double width, bool asBoxes) {
        std::vector<PlacedBox> boxes = {ground};
        for (int i = -9; i <= 9; ++i) boxes.push_back({{-6, 0.2 * i - width / 2.0, 8}, {6, 0.2 * i + width / 2.0, 8}});
        if (asBoxes) return edgesOf({0, 0, 1, 0}, below, mapFromAbove, boxes);
        const Objects objects = onAGround([&](Objects& all) {
            for (std::size_t i = 1; i < boxes.size(); ++i) all.quad(boxes[i].low, {12, 0, 0}, {0, width, 0});
        });
        return edgesOf({0, 0, 1, 0}, below, mapFromAbove, objects);
    };
    for (const bool asBoxes : {false, true}) {
        const auto lengthOf = [&](double width) {
            double all = 0.0;
            for (const SeenPlace& edge : edgesOfRods(width * pixel, asBoxes)) all += edge.share;
            return all;
        };
        const double wide = lengthOf(8.0);
        for (const double width : {0.2, 0.6, 1.2, 3.0}) {
            EXPECT_GT(lengthOf(width), 0.5 * wide) << width;
            EXPECT_LT(lengthOf(width), 1.4 * wide) << width;
            std::vector<double> widths;
            for (const SeenPlace& edge : edgesOfRods(width * pixel, asBoxes)) widths.push_back(edge.across);
            ASSERT_FALSE(widths.empty());
            std::sort(widths.begin(), widths.end());
            EXPECT_GT(widths[widths.size() / 2], 0.5 * width) << width;
            EXPECT_LT(widths[widths.size() / 2], 2.0 * width) << width;
        }
    }
}

// A level and a slope of 60 degrees. A plate above the slope throws its edge on the fold, and two more on either part.
TEST(SeenEdges, KnowWhereASurfaceIsFolded) {
    const Objects objects = onAGround([](Objects& all) {
        all.quad({-3, -3, 0.5}, {6, 0, 0}, {0, 3, 0});
        all.quad({-3, 0, 0.5}, {6, 0, 0}, {0, 1.5, 1.5 * std::sqrt(3.0)});
        all.box({2, 0, 4.5}, {5, 3, 4.6});
        all.box({4, -2, 4.5}, {5, -1, 4.6});
    });
    const glm::dmat4 slanted = glm::ortho(-5.0, 5.0, -5.0, 5.0, 0.0, 100.0) *
                               glm::lookAt(glm::dvec3(0, -20, 20), glm::dvec3(0.0), glm::dvec3(0, 0, 1));
    int folded = 0, flat = 0;
    for (const SeenPlace& edge : edgesOf(sunInTheEast, slanted, mapFromTheEast, objects)) {
        EXPECT_TRUE(!edge.folded || std::abs(edge.place.y) < 2.0 * cell) << edge.place.y;
        (edge.folded ? folded : flat) += 1;
    }
    EXPECT_GT(folded, 10);
    EXPECT_GT(flat, 10);
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
    EXPECT_NEAR(widths.usual(0.95, widthOf), 720.0 / 0.95, 1e-6);
    EXPECT_NEAR(widths.usual(0.5, widthOf), 800.0 / 3.0 / 0.5, 1e-6);
}

TEST(EdgeWidths, AreNotOfWhatIsBehindTheEye) {
    const glm::dmat4 view = glm::perspective(1.0, 1.0, 0.1, 100.0) *
                            glm::lookAt(glm::dvec3(0, 0, 5), glm::dvec3(0, 0, 10), glm::dvec3(0, 1, 0));
    EdgeWidths widths(view, pixels);
    widths.add(onGround, mapFromAbove);
    EXPECT_TRUE(widths.empty());
}

// So that a budget of just that is kept.
TEST(EdgeWidths, AreNotRoundedBeyondWhatAllHave) {
    EdgeWidths widths(plan(), pixels);
    for (int i = 1; i < 200; ++i) {
        SeenPlace place{{1, 2, 0}, {0, 0, 1}, {1, 0}};
        place.share = 0.1 * i;
        widths.add(place, mapFromAbove * glm::scale(here, {1.0, 1.0 / i, 1.0}));
        for (const double off : {0.1, 0.4, 0.7}) {
            const double usual = widths.usual(0.95, [&](const auto&) { return off; });
            EXPECT_LE(usual, off) << i;
            EXPECT_NEAR(usual, off, 1e-12);
        }
    }
}

// A map from above has a pixel's height on a ground 1.7 below the eye as many times as long as on what faces the eye as the place
// is farther away than that: map.frag shortens what is more than four times as long.
TEST(EdgeWidths, TellWherePixelsAreLong) {
    const glm::dmat4 view = glm::perspective(1.0, 1.0, 0.1, 100.0) *
                            glm::lookAt(glm::dvec3(0, -10, 1.7), glm::dvec3(0, 0, 1.7), glm::dvec3(0, 0, 1));
    for (const double away : {4.0, 6.0, 8.0, 12.0}) {
        EdgeWidths widths(view, pixels);
        widths.add({{0.5, away - 10.0, 0}, {0, 0, 1}, {1, 0}}, mapFromAbove);
        const double slanted = widths.usual(0.95, [](const auto& edge) { return edge.slanted ? 1.0 : 2.0; });
        EXPECT_DOUBLE_EQ(slanted, away > 4.0 * 1.7 ? 1.0 : 2.0) << away;
    }
}

TEST(EdgeErrors, AreThePixelsWhereTexelsAreSmallAndTheTexelsWhereTheyAreLarge) {
    const EdgeFilter filter{0.5, 0.4, 1.0, false};
    EXPECT_DOUBLE_EQ(mapError(filter, 0.0), 0.4);
    EXPECT_NEAR(mapError(filter, 100.0), 50.0, 0.01);
    EXPECT_DOUBLE_EQ(polygonError(0.0), sampledEdge);
}

// A lath of two pixels: a map whose texels are wider loses it or draws blobs as wide as its texels.
TEST(EdgeErrors, OfMapsCountWhatIsNarrowerThanATexelAsLost) {
    const EdgeFilter hard{0.5, 0.4, 1.0, false}, mean{0.15, 0.075, 16.0, true};
    EdgeWidths::Edge lath;
    lath.width = 1024.0; // pixels
    lath.across = 2.0;
    for (const EdgeFilter& filter : {hard, mean}) {
        EXPECT_LT(mapError(lath, filter, 1024.0), 1.0) << "texels of a pixel";
        EXPECT_GE(mapError(lath, filter, 400.0), 2.0) << "texels of 2.6 pixels";
        EXPECT_GE(mapError(lath, filter, 128.0), 4.0) << "texels of 8 pixels";
    }
    EXPECT_LE(sampledError(lath), 0.5);
}

// What no pixel's middle need meet is lost here and there: no map is better, unless it averages finer texels.
TEST(EdgeErrors, OfOnePlaceAPixelAreNoWorseThanThoseOfMapsThatLoseAsMuch) {
    EdgeWidths::Edge wire;
    wire.width = 1024.0;
    for (const double across : {0.1, 0.3, 0.7, 0.95, 1.5, 6.0, 100.0}) {
        wire.across = across;
        EXPECT_LE(sampledError(wire), 1.0) << across;
        for (const double texels : {128.0, 1024.0, 8192.0})
            EXPECT_GE(mapError(wire, {0.5, 0.42, 0.25, false}, texels), sampledError(wire)) << across << " " << texels;
        EXPECT_LT(mapError(wire, {0.15, 0.075, 16.0, true}, 32768.0), 0.1) << across;
    }
}

// Stripes that rise so, each with another place in its pixels, as one place a pixel decides, and as their area does.
TEST(EdgeErrors, OfOnePlaceAPixelAreThatOfStripesThatRiseSo) {
    constexpr int width = 48, height = 800, places = 15; // pixels; places each way of which the area is counted
    constexpr double pitch = 10.0 + 0.618;
    for (const double rise : {0.0, 0.05, 0.125, 0.25, 0.4, 0.5, 0.7, 0.9, 1.0}) {
        const auto isLit = [&](double x, double y) { return std::fmod(y + 100.0 - rise * x, 2.0 * pitch) < pitch; };
        gnomon::metrics::Picture drawn(width, height), truth(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                drawn.at(x, y) = isLit(x + 0.5, y + 0.5) ? 1.0 : 0.0;
                for (int i = 0; i < places * places; ++i)
                    truth.at(x, y) += isLit(x + (i % places + 0.5) / places, y + (i / places + 0.5) / places);
                truth.at(x, y) /= places * places;
            }
        const double off =
            gnomon::metrics::boundaryDistance(drawn, truth, gnomon::metrics::Mask(width, height, 1)).value().p95;
        std::cout << rise << ": " << off << ", " << gnomon::sampledEdgeOf(rise) << " are expected\n";
        EXPECT_NEAR(gnomon::sampledEdgeOf(rise), off, 0.04) << rise; // 15 places tell a level edge to a 15th
    }
}
