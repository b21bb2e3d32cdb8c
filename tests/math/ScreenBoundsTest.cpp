// SPDX-License-Identifier: MIT
// Pixels that a quadrangle covers of a screen, against closed forms.
#include "Compare.h"

#include <gnomon/PlanarShadow.h>
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using gnomon::ScreenRect;
using gnomon::test::infinite;
using gnomon::test::near;
using gnomon::test::notANumber;
using gnomon::test::Random;

namespace {

constexpr double ulps = 1e-15; // a few roundings of numbers near 1
using Points = std::vector<dvec3>;
using HalfSpaces = std::vector<dvec4>;

bool contains(const Points& points, const dvec3& point, double tolerance) {
    for (const dvec3& candidate : points)
        if (near(candidate, point, tolerance)) return true;
    return false;
}

bool keeps(const HalfSpaces& halfSpaces, const dvec3& point) {
    for (const dvec4& halfSpace : halfSpaces)
        if (!(glm::dot(halfSpace, dvec4(point, 1.0)) >= 0.0)) return false;
    return true;
}

HalfSpaces randomHalfSpaces(Random& random, int count) {
    HalfSpaces halfSpaces;
    for (int i = 0; i < count; ++i) {
        const dvec3 normal = random.direction();
        halfSpaces.push_back(random.between(0.1, 10.0) * dvec4(normal, -glm::dot(normal, random.inCube(0.7))));
    }
    return halfSpaces;
}

/// A point of the box [-1, 1]³, one in six times on each of its sides: faces, edges and corners are met too.
dvec3 inOrOnBox(Random& random) { return glm::clamp(random.inCube(1.5), dvec3(-1.0), dvec3(1.0)); }

glm::dmat4 randomCamera(Random& random, double distance) {
    const dvec3 eye = distance * random.direction();
    const glm::dmat4 view = glm::lookAt(eye, random.inCube(1.0), random.direction());
    return glm::perspective(random.between(0.3, 1.8), random.between(0.5, 2.0), 0.1, 100.0) * view;
}

std::vector<dvec4> transformed(const glm::dmat4& matrix, const Points& points) {
    std::vector<dvec4> result;
    for (const dvec3& point : points) result.push_back(matrix * dvec4(point, 1.0));
    return result;
}

bool onScreen(const dvec4& p) { return p.w > 0.0 && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w; }

/// Inside but for the rounding of one matrix product at distances up to 10.
bool inside(const ScreenRect& rect, const dvec4& p) {
    const double tolerance = 1e-12;
    const dvec2 ndc = dvec2(p) / p.w;
    return ndc.x >= rect.low.x - tolerance && ndc.y >= rect.low.y - tolerance && ndc.x <= rect.high.x + tolerance &&
           ndc.y <= rect.high.y + tolerance;
}

/// Throws points of the cut box at the screen. Returns how many of them can be seen.
int expectSamplesInside(Random& random, const glm::dmat4& matrix, const HalfSpaces& halfSpaces, int samples) {
    const auto rect = gnomon::screenBounds(transformed(matrix, gnomon::cutBox(dvec3(-1), dvec3(1), halfSpaces)));
    int visible = 0, missed = 0;
    for (int i = 0; i < samples; ++i) {
        const dvec3 point = inOrOnBox(random);
        const dvec4 clip = matrix * dvec4(point, 1.0);
        if (!keeps(halfSpaces, point) || !onScreen(clip)) continue;
        ++visible;
        missed += !rect || !inside(*rect, clip);
    }
    EXPECT_EQ(missed, 0) << "of " << visible << " visible samples";
    return visible;
}

} // namespace

TEST(CutBox, UncutHasItsEightCorners) {
    const Points corners = gnomon::cutBox({0, 1, 2}, {3, 5, 7}, {});
    EXPECT_EQ(corners.size(), 8u);
    for (const double x : {0.0, 3.0})
        for (const double y : {1.0, 5.0})
            for (const double z : {2.0, 7.0}) EXPECT_TRUE(contains(corners, {x, y, z}, 0.0));
}

TEST(CutBox, APointWhereThreeCutsMeetInsideTheBoxIsACorner) {
    // A pyramid that stands on its tip at (0, 0, 0.2): the tip is on no face of the box.
    const Points corners =
        gnomon::cutBox(dvec3(-1), dvec3(1), {{2, 0, 1, -0.2}, {-2, 0, 1, -0.2}, {0, 2, 1, -0.2}, {0, -2, 1, -0.2}});
    EXPECT_TRUE(contains(corners, {0, 0, 0.2}, 4.0 * ulps));
    EXPECT_TRUE(contains(corners, {0.4, 0.4, 1}, 4.0 * ulps)); // its upper rim: |x| <= 0.8 / 2
    for (const dvec3& corner : corners) EXPECT_GE(corner.z, 0.2 - 4.0 * ulps);
}

TEST(CutBox, NothingLeftIsEmpty) {
    EXPECT_TRUE(gnomon::cutBox({0, 0, 0}, {1, 1, 1}, {{0, 0, 1, -2}}).empty());
    EXPECT_TRUE(gnomon::cutBox({0, 0, 0}, {1, 1, 1}, {{0, 0, 1, -0.6}, {0, 0, -1, 0.4}}).empty());
    EXPECT_TRUE(gnomon::cutBox({0, 0, 0}, {1, -1, 1}, {}).empty()); // low > high, an osg::BoundingBox not yet grown
}

TEST(CutBox, AHalfSpaceWithoutANormalKeepsAllOrNothing) {
    EXPECT_EQ(gnomon::cutBox({0, 0, 0}, {1, 1, 1}, {{0, 0, 0, 3}}).size(), 8u); // a sun's belowLight
    EXPECT_TRUE(gnomon::cutBox({0, 0, 0}, {1, 1, 1}, {{0, 0, 0, -3}}).empty());
}

TEST(CutBox, AFlatBoxIsAPolygonThatIsKeptWhereItLiesOnTheCut) {
    const Points half = gnomon::cutBox({0, 0, 1}, {2, 2, 1}, {{-1, 0, 0, 1}}),
                 mat = gnomon::cutBox({0, 0, 1}, {2, 2, 1}, {{0, 0, 1, -1}}); // cut at the ground
    for (const double y : {0.0, 2.0})
        for (const double x : {0.0, 1.0}) {
            EXPECT_TRUE(contains(half, {x, y, 1}, ulps));
            EXPECT_TRUE(contains(mat, {2.0 * x, y, 1}, 0.0));
        }
    EXPECT_FALSE(contains(half, {2, 0, 1}, 0.5));
}

TEST(CutBox, ACornerInsideALongBoxIsFoundAtItsFarEnd) {
    const Points corners = gnomon::cutBox({-10, -1, -1}, {10, 1, 1}, {{0, 1, 1, 0}, {0, -1, 1, 0}, {0.1, 0, 1, -0.9}});
    EXPECT_TRUE(contains(corners, {9, 0, 0}, 64.0 * ulps)); // z >= |y| meets z >= (9 - x) / 10; the cuts are 6° apart
}

TEST(CutBox, WhatIsNotFiniteGivesNothing) {
    for (const double bad : {notANumber, infinite, -infinite}) {
        EXPECT_TRUE(gnomon::cutBox({0, bad, 0}, {1, 1, 1}, {}).empty());
        EXPECT_TRUE(gnomon::cutBox({0, 0, 0}, {1, 1, bad}, {}).empty());
        EXPECT_TRUE(gnomon::cutBox({0, 0, 0}, {1, 1, 1}, {{0, 0, 1, bad}}).empty());
    }
}

TEST(CutBox, ItsCornersAreInTheBodyAndTheBodyIsBetweenThem) {
    Random random(31);
    int bodies = 0;
    for (int i = 0; i < 400; ++i) {
        const HalfSpaces halfSpaces = randomHalfSpaces(random, i % 6);
        const Points corners = gnomon::cutBox(dvec3(-1), dvec3(1), halfSpaces);
        for (const dvec3& corner : corners) {
            EXPECT_LE(glm::length(glm::max(glm::abs(corner) - 1.0, dvec3(0))), 8.0 * ulps);
            for (const dvec4& h : halfSpaces) EXPECT_GE(glm::dot(h, dvec4(corner, 1.0)), -200.0 * ulps); // |h| <= 20
        }
        Points body;
        for (int j = 0; j < 300; ++j)
            if (const dvec3 point = inOrOnBox(random); keeps(halfSpaces, point)) body.push_back(point);
        bodies += !body.empty();
        for (int j = 0; j < 20 && !body.empty(); ++j) { // no point of the body reaches farther than all corners
            const dvec3 direction = random.direction();
            double reach = -infinite, farthest = -infinite;
            for (const dvec3& corner : corners) reach = std::max(reach, glm::dot(direction, corner));
            for (const dvec3& point : body) farthest = std::max(farthest, glm::dot(direction, point));
            EXPECT_LE(farthest, reach + 16.0 * ulps);
        }
    }
    EXPECT_GT(bodies, 200);
}

TEST(CutBox, TheUnitOfLengthDoesNotMatter) {
    const dvec4 cut(1, 2, -0.5, -0.3);
    const Points metres = gnomon::cutBox(dvec3(-1), dvec3(1), {cut});
    for (const double unit : {1e-6, 1e6}) {
        const Points scaled = gnomon::cutBox(dvec3(-unit), dvec3(unit), {dvec4(dvec3(cut), cut.w * unit)});
        for (const dvec3& corner : metres) EXPECT_TRUE(contains(scaled, corner * unit, 8.0 * ulps * unit));
    }
}

TEST(ScreenOutline, IsTheHullOfWhatIsSeenAndMore) {
    const std::vector<dvec4> corners{
        {-1.0, 0.0, 0.0, 2.0}, {1.0, 0.0, 0.0, 2.0}, {0.0, 0.5, 0.0, 1.0}, {0.0, 0.2, 0.0, 1.0}};
    const auto outline = gnomon::screenOutline(corners, {0.25, 0.0});
    ASSERT_EQ(outline.size(), 4u); // (-0.75, 0), (0.75, 0), (0.25, 0.5), (-0.25, 0.5)
    double left = 0.0, top = 0.0, twice = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        left = std::min(left, a.x);
        top = std::max(top, a.y);
        twice += a.x * b.y - b.x * a.y;
    }
    EXPECT_DOUBLE_EQ(left, -0.75);
    EXPECT_DOUBLE_EQ(top, 0.5);
    EXPECT_DOUBLE_EQ(twice / 2.0, 0.5); // (1.5 + 0.5) / 2 * 0.5, counter-clockwise
}

TEST(ScreenOutline, IsNotKnownWhereSomethingIsBehindTheEyeOrNotFinite) {
    const dvec4 before{0.0, 0.0, 0.0, 1.0};
    for (const dvec4& other : {dvec4(0.0, 0.0, 0.0, -1.0), dvec4(0.0, 0.0, 0.0, 0.0), dvec4(1.0, 0.0, 0.0, 1e-9),
                               dvec4(notANumber, 0.0, 0.0, 1.0)})
        EXPECT_TRUE(gnomon::screenOutline({before, other}, {0.1, 0.1}).empty());
}

TEST(ScreenBounds, NothingToSeeGivesNone) {
    EXPECT_FALSE(gnomon::screenBounds({}));
    EXPECT_FALSE(gnomon::screenBounds({{1.1, 0, 0, 1}, {3, 0, 0, 2}}));     // to the right of the screen
    EXPECT_FALSE(gnomon::screenBounds({{0, -3, 0, 1}, {0, -9, 0, 2}}));     // below it
    EXPECT_FALSE(gnomon::screenBounds({{0, 0, 0, -1}, {0.1, 0.2, 0, -2}})); // behind the eye
    EXPECT_FALSE(gnomon::screenBounds({{0, 0, 0, 0}}));
    EXPECT_FALSE(gnomon::screenBounds({{1, 1, 0, 0}, {-1, -1, 0, 0}})); // in the plane of the eye
}

TEST(ScreenBounds, AreAsWorkedByHand) {
    const struct {
        std::vector<dvec4> points;
        dvec2 low, high;
    } cases[] = {
        {{{-1, 0.5, 0, 2}, {1, 1, 5, 4}}, {-0.5, 0.25}, {0.25, 0.25}},
        {{{-3, -0.5, 0, 1}, {0.5, 7, 0, 1}}, {-1, -0.5}, {0.5, 1}}, // cut at the screen's edges
        // An edge past the eye runs to the infinity on its own side: x at w = 0 is 0.75, so to the right.
        {{{0.5, 0, 0, 1}, {1, 0, 0, -1}}, {0.5, 0}, {1, 0}},
        {{{0.5, 0, 0, 1}, {-1, 0, 0, -1}}, {-1, 0}, {0.5, 0}}, // here it is -0.25: from 0.5 to the left
        {{{0, 0.5, 0, 1}, {0, -1, 0, 0}}, {0, -1}, {0, 0.5}},  // a point at w = 0 is an end at infinity
        {{{0, 0.5, 0, 1}, {2, 0, 0, 0}}, {0, 0.5}, {1, 0.5}},
    };
    for (const auto& [points, low, high] : cases) {
        const auto rect = gnomon::screenBounds(points);
        ASSERT_TRUE(rect);
        EXPECT_EQ(rect->low, low);
        EXPECT_EQ(rect->high, high);
    }
}

TEST(ScreenBounds, GroundUnderTheEyeReachesUpToItsFarEdgeOnly) {
    // The eye 1 above a ground that runs 10 ahead and 10 back, 90° of view: its far edge is at y = -1 / 10.
    const glm::dmat4 projection = glm::perspective(glm::radians(90.0), 1.0, 0.1, 100.0);
    const auto rect =
        gnomon::screenBounds(transformed(projection, {{-1, -1, -10}, {1, -1, -10}, {-1, -1, 10}, {1, -1, 10}}));
    ASSERT_TRUE(rect);
    EXPECT_TRUE(near(rect->low, dvec2(-1, -1), 0.0));
    EXPECT_TRUE(near(rect->high, dvec2(1, -0.1), ulps));
}

TEST(ScreenBounds, PointsThatAreNotFiniteGiveTheWholeScreen) {
    for (const double bad : {notANumber, infinite, -infinite})
        for (int i = 0; i < 4; ++i) {
            dvec4 point(0.1, 0.1, 0.1, 1);
            point[i] = bad;
            const auto rect = gnomon::screenBounds({{0, 0, 0, 1}, point});
            ASSERT_TRUE(rect);
            EXPECT_EQ(rect->low, dvec2(-1, -1));
            EXPECT_EQ(rect->high, dvec2(1, 1));
        }
}

TEST(ScreenBounds, TheLengthOfAHomogeneousPointDoesNotMatter) {
    const std::vector<dvec4> points{{0.5, 0.25, 0, 1}, {-0.25, 0.5, 0, 1}, {0.75, 0.5, 0, -1}};
    const auto expected = gnomon::screenBounds(points);
    ASSERT_TRUE(expected);
    const auto rect = gnomon::screenBounds({points[0] * 0x1p-500, points[1] * 0x1p500, points[2] * 0x1p700});
    ASSERT_TRUE(rect);
    EXPECT_EQ(rect->low, expected->low);
    EXPECT_EQ(rect->high, expected->high);
}

TEST(ScreenBounds, NoVisibleSampleOfABodyIsOutside) {
    Random random(32);
    int visible = 0;
    for (int i = 0; i < 200; ++i) { // 200 × 1,000 samples; distances below √3 put the eye inside or beside the box
        const glm::dmat4 camera = randomCamera(random, random.between(0.1, 6.0));
        visible += expectSamplesInside(random, camera, randomHalfSpaces(random, i % 4), 1000);
    }
    EXPECT_GT(visible, 20000);
}

TEST(ScreenBounds, NoVisibleSampleOfAShadowIsOutside) {
    Random random(33);
    int visible = 0;
    for (int i = 0; i < 200; ++i) { // the body a planar shadow is thrown by: cut, flattened, then seen
        const dvec3 normal = random.direction();
        const dvec4 plane(normal, random.between(-0.5, 1.5));
        const dvec3 lamp = (random.between(0.2, 4.0) - plane.w) * normal + glm::cross(normal, random.inCube(2.0));
        const auto clip = gnomon::planarClipPlanes(plane, dvec4(lamp, 1.0));
        const glm::dmat4 flatten = gnomon::planarShadowMatrix(plane, dvec4(lamp, 1.0)).value();
        const glm::dmat4 camera = randomCamera(random, random.between(0.1, 9.0));
        visible += expectSamplesInside(random, camera * flatten, {clip.abovePlane, clip.belowLight}, 1000);
    }
    EXPECT_GT(visible, 10000);
}

TEST(ScreenBounds, IsNoLargerThanABodyWhollyInFront) {
    Random random(34);
    int boxes = 0;
    for (int i = 0; i < 50; ++i) {
        const glm::dmat4 camera = randomCamera(random, random.between(4.0, 9.0)); // the box's corners are within √3
        dvec2 low(infinite), high(-infinite);
        bool whole = true;
        for (int j = 0; j < 2000; ++j) { // one sample in 216 is a given corner: none is missed
            const dvec4 clip = camera * dvec4(inOrOnBox(random), 1.0);
            whole = whole && onScreen(clip);
            low = glm::min(low, dvec2(clip) / clip.w);
            high = glm::max(high, dvec2(clip) / clip.w);
        }
        if (!whole) continue;
        ++boxes;
        const auto rect = gnomon::screenBounds(transformed(camera, gnomon::cutBox(dvec3(-1), dvec3(1), {})));
        ASSERT_TRUE(rect);
        EXPECT_TRUE(near(rect->low, low, 8.0 * ulps));
        EXPECT_TRUE(near(rect->high, high, 8.0 * ulps));
    }
    EXPECT_GT(boxes, 5);
}

using gnomon::screenArea;
using gnomon::ScreenArea;

namespace {

const glm::dvec2 pixels(200.0, 100.0);
constexpr double rounding = 1e-9;

/// Of a rectangle in normalised device coordinates, at this w.
ScreenArea areaOf(double left, double low, double right, double high, double w = 1.0) {
    return screenArea({{{left * w, low * w, 0.0, w},
                        {right * w, low * w, 0.0, w},
                        {right * w, high * w, 0.0, w},
                        {left * w, high * w, 0.0, w}}},
                      pixels);
}

} // namespace

TEST(ScreenArea, IsThatOfWhatIsInSight) {
    for (const ScreenArea& found : {areaOf(-1.0, -1.0, 1.0, 1.0), areaOf(-5.0, -3.0, 2.0, 4.0, 7.0)}) {
        EXPECT_NEAR(found.area, 20000.0, 20000.0 * rounding) << "all of the screen";
        EXPECT_NEAR(found.around, 600.0, 600.0 * rounding);
    }
    EXPECT_NEAR(areaOf(-0.5, -0.5, 0.5, 0.0).area, 100.0 * 25.0, rounding);
    EXPECT_NEAR(areaOf(0.5, -0.5, -0.5, 0.0).area, 100.0 * 25.0, rounding) << "whichever way the corners go";
    const ScreenArea part = areaOf(0.5, -2.0, 3.0, 0.0);
    EXPECT_NEAR(part.area, 50.0 * 50.0, rounding);
    EXPECT_NEAR(part.around, 200.0, rounding);
    EXPECT_EQ(areaOf(1.5, -1.0, 3.0, 1.0).area, 0.0);
    EXPECT_EQ(areaOf(-0.5, -0.5, 0.5, 0.5, -1.0).area, 0.0) << "it is behind the eye";
}

// From the middle to the right without an end, and the same drawn out of a place behind the eye.
TEST(ScreenArea, OfWhatReachesToInfinityEndsAtTheScreen) {
    const ScreenArea boundless =
        screenArea({{{0.0, -0.5, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {0.0, 0.5, 0.0, 1.0}}}, pixels);
    EXPECT_NEAR(boundless.area, 100.0 * 50.0, rounding);
    const ScreenArea behind = screenArea(
        {{{0.0, -0.5, 0.0, 1.0}, {2.0, -0.5, 0.0, -1.0}, {2.0, 0.5, 0.0, -1.0}, {0.0, 0.5, 0.0, 1.0}}}, pixels);
    EXPECT_GT(behind.area, 100.0 * 50.0) << "it widens towards the eye";
    EXPECT_LT(behind.area, 100.0 * 100.0);
}
