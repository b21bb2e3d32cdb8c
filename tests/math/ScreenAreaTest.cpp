// SPDX-License-Identifier: MIT
// Pixels that a quadrangle covers of a screen, against closed forms.
#include <gnomon/geometry/ScreenBounds.h>

#include <gtest/gtest.h>

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

TEST(ScreenArea, OfAllOfTheScreenIsItsPixels) {
    for (const ScreenArea& found : {areaOf(-1.0, -1.0, 1.0, 1.0), areaOf(-5.0, -3.0, 2.0, 4.0, 7.0)}) {
        EXPECT_NEAR(found.area, 20000.0, 20000.0 * rounding);
        EXPECT_NEAR(found.around, 600.0, 600.0 * rounding);
    }
}

TEST(ScreenArea, IsTheSameWhicheverWayTheCornersGo) {
    EXPECT_NEAR(areaOf(-0.5, -0.5, 0.5, 0.0).area, 100.0 * 25.0, rounding);
    EXPECT_NEAR(areaOf(0.5, -0.5, -0.5, 0.0).area, 100.0 * 25.0, rounding);
}

TEST(ScreenArea, OfWhatIsPartlyInSightIsThatPart) {
    const ScreenArea found = areaOf(0.5, -2.0, 3.0, 0.0);
    EXPECT_NEAR(found.area, 50.0 * 50.0, rounding);
    EXPECT_NEAR(found.around, 200.0, rounding);
    EXPECT_EQ(areaOf(1.5, -1.0, 3.0, 1.0).area, 0.0);
    EXPECT_EQ(areaOf(-0.5, -0.5, 0.5, 0.5, -1.0).area, 0.0) << "it is behind the eye";
}

// From the middle to the right without an end, and the same drawn out of a place behind the eye.
TEST(ScreenArea, OfWhatReachesToInfinityEndsAtTheScreen) {
    const ScreenArea infinite =
        screenArea({{{0.0, -0.5, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {0.0, 0.5, 0.0, 1.0}}}, pixels);
    EXPECT_NEAR(infinite.area, 100.0 * 50.0, rounding);
    const ScreenArea behind = screenArea(
        {{{0.0, -0.5, 0.0, 1.0}, {2.0, -0.5, 0.0, -1.0}, {2.0, 0.5, 0.0, -1.0}, {0.0, 0.5, 0.0, 1.0}}}, pixels);
    EXPECT_GT(behind.area, 100.0 * 50.0) << "it widens towards the eye";
    EXPECT_LT(behind.area, 100.0 * 100.0);
}
