// SPDX-License-Identifier: MIT
// How well depth alone tells what lies in the plane: a shadow without a named receiver beside one with it.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>

using namespace test;

namespace {

struct Range {
    double groundHalf, near, far, eyeHeight, eyeDistance;
};

struct Difference {
    int shadow = 0, missing = 0, extra = 0;
};

Difference unnamedAgainstNamed(const Range& range) {
    const double size = range.eyeDistance / 10.0;
    std::vector<Mesh> houses;
    for (int i = 0; i < 42; ++i)
        houses.push_back(
            house({(i % 7 - 3) * size * 2.0, (i / 7 - 1) * size * 3.0}, {size, size, size * 1.5}, i * 20.0));
    const View view =
        perspective({0.0, -range.eyeDistance, range.eyeHeight}, {0.0, 0.0, 0.0}, 800, 600, 40.0, range.near, range.far);
    const auto picture = [&](bool shadow, bool named) {
        Scene scene = groundScene(houses, range.groundHalf, {1.0, 0.3, 1.2, 0.0});
        if (shadow) scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
        return render(scene.root, view);
    };
    const Picture lit = picture(false, false), named = picture(true, true), unnamed = picture(true, false);
    Difference result;
    for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
        const bool expected = named.pixels[i] != lit.pixels[i], found = unnamed.pixels[i] != lit.pixels[i];
        result.shadow += expected;
        result.missing += expected && !found;
        result.extra += found && !expected;
    }
    return result;
}

} // namespace

TEST(PlanarBand, NoShadowIsMissingOnGroundsFromMetresToKilometres) {
    for (const Range& range : {Range{8, 1, 100, 10, 14}, Range{8, 0.5, 100, 1.0, 4}, Range{20, 0.1, 100, 0.3, 2},
                               Range{2, 0.05, 10, 0.05, 1}, Range{2, 0.05, 10, 0.03, 0.5}, Range{8, 0.1, 1000, 10, 14},
                               Range{100, 1, 1000, 10, 30}, Range{1000, 1, 5000, 20, 60},
                               Range{9000, 1, 20000, 20, 300}, Range{9000, 1, 20000, 400, 900}}) {
        const Difference found = unnamedAgainstNamed(range);
        EXPECT_GT(found.shadow, 5000);
        EXPECT_EQ(found.missing, 0) << range.groundHalf << " near " << range.near;
        // The feet of walls: the margin is a pixel high at most in these views, and the feet are some
        // thousand pixels long beside tens of thousands of shadow.
        EXPECT_LE(found.extra, found.shadow / 100) << range.groundHalf << " near " << range.near;
    }
}
