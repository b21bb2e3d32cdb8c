// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace gnomon;

namespace {

const glm::dmat4 here(1.0);

glm::dvec3 seenBy(const glm::dmat4& matrix, const glm::dvec3& point) {
    const glm::dvec4 p = matrix * glm::dvec4(point, 1.0);
    return glm::dvec3(p) / p.w;
}

MapOutline outlineOf(const LightFrame& frame, const glm::dvec3& low, const glm::dvec3& high,
                     const glm::dmat4& sceneFromBox = here) {
    MapOutline outline(frame);
    outline.addBox({low, high, sceneFromBox});
    return outline;
}

constexpr double infinity = std::numeric_limits<double>::infinity();
const glm::dvec3 down(0.0, 0.0, -1.0), north(0.0, 1.0, 0.0);

/// A pixel is a 100th wide wherever it is.
glm::dmat4 map() {
    return glm::ortho(-1.0, 1.0, -1.0, 1.0, 0.0, 100.0) * glm::lookAt(glm::dvec3(0, 0, 50), glm::dvec3(0.0), north);
}

/// From above; a pixel is a 100th as wide as it is far away.
glm::dmat4 flying(double height) {
    return glm::perspective(std::acos(0.0), 1.0, 0.01, 1000.0) *
           glm::lookAt(glm::dvec3(0, 0, height), glm::dvec3(0.0), north);
}
const glm::dvec2 size200(200.0);

glm::dvec3 sunAt(double degrees) { return {std::cos(glm::radians(degrees)), 0.0, std::sin(glm::radians(degrees))}; }

double sideOn(const glm::dvec3& low, const glm::dvec3& high, const LightFrame& light, const glm::dmat4& view,
              const glm::dmat4& sceneFromBox = here, const HalfSpaces& halfSpaces = {}) {
    TexelDensity seen(light, view, size200);
    seen.addBox({low, high, sceneFromBox}, halfSpaces);
    return seen.side;
}

double onGround(double elevation) { return sideOn({-5, -5, 0}, {5, 5, 0}, sunFrame(sunAt(elevation)), map()); }

/// The eye 2 above the ground z = 0, looking along +x, half a right angle to all sides.
glm::dmat4 standing() {
    return glm::perspective(std::acos(0.0), 1.0, 0.25, 4000.0) *
           glm::lookAt(glm::dvec3(0.0, 0.0, 2.0), glm::dvec3(1.0, 0.0, 2.0), glm::dvec3(0.0, 0.0, 1.0));
}

SeenRange rangeOf(double nearest, double farthest) {
    SeenRange range(here);
    range.nearest = nearest;
    range.farthest = farthest;
    return range;
}

bool isIn(const HalfSpaces& part, const glm::dvec4& point) {
    return std::all_of(part.begin(), part.end(), [&](const auto& half) { return glm::dot(half, point) >= 0.0; });
}

bool isWithin(const glm::dmat4& coneFromScene, const glm::dvec3& point, double w = 1.0) {
    const glm::dvec4 at = coneFromScene * glm::dvec4(point * w, w);
    return at.z >= 0.0 && at.x * at.x + at.y * at.y <= at.z * at.z;
}

} // namespace

TEST(LightFrame, PutsWhatLiesOnARayInOnePlaceTheFartherTheDeeper) {
    const glm::dvec3 towardsSun = glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), lamp(1.0, 2.0, 3.0), way(0.5, -0.25, 2.0);
    const glm::dmat4 sun = sunFrame(towardsSun).lightFromScene,
                     cone = lampFrame(lamp, {0.0, 0.0, 1.0}, 1.0).lightFromScene;
    const glm::dvec3 near = seenBy(sun, {4.0, 5.0, 6.0}),
                     far = seenBy(sun, glm::dvec3(4.0, 5.0, 6.0) - 7.0 * towardsSun);
    EXPECT_LE(glm::length(glm::dvec2(near - far)), 1e-14);
    EXPECT_NEAR(far.z - near.z, 7.0, 1e-14);
    const glm::dvec3 one = seenBy(cone, lamp + way), three = seenBy(cone, lamp + 3.0 * way);
    EXPECT_LE(glm::length(glm::dvec2(one - three)), 1e-14);
    EXPECT_NEAR(one.z, -1.0 / 2.0, 1e-14); // -1/w, w along the axis
    EXPECT_NEAR(three.z, -1.0 / 6.0, 1e-14);
}

TEST(MapOutline, OfABoxFromAboveIsItsFootprintAndHeight) {
    const MapOutline outline = outlineOf(sunFrame({0.0, 0.0, 1.0}), {-1.0, -2.0, 0.0}, {1.0, 2.0, 5.0});
    EXPECT_EQ(outline.corners.size(), 4u);
    EXPECT_EQ(outline.nearest, -5.0); // the sun is at z = +∞
    EXPECT_EQ(outline.farthest, 0.0);
}

TEST(MapOutline, OfALampHoldsWhatIsBeforeItOnly) {
    const LightFrame frame = lampFrame({0.0, 0.0, 4.0}, {0.0, 0.0, -1.0}, 1.0);
    EXPECT_TRUE(outlineOf(frame, {-1.0, -1.0, 5.0}, {1.0, 1.0, 6.0}).empty());
    const MapOutline outline = outlineOf(frame, {-9.0, -9.0, 0.0}, {9.0, 9.0, 0.0});
    for (const glm::dvec2& corner : outline.corners)
        EXPECT_NEAR(std::max(std::abs(corner.x), std::abs(corner.y)), 1.0, 1e-12);
    EXPECT_NEAR(outline.farthest, -0.25, 1e-12);
}

TEST(MapOutline, CutToAnotherIsWhatBothHold) {
    const LightFrame frame = sunFrame({0.0, 0.0, 1.0});
    MapOutline outline = outlineOf(frame, {0.0, 0.0, 0.0}, {4.0, 4.0, 1.0});
    outline.cut(outlineOf(frame, {3.0, 1.0, 0.0}, {9.0, 2.0, 9.0}));
    EXPECT_NEAR(fitMap(frame, outline, outline, {0.0, 0.0, 1.0}).area(), 1.0, 1e-12); // x 3 … 4, y 1 … 2
    outline.cut(outlineOf(frame, {5.0, 5.0, 0.0}, {6.0, 6.0, 1.0}));
    EXPECT_TRUE(outline.empty());
}

TEST(MapOutline, HasSidesAndABodyAboutWhatIsInIt) {
    for (const LightFrame& frame : {sunFrame({0.0, 0.6, 0.8}), lampFrame({0.0, 0.0, 9.0}, {0.0, 0.0, -1.0}, 2.0)}) {
        const MapOutline outline = outlineOf(frame, {-1.0, -2.0, 0.0}, {1.0, 2.0, 3.0});
        for (const glm::dvec4& side : outline.sides()) {
            EXPECT_GT(glm::dot(side, glm::dvec4(1.0, -2.0, 3.0, 1.0)), 0.0);
            EXPECT_GT(glm::dot(side, glm::dvec4(-1.0, 2.0, 0.0, 1.0)), 0.0);
        }
        MapOutline again(frame); // from the scene's places back to the light's
        for (const glm::dvec4& p : outline.corners3D()) again.addBox({glm::dvec3(p) / p.w, glm::dvec3(p) / p.w});
        EXPECT_NEAR(again.nearest, outline.nearest, 1e-12);
        EXPECT_NEAR(again.farthest, outline.farthest, 1e-12);
        EXPECT_NEAR(fitMap(frame, again, again, {0.0, 0.0, 1.0}).area(),
                    fitMap(frame, outline, outline, {0.0, 0.0, 1.0}).area(), 1e-9);
    }
}

TEST(MapOutline, MergedWithAnotherIsTheHullOfBothWithAllDepths) {
    const LightFrame frame = sunFrame({0.0, 0.0, 1.0});
    MapOutline outline = outlineOf(frame, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    outline.merge(outlineOf(frame, {4.0, 0.0, 2.0}, {5.0, 1.0, 3.0}));
    EXPECT_EQ(outline.corners.size(), 4u); // [0, 5] x [0, 1]
    EXPECT_NEAR(outline.length(), 5.0, 1e-14);
    MapOutline grown = outline;
    grown.grow(0.5);
    EXPECT_EQ(grown.corners.size(), 4u);
    EXPECT_NEAR(grown.length(), 6.0, 1e-14);
    EXPECT_EQ(outline.nearest, -3.0);
    EXPECT_EQ(outline.farthest, 0.0);
    MapOutline none(frame);
    outline.merge(none);
    EXPECT_EQ(outline.nearest, -3.0);
    none.merge(outline);
    EXPECT_EQ(none.farthest, 0.0);
    EXPECT_EQ(none.corners.size(), 4u);
}

/// Boxes turned, stretched and skewed: large ones first, so that most of the others are within what is known.
std::vector<PlacedBox> skewedBoxes() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<PlacedBox> boxes;
    for (int i = 0; i < 200; ++i) {
        glm::dmat4 place(1.0);
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row) place[column][row] = (i < 3 ? 3.0 : 0.7) * any(random);
        for (int row = 0; row < 3; ++row) place[3][row] = 5.0 * any(random);
        boxes.emplace_back(glm::dvec3(-1.0 - any(random), -1.0, -0.5), glm::dvec3(1.0, 2.0, 0.5 + any(random) / 2.0),
                           place);
    }
    return boxes;
}

TEST(PlacedBox, IsWithinItsBallAndTouchesIt) {
    for (const PlacedBox& box : skewedBoxes()) {
        double farthest = 0.0;
        for (const glm::dvec4& corner : boxCorners(box.low, box.high, box.sceneFromBox))
            farthest = std::max(farthest, glm::distance(glm::dvec3(corner), box.middle));
        EXPECT_LE(farthest, box.radius * (1.0 + 1e-12));
        EXPECT_GE(farthest, box.radius / std::sqrt(3.0)); // no corner is nearer than the longest half of a side is long
    }
    const PlacedBox straight({1.0, 1.0, 1.0}, {3.0, 5.0, 5.0});
    EXPECT_DOUBLE_EQ(straight.radius, 3.0);
    EXPECT_EQ(straight.middle, glm::dvec3(2.0, 3.0, 3.0));
}

TEST(MapOutline, OfManyBoxesIsTheHullOfAllTheirCornersWhicheverComesFirst) {
    const LightFrame frame = sunFrame(glm::normalize(glm::dvec3(0.3, -0.5, 0.8)));
    std::vector<PlacedBox> boxes = skewedBoxes();
    std::vector<glm::dvec2> all;
    double nearest = 1e9, farthest = -1e9;
    for (const PlacedBox& box : boxes)
        for (const glm::dvec4& corner : boxCorners(box.low, box.high, box.sceneFromBox)) {
            const glm::dvec4 at = frame.lightFromScene * corner;
            all.emplace_back(at);
            nearest = std::min(nearest, at.z);
            farthest = std::max(farthest, at.z);
        }
    for (const bool backwards : {false, true}) {
        if (backwards) std::reverse(boxes.begin(), boxes.end());
        MapOutline outline(frame);
        for (const PlacedBox& box : boxes) outline.addBox(box);
        EXPECT_NEAR(outline.nearest, nearest, 1e-9);
        EXPECT_NEAR(outline.farthest, farthest, 1e-9);
        const std::vector<glm::dvec2>& corners = outline.corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
            for (const glm::dvec2& at : all)
                EXPECT_GE(side.x * (at - corners[i]).y - side.y * (at - corners[i]).x, -1e-9);
        }
    }
}

TEST(MapOutline, IsBeforeWhatItHidesFromTheLightAndNothingElse) {
    const LightFrame frame = sunFrame({0.0, 0.0, 1.0});
    const MapOutline box = outlineOf(frame, {-1.0, -2.0, 0.0}, {1.0, 2.0, 5.0}), none(frame);
    EXPECT_TRUE(box.isBefore(outlineOf(frame, {-0.9, -1.9, -3.0}, {0.9, 1.9, -3.0})));
    EXPECT_TRUE(box.isBefore(outlineOf(frame, {-0.9, -1.9, 4.0}, {0.9, 1.9, 4.0})));
    EXPECT_FALSE(box.isBefore(outlineOf(frame, {-0.9, -1.9, 5.1}, {0.9, 1.9, 5.1}))); // nearer to the sun
    EXPECT_FALSE(box.isBefore(outlineOf(frame, {-0.9, -1.9, 0.0}, {1.1, 1.9, 0.0}))); // beside it
    EXPECT_TRUE(box.isBefore(box));
    EXPECT_TRUE(box.isBefore(none));
    EXPECT_FALSE(none.isBefore(box));
}

TEST(MapOutline, OfALampIsDividedOnlyWhereOneMapWouldBeTooCoarse) {
    const LightFrame frame = lampFrame({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0);
    EXPECT_EQ(outlineOf(frame, {1.0, 0.0, 0.0}, {255.0, 1.0, 1.0}).split(), 0.0);
    EXPECT_EQ(outlineOf(sunFrame({1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {9000.0, 1.0, 1.0}).split(), 0.0);
    EXPECT_EQ(outlineOf(frame, {0.25, 0.0, 0.0}, {1024.0, 1.0, 1.0}).split(), 16.0); // 64 times as far, either way
    EXPECT_EQ(MapOutline(frame).split(), 0.0);
}

TEST(MapOutline, IsNearerOrFartherThanADistanceAlongALampsAxis) {
    const LightFrame frame = lampFrame({5.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0);
    for (const double x : {5.5, 6.9, 7.1, 30.0}) {
        EXPECT_EQ(glm::dot(nearerThan(frame, 2.0), glm::dvec4(x, 3.0, 4.0, 1.0)) > 0.0, x < 7.0) << x;
        EXPECT_EQ(glm::dot(fartherThan(frame, 2.0), glm::dvec4(x, 3.0, 4.0, 1.0)) > 0.0, x > 7.0) << x;
    }
}

// A ray from the light's rim past an edge: by similar triangles it meets the surface as far aside as this.
TEST(MapSpread, IsThatOfSimilarTriangles) {
    const int texels = 1024;
    const LightFrame sun = sunFrame({0.0, 0.0, 1.0});
    const MapOutline below = outlineOf(sun, {-4.0, -2.0, 0.0}, {4.0, 2.0, 10.0});
    const MapFit fit = fitMap(sun, below, below, {0.0, 0.0, 1.0});
    const double height = 3.0, tangent = 0.02, radius = 0.25;
    const MapSpread ofSun = mapSpread(sun, fit, tangent, radius, texels);
    for (int axis = 0; axis < 2; ++axis) {
        const double texelsAUnit = texels / fit.size[axis];
        EXPECT_NEAR(ofSun.penumbra[axis] * height / (fit.farthest - fit.nearest), tangent * height * texelsAUnit, 1e-9);
        EXPECT_NEAR(ofSun.nearest[axis], radius * texelsAUnit, 1e-9);
        EXPECT_NEAR(ofSun.farthest[axis], radius * texelsAUnit, 1e-9);
    }
    const LightFrame lamp = lampFrame({0.0, 0.0, 12.0}, {0.0, 0.0, -1.0}, 1.0);
    const MapOutline seen = outlineOf(lamp, {-2.0, -1.0, 0.0}, {2.0, 1.0, 8.0});
    const MapFit lampFit = fitMap(lamp, seen, seen, {0.0, 0.0, 1.0});
    const double edge = 5.0, surface = 11.0, half = 0.3; // distances along the axis
    const MapSpread ofLamp = mapSpread(lamp, lampFit, half, radius, texels);
    const double between = (1.0 / edge - 1.0 / surface) / (lampFit.farthest - lampFit.nearest); // of the map's depth
    const double aside = half * (surface - edge) / edge / surface;                              // tangent
    EXPECT_NEAR(ofLamp.penumbra.x * between, aside * texels / lampFit.size.x, 1e-9);
    EXPECT_NEAR(ofLamp.farthest.x, radius * -lampFit.farthest * texels / lampFit.size.x, 1e-9);
    EXPECT_NEAR(softReach(lamp, -1.0 / edge, -1.0 / surface, half, 0.0), aside, 1e-14);
    EXPECT_NEAR(softReach(lamp, -1.0 / edge, -1.0 / surface, 0.0, radius), radius / edge, 1e-14);
    EXPECT_NEAR(softReach(sun, -10.0, -4.0, tangent, radius), tangent * 6.0 + radius, 1e-14);
}

TEST(FitMap, TurnsWithWhatItCoversKeepsAReserveWithinWhatCastsAndLeavesAMargin) {
    const LightFrame frame = sunFrame({0.0, 0.0, 1.0});
    const MapOutline slanted =
        outlineOf(frame, {-3.0, -1.0, 0.0}, {3.0, 1.0, 1.0}, glm::rotate(here, 0.5, glm::dvec3(0.0, 0.0, 1.0)));
    EXPECT_NEAR(fitMap(frame, slanted, slanted, {0.0, 0.0, 1.0}).area(), 12.0, 1e-9);
    const MapOutline needed = outlineOf(frame, {0.0, 0.0, 0.0}, {8.0, 8.0, 1.0});
    const MapOutline wide = outlineOf(frame, {-9.0, -9.0, 0.0}, {8.5, 8.5, 1.0});
    EXPECT_NEAR(fitMap(frame, needed, wide, {0.125, 0.0, 1.0}).area(), 9.5 * 9.5,
                1e-9); // 8 and one more on each side, or half
    EXPECT_NEAR(fitMap(frame, needed, needed, {0.125, 0.1, 1.0}).area(), 100.0, 1e-9); // 8 is 80 % of the side
}

/// How far a place is from the middle of its texel, in texels of 64 on a side.
glm::dvec2 inTexel(const MapFit& fit, const glm::dvec3& place) {
    const glm::dvec2 texels = 64.0 * glm::dvec2(seenBy(fit.mapFromScene, place));
    return texels - glm::floor(texels) - 0.5;
}

TEST(SlidMap, HoldsTheOutlineInItsMiddleAndLeavesEveryTexelWhereItWas) {
    const glm::dvec3 utm(432100.0, 6400000.0, 812.0);
    for (const glm::dvec3& at : {glm::dvec3(0.0), utm})
        for (const LightFrame& frame : {sunFrame(glm::normalize(glm::dvec3(1.0, 0.5, 1.0))),
                                        lampFrame(at + glm::dvec3(0.0, 0.0, 30.0), down, 2.0)}) {
            const auto outlineAt = [&](const glm::dvec3& aside) {
                return outlineOf(frame, at + aside, at + aside + glm::dvec3(8.0, 8.0, 1.0));
            };
            const MapOutline before = outlineAt(glm::dvec3(0.0)), now = outlineAt({4.7, 1.3, -0.4});
            const MapFit fit = fitMap(frame, before, outlineOf(frame, at - 99.0, at + 99.0), {0.125, 0.05, 1.0}),
                         slid = slidMap(fit, frame, now, 1.0, 64);
            EXPECT_FALSE(fit.covers(now, 0.0));
            EXPECT_TRUE(slid.covers(now, 0.14 - 0.51 / 64.0)); // 0.05 of its sides, and 0.125 of the outline's
            EXPECT_EQ(slid.size, fit.size);
            const MapFit fresh = fitMap(frame, now, now, {0.125, 0.05, 1.0});
            EXPECT_EQ(slid.nearest, fresh.nearest);
            EXPECT_EQ(slid.farthest, fresh.farthest);
            const double rounding = 1e-12 * (1.0 + glm::length(at)); // in texels, which are 0.1 or more
            for (const glm::dvec3& place : {glm::dvec3(0.31, 0.17, 0.0), glm::dvec3(7.3, 7.9, 1.0)}) {
                const glm::dvec2 moved = inTexel(slid, at + place) - inTexel(fit, at + place);
                EXPECT_LE(glm::length(moved), rounding);
            }
        }
}

TEST(MapFit, CoversWhatItWasMadeForAndNothingThatSticksOut) {
    const LightFrame frame = sunFrame(glm::normalize(glm::dvec3(1.0, 0.5, 1.0)));
    const MapOutline needed = outlineOf(frame, {0.0, 0.0, 0.0}, {8.0, 8.0, 1.0});
    const MapFit fit = fitMap(frame, needed, needed, {0.0, 0.01, 1.0});
    EXPECT_TRUE(fit.covers(needed, 0.009));
    EXPECT_FALSE(fit.covers(outlineOf(frame, {-0.5, 0.0, 0.0}, {8.0, 8.0, 1.0}), 0.0));
    EXPECT_FALSE(fit.covers(outlineOf(frame, {0.0, 0.0, -40.0}, {8.0, 8.0, 1.0}), 0.0));
    const LightFrame noon = sunFrame({0.0, 0.0, 1.0}); // what sticks out is behind what is in the map, or before it
    const auto between = [&noon](double low, double high) {
        return outlineOf(noon, {0.0, 0.0, low}, {8.0, 8.0, high});
    };
    const MapFit level = fitMap(noon, between(0.0, 1.0), between(0.0, 1.0), {0.0, 0.01, 0.0});
    for (const auto& [low, high] : {std::pair(-1.0, 1.0), {0.0, 2.0}})
        EXPECT_FALSE(level.covers(between(low, high), 0.0)) << low; // an eighth of 1 is to spare
    EXPECT_TRUE(level.covers(between(-0.1, 1.1), 0.0));
}

/// By points: whatever of a box is in view lies within the map.
TEST(MapFit, HoldsEveryPointOfABoxThatIsInView) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
    const auto point = [&] { return glm::dvec3(anywhere(random), anywhere(random), anywhere(random)); };
    int held = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const LightFrame frame =
            trial % 2 ? sunFrame(glm::normalize(point())) : lampFrame(5.0 * point(), {0.0, 1.0, 0.0}, 1.5);
        const glm::dvec4 view(point(), 0.25);
        MapOutline outline(frame);
        outline.addBox({glm::dvec3(-1.0), glm::dvec3(1.0)}, {view});
        if (outline.empty()) continue;
        const MapFit fit = fitMap(frame, outline, outline, {0.0, 0.001, 1e-3});
        for (int i = 0; i < 100; ++i) {
            const glm::dvec4 p(point(), 1.0);
            bool seen = glm::dot(view, p) >= 0.0;
            for (const glm::dvec4& half : frame.halfSpaces) seen = seen && glm::dot(half, p) >= 0.0;
            if (!seen) continue;
            const glm::dvec3 at = seenBy(fit.mapFromScene, glm::dvec3(p));
            for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(at[axis] >= 0.0 && at[axis] <= 1.0) << at[axis];
            ++held;
        }
    }
    EXPECT_GT(held, 4000);
}

TEST(MapErrors, GrowWithTheTexelAndOfALampTowardsIt) {
    const glm::dvec3 reach(10.0, 10.0, 1.0);
    const LightFrame sun = sunFrame({0.0, 0.0, 1.0}), lamp = lampFrame({0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 1.0);
    const auto errors = [&](const LightFrame& frame, int texels) {
        const MapOutline outline = outlineOf(frame, -reach, reach);
        return mapErrors(frame, fitMap(frame, outline, outline, {0.0, 0.0, 0.1}), reach, texels);
    };
    EXPECT_EQ(errors(sun, 512).nearest.steepest, 2.0 * errors(sun, 1024).farthest.steepest);
    EXPECT_GT(errors(lamp, 512).nearest.steepest, errors(lamp, 512).farthest.steepest);
    EXPECT_LT(errors(sun, 1024).nearest.depth, 1e-5);
    EXPECT_LT(errors(sun, 1024).nearest.texels, 0.01);
}

TEST(TexelDensity, AreStretchedByTheSlopeOfFlatGroundsUpToEightTimes) {
    EXPECT_NEAR(onGround(90.0), 0.01, 1e-12);
    EXPECT_NEAR(onGround(30.0), 0.01 * 0.5, 1e-12);
    EXPECT_NEAR(onGround(1.0), 0.01 / 8.0, 1e-12);
    EXPECT_NEAR(sideOn({-5, -5, 0}, {5, 5, 1}, sunFrame(sunAt(30.0)), map()), 0.01 * 0.5, 1e-12); // a landscape
    EXPECT_NEAR(sideOn({-5, -5, 0}, {5, 5, 5}, sunFrame(sunAt(90.0)), map()), 0.01 * 0.5, 1e-12); // a body
    // A wall that was built lying, ten times as large, is as steep to a sun at 60 degrees as a ground to one at 30.
    const glm::dmat4 standing = glm::scale(glm::rotate(here, glm::radians(90.0), north), glm::dvec3(10.0));
    EXPECT_NEAR(sideOn({-1, -1, 0}, {1, 1, 0}, sunFrame(sunAt(60.0)), map(), standing), 0.01 * 0.5, 1e-12);
}

TEST(TexelDensity, AreSmallestWhereWhatIsSeenIsNearest) {
    const LightFrame sun = sunFrame(sunAt(90.0));
    EXPECT_NEAR(sideOn({-5, -5, 0}, {5, 5, 0}, sun, flying(20.0)), 0.2, 1e-12);
    EXPECT_NEAR(sideOn({-5, -5, 0}, {5, 5, 10}, sun, flying(20.0)), 0.1 / 2.0, 1e-12);
    EXPECT_NEAR(sideOn({-5, -5, 0}, {5, 5, 10}, sun, flying(20.0), here, {{0, 0, -1, 4}}), 0.16 / 2.0, 1e-12);
    EXPECT_EQ(sideOn({-5, -5, 0}, {5, 5, 30}, sun, flying(20.0)), 0.0); // around the eye
    EXPECT_EQ(sideOn({-5, -5, 0}, {5, 5, 0}, sun, flying(20.0), here, {{0, 0, 1, -1}}), infinity);

    TexelDensity three(sun, flying(20.0), size200);
    three.addBox({{-5, -5, 0}, {5, 5, 0}}, {});
    three.addBox({{-5, -5, 12}, {5, 5, 12}}, {});
    three.addBox({{-5, -5, 4}, {5, 5, 4}}, {});
    EXPECT_NEAR(three.side, 0.08, 1e-12);
}

// As a share of the distance from the lamp: in its map that is what a texel is. The farther from below it, the more slanted.
TEST(TexelDensity, AreSeenFromWhereALampIs) {
    const LightFrame lamp = lampFrame({0, 0, 4}, down, 1.0);
    const auto cosine = [](double beside, double above) { return above / std::hypot(beside, above); };
    const double corner = std::sqrt(2.0);
    EXPECT_NEAR(sideOn({-1, -1, 0}, {1, 1, 0}, lamp, map()), 0.01 / 4.0 * cosine(corner, 4.0), 1e-12);
    EXPECT_NEAR(sideOn({-1, -1, 0}, {1, 1, 0}, lampFrame({0, 0, 8}, down, 1.0), map()),
                0.01 / 8.0 * cosine(corner, 8.0), 1e-12);
    EXPECT_NEAR(sideOn({-1, -1, 0}, {1, 1, 0}, lamp, flying(20.0)), 0.2 / 4.0 * cosine(corner, 4.0), 1e-12);
    EXPECT_NEAR(sideOn({-3, -3, 0}, {3, 3, 0}, lamp, map()), 0.01 / 4.0 * cosine(3.0 * corner, 4.0), 1e-12);
    EXPECT_NEAR(sideOn({-1, -1, 0}, {1, 1, 2}, lamp, map()), 0.01 / 4.0 / 2.0, 1e-12); // a body's farthest
}

// A lamp a metre behind the eye, over a landscape that reaches behind both.
TEST(TexelDensity, AreAsSmallWhicheverBoxComesFirst) {
    const glm::dmat4 view = glm::perspective(std::acos(0.0), 1.0, 0.1, 1000.0) *
                            glm::lookAt(glm::dvec3(0, 0, 2), glm::dvec3(1, 0, 2), glm::dvec3(0, 0, 1));
    const LightFrame lamp = lampFrame({-1, 0, 2}, {1, 0, 0}, 1.0);
    const HalfSpaces ahead{{1, 0, 0, -0.1}};
    const auto side = [&](bool mountainFirst) {
        TexelDensity seen(lamp, view, size200);
        for (const bool mountain : {mountainFirst, !mountainFirst})
            mountain ? seen.addBox({{60, -10, 0}, {80, 10, 20}}, ahead)
                     : seen.addBox({{-100, -100, -1}, {100, 100, 3}}, ahead);
        return seen.side;
    };
    EXPECT_EQ(side(true), side(false));
    EXPECT_LT(side(true), 0.001 / 1.1); // at the near plane
}

TEST(TexelDensity, AreAsSmallAsTheirShorterSide) {
    for (const glm::dvec2& given : {glm::dvec2(200, 100), glm::dvec2(100, 200)}) {
        TexelDensity seen(sunFrame(sunAt(90.0)), map(), given);
        seen.addBox({{-5, -5, 0}, {5, 5, 0}}, {});
        EXPECT_NEAR(seen.side, 0.01, 1e-12);
    }
}

TEST(TexelsFor, AreAsManyAsWantedInSteps) {
    EXPECT_EQ(texelsFor(512.0, 1024, 0), 512);
    EXPECT_EQ(texelsFor(513.0, 1024, 0), 544);
    EXPECT_EQ(texelsFor(0.0, 1024, 0), 64);
    EXPECT_EQ(texelsFor(2000.0, 1024, 0), 1024);
    EXPECT_EQ(texelsFor(infinity, 1024, 0), 1024);
    EXPECT_EQ(texelsFor(1000.0, 1000, 0), 1000);
    EXPECT_EQ(texelsFor(0.0, 16, 0), 16);
}

TEST(TexelsFor, StayUntilThereAreTooFewOrTwiceTooMany) {
    for (const int before : {450, 512, 1000}) EXPECT_EQ(texelsFor(512.0, 1024, before), before);
    EXPECT_EQ(texelsFor(512.0, 1024, 440), 512);
    EXPECT_EQ(texelsFor(512.0, 2048, 1056), 512);
    EXPECT_EQ(texelsFor(512.0, 600, 1000), 512); // fewer are allowed than before
    EXPECT_EQ(texelsFor(0.0, 1024, 64), 64);
    EXPECT_EQ(texelsFor(infinity, 1024, 1024), 1024);
}

TEST(CascadeSplits, AreEachAsManyTimesAsFarAsTheOneBefore) {
    const std::vector<double> splits = cascadeSplits(rangeOf(1.0, 1000.0), 3);
    ASSERT_EQ(splits.size(), 2u);
    EXPECT_NEAR(splits[0], 10.0, 1e-9);
    EXPECT_NEAR(splits[1], 100.0, 1e-9);
}

TEST(CascadeSplits, AreNoMoreThanAreOfUse) {
    EXPECT_EQ(cascadeSplits(rangeOf(10.0, 1000.0), 1).size(), 0u);
    EXPECT_EQ(cascadeSplits(rangeOf(10.0, 39.0), 4).size(), 0u); // two parts would be less than twice as far each
    EXPECT_EQ(cascadeSplits(rangeOf(10.0, 41.0), 4).size(), 1u);
    EXPECT_EQ(cascadeSplits(rangeOf(1.0, 1.0), 4).size(), 0u); // as orthographic views are
    EXPECT_EQ(cascadeSplits(SeenRange(here), 4).size(), 0u);
}

TEST(CascadeSplits, HoldForWhatIsAtTheEyeItself) {
    const std::vector<double> splits = cascadeSplits(rangeOf(0.0, 1000.0), 4);
    EXPECT_EQ(splits.size(), 3u);
    for (const double split : splits) EXPECT_GT(split, 0.0);
}

// From 1 to 1000: one part if it may be 1000 times as far at its end, two if 31.6 times, three if 10 times.
TEST(Cascades, AreAsManyAsKeepTexelsToThreePixels) {
    const SeenRange seen = rangeOf(1.0, 1000.0);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 1001.0, 0), 1);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 999.0, 0), 2);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 31.0, 0), 3); // 31² is less than 1000
    EXPECT_EQ(cascadesFor(seen, 3.0 / 32.0, 0), 2);
    EXPECT_EQ(cascadesFor(seen, 100.0, 0), 4);
    EXPECT_EQ(cascadesFor(rangeOf(1.0, 1.0), 1.0, 0), 1);
}

TEST(Cascades, StayAsManyAsTheyWereWhereAnotherCountHardlyMatters) {
    const SeenRange seen = rangeOf(1.0, 1000.0);
    for (const double pixels : {3.0 / 31.0, 3.0 / 32.0})
        for (const int before : {2, 3}) EXPECT_EQ(cascadesFor(seen, pixels, before), before);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 31.0, 1), 3);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 32.0, 4), 2);
}

// A ray to the lower edge of such a picture falls as far as it goes: it meets the ground 2 ahead.
TEST(SeenRange, OfAGroundIsFromWhereThePictureBeginsToWhereTheGroundEnds) {
    SeenRange range(standing());
    range.addBox({{-50.0, -50.0, 0.0}, {300.0, 50.0, 0.0}}, viewPart(standing(), {}, 0));
    EXPECT_NEAR(range.nearest, 2.0, 1e-9);
    EXPECT_NEAR(range.farthest, 300.0, 1e-9);
}

TEST(SeenRange, IsEmptyWhereNothingIsInView) {
    SeenRange range(standing());
    range.addBox({{-50.0, -50.0, 0.0}, {-1.0, 50.0, 9.0}}, viewPart(standing(), {}, 0));
    EXPECT_TRUE(range.empty());
}

TEST(ViewPart, EachPointOfAViewIsInThePartThatItsDistanceSays) {
    const glm::dmat4 clipFromScene = standing();
    const std::vector<double> splits{10.0, 100.0};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.2, 1.2), distance(-2.0, 9.0);
    for (int i = 0; i < 2000; ++i) {
        const double w = std::exp(distance(random)), x = unit(random), y = unit(random);
        const glm::dvec4 point(w, x * w, 2.0 + y * w, 1.0);
        const bool inView = std::max(std::abs(x), std::abs(y)) <= 1.0 && w >= 0.25 && w <= 4000.0;
        const std::size_t right = w < 10.0 ? 0 : w < 100.0 ? 1 : 2;
        for (std::size_t part = 0; part < 3; ++part)
            EXPECT_EQ(isIn(viewPart(clipFromScene, splits, part), point), inView && part == right) << w << " " << part;
    }
}

TEST(CornersWithin, AreABoxsOwnWhereAllOfItIsInside) {
    const auto corners = cornersWithin({{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}, {{1.0, 0.0, 0.0, 0.0}});
    EXPECT_EQ(corners.size(), 8u);
}

TEST(CornersWithin, AreNoneOfABoxThatIsOutsideOneHalfSpace) {
    EXPECT_TRUE(cornersWithin({{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}, {{-1.0, 0.0, 0.0, 0.5}}).empty());
}

TEST(CornersWithin, EndAtTheHalfSpacesBoundary) {
    double most = 0.0;
    for (const glm::dvec4& corner :
         cornersWithin({{0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, glm::scale(here, glm::dvec3(3.0))}, {{-1.0, 0.0, 0.0, 4.5}}))
        most = std::max(most, corner.x);
    EXPECT_NEAR(most, 4.5, 1e-12);
}

TEST(SpotCone, OfThirtyDegreesDownHoldsADiscOfTheTangentOnTheFloor) {
    const glm::dmat4 cone = gnomon::coneFromScene({1.0, 2.0, 5.0}, {{0.0, 0.0, -1.0}, std::asin(0.5)});
    const double radius = 5.0 / std::sqrt(3.0);
    EXPECT_TRUE(isWithin(cone, {1.0, 2.0, 0.0}));
    EXPECT_TRUE(isWithin(cone, {1.0 + 0.999 * radius, 2.0, 0.0}));
    EXPECT_FALSE(isWithin(cone, {1.0, 2.0 - 1.001 * radius, 0.0}));
    EXPECT_FALSE(isWithin(cone, {1.0, 2.0, 6.0})) << "behind it";
}

/// By the angle between the axis and the way to a point, as OpenGL has it.
TEST(SpotCone, HoldsWhatIsAtNoLargerAngleFromItsAxisWhereverItStands) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-10.0, 10.0);
    const auto place = [&] { return glm::dvec3(side(random), side(random), side(random)); };
    int within = 0;
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 apex = place(), axis = glm::normalize(place()), point = place();
        const double cutoff = std::abs(side(random)) / 10.0 * std::acos(0.0);
        const double angle = std::acos(glm::dot(axis, glm::normalize(point - apex)));
        if (std::abs(angle - cutoff) < 1e-9) continue;
        within += angle < cutoff;
        EXPECT_EQ(isWithin(gnomon::coneFromScene(apex, {axis, cutoff}), point, 0.25), angle < cutoff);
    }
    EXPECT_GT(within, 1000);
}
