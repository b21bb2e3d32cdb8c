// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/MapFit.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
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
    outline.addBox(low, high, sceneFromBox);
    return outline;
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
    EXPECT_NEAR(fitMap(frame, outline, outline, 0.0, 0.0, 1.0).area(), 1.0, 1e-12); // x 3 … 4, y 1 … 2
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
        for (const glm::dvec4& p : outline.body()) again.addBox(glm::dvec3(p) / p.w, glm::dvec3(p) / p.w, here);
        EXPECT_NEAR(again.nearest, outline.nearest, 1e-12);
        EXPECT_NEAR(again.farthest, outline.farthest, 1e-12);
        EXPECT_NEAR(fitMap(frame, again, again, 0.0, 0.0, 1.0).area(),
                    fitMap(frame, outline, outline, 0.0, 0.0, 1.0).area(), 1e-9);
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
    const MapFit fit = fitMap(sun, below, below, 0.0, 0.0, 1.0);
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
    const MapFit lampFit = fitMap(lamp, seen, seen, 0.0, 0.0, 1.0);
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
    EXPECT_NEAR(fitMap(frame, slanted, slanted, 0.0, 0.0, 1.0).area(), 12.0, 1e-9);
    const MapOutline needed = outlineOf(frame, {0.0, 0.0, 0.0}, {8.0, 8.0, 1.0});
    const MapOutline wide = outlineOf(frame, {-9.0, -9.0, 0.0}, {8.5, 8.5, 1.0});
    EXPECT_NEAR(fitMap(frame, needed, wide, 0.125, 0.0, 1.0).area(), 9.5 * 9.5,
                1e-9); // 8 and one more on each side, or half
    EXPECT_NEAR(fitMap(frame, needed, needed, 0.125, 0.1, 1.0).area(), 100.0, 1e-9); // 8 is 80 % of the side
}

TEST(MapFit, CoversWhatItWasMadeForAndNothingThatSticksOut) {
    const LightFrame frame = sunFrame(glm::normalize(glm::dvec3(1.0, 0.5, 1.0)));
    const MapOutline needed = outlineOf(frame, {0.0, 0.0, 0.0}, {8.0, 8.0, 1.0});
    const MapFit fit = fitMap(frame, needed, needed, 0.0, 0.01, 1.0);
    EXPECT_TRUE(fit.covers(needed, 0.009));
    EXPECT_FALSE(fit.covers(outlineOf(frame, {-0.5, 0.0, 0.0}, {8.0, 8.0, 1.0}), 0.0));
    EXPECT_FALSE(fit.covers(outlineOf(frame, {0.0, 0.0, -40.0}, {8.0, 8.0, 1.0}), 0.0));
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
        outline.addBox(glm::dvec3(-1.0), glm::dvec3(1.0), here, {view});
        if (outline.empty()) continue;
        const MapFit fit = fitMap(frame, outline, outline, 0.0, 0.001, 1e-3);
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
        return mapErrors(frame, fitMap(frame, outline, outline, 0.0, 0.0, 0.1), reach, texels);
    };
    EXPECT_EQ(errors(sun, 512).nearest.steepest, 2.0 * errors(sun, 1024).farthest.steepest);
    EXPECT_GT(errors(lamp, 512).nearest.steepest, errors(lamp, 512).farthest.steepest);
    EXPECT_LT(errors(sun, 1024).nearest.depth, 1e-5);
    EXPECT_LT(errors(sun, 1024).nearest.texels, 0.01);
}
