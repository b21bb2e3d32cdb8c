// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/TexelDensity.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace gnomon;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const glm::dmat4 here(1.0);
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
const glm::dvec2 pixels(200.0);

glm::dvec3 sunAt(double degrees) { return {std::cos(glm::radians(degrees)), 0.0, std::sin(glm::radians(degrees))}; }

double sideOn(const glm::dvec3& low, const glm::dvec3& high, const LightFrame& light, const glm::dmat4& view,
              const glm::dmat4& sceneFromBox = here, const std::vector<glm::dvec4>& halfSpaces = {}) {
    TexelDensity seen(light, view, pixels);
    seen.addBox(low, high, sceneFromBox, halfSpaces);
    return seen.side;
}

double onGround(double elevation) { return sideOn({-5, -5, 0}, {5, 5, 0}, sunFrame(sunAt(elevation)), map()); }

} // namespace

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

    TexelDensity both(sun, flying(20.0), pixels);
    both.addBox({-5, -5, 0}, {5, 5, 0}, here, {});
    both.addBox({-5, -5, 12}, {5, 5, 12}, here, {});
    both.addBox({-5, -5, 4}, {5, 5, 4}, here, {});
    EXPECT_NEAR(both.side, 0.08, 1e-12);
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
    const std::vector<glm::dvec4> ahead{{1, 0, 0, -0.1}};
    const auto side = [&](bool mountainFirst) {
        TexelDensity seen(lamp, view, pixels);
        for (const bool mountain : {mountainFirst, !mountainFirst})
            mountain ? seen.addBox({60, -10, 0}, {80, 10, 20}, here, ahead)
                     : seen.addBox({-100, -100, -1}, {100, 100, 3}, here, ahead);
        return seen.side;
    };
    EXPECT_EQ(side(true), side(false));
    EXPECT_LT(side(true), 0.001 / 1.1); // at the near plane
}

TEST(TexelDensity, AreAsSmallAsTheirShorterSide) {
    for (const glm::dvec2& given : {glm::dvec2(200, 100), glm::dvec2(100, 200)}) {
        TexelDensity seen(sunFrame(sunAt(90.0)), map(), given);
        seen.addBox({-5, -5, 0}, {5, 5, 0}, here, {});
        EXPECT_NEAR(seen.side, 0.01, 1e-12);
    }
}

TEST(TexelsFor, AreAsManyAsWantedInStepsAndStayUntilThereAreTooFewOrTwiceTooMany) {
    const struct {
        double wanted;
        int most, before, expected;
    } cases[] = {{512.0, 1024, 0, 512},     {513.0, 1024, 0, 544},       {0.0, 1024, 0, 64},
                 {2000.0, 1024, 0, 1024},   {infinity, 1024, 0, 1024},   {1000.0, 1000, 0, 1000},
                 {0.0, 16, 0, 16},          {512.0, 1024, 450, 450},     {512.0, 1024, 512, 512},
                 {512.0, 1024, 1000, 1000}, {512.0, 1024, 440, 512},     {512.0, 2048, 1056, 512},
                 {512.0, 600, 1000, 512}, // fewer are allowed than before
                 {0.0, 1024, 64, 64},       {infinity, 1024, 1024, 1024}};
    for (const auto& [wanted, most, before, expected] : cases)
        EXPECT_EQ(texelsFor(wanted, most, before), expected) << wanted << " " << most << " " << before;
}
