// SPDX-License-Identifier: MIT
// What is drawn over a picture to show how maps lie.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

using gnomon::ShadowMapTechnique;
using test::Picture;
using test::Scene;
using test::TracedCase;

namespace {

Picture pictureOf(const TracedCase& given, ShadowMapTechnique::View view, int size, int cascades = 1) {
    Scene scene = given.build();
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(size);
    technique->setCascades(cascades);
    technique->setView(view);
    scene.addShadow(technique);
    const Picture picture = test::render(scene.root, given.view);
    EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
    return picture;
}

int channel(std::uint32_t color, int i) { return int(color >> (8 * i) & 0xffu); }

/// What was laid over a colour at half: -1 where that cannot have been.
std::array<int, 3> laidOver(std::uint32_t before, std::uint32_t after) {
    std::array<int, 3> over{};
    for (int i = 0; i < 3; ++i) over[std::size_t(i)] = 2 * channel(after, i) - channel(before, i);
    return over;
}

/// Which of these tints it is, to the rounding of two blends; 4 for none.
int tintOf(const std::array<int, 3>& over) {
    constexpr std::array<std::array<double, 3>, 4> tints{
        {{0.9, 0.1, 0.1}, {0.1, 0.8, 0.2}, {0.2, 0.3, 1.0}, {0.9, 0.8, 0.1}}};
    for (int tint = 0; tint < 4; ++tint) {
        bool same = true;
        for (std::size_t i = 0; i < 3; ++i)
            same = same && std::abs(over[i] - 255.0 * tints[std::size_t(tint)][i]) <= 3.0;
        if (same) return tint;
    }
    return 4;
}

} // namespace

TEST(MapDebugView, OfCascadesIsRedThenGreenThenBlueTheFartherOneLooks) {
    const TracedCase street = test::longStreet(45.0);
    const Picture plain = pictureOf(street, ShadowMapTechnique::NOTHING, 512, 3),
                  tinted = pictureOf(street, ShadowMapTechnique::CASCADES, 512, 3);
    int last = 0, changes = 0, other = 0;
    for (int y = 0; y < 254; ++y) { // the street, to half a kilometre, short of the horizon
        const int x = street.view.width / 2;
        if (plain.at(x, y) == tinted.at(x, y)) continue; // none answers
        const int tint = tintOf(laidOver(plain.at(x, y), tinted.at(x, y)));
        changes += tint == last + 1;
        other += tint != last && tint != last + 1;
        last = tint;
    }
    EXPECT_EQ(other, 0);
    EXPECT_EQ(changes, 2);
    EXPECT_EQ(last, 2);
}

TEST(MapDebugView, OfTexelsIsRedWhereTheyAreCoarseAndNotWhereTheyAreAsFineAsPixels) {
    const TracedCase lab = test::labEight();
    const Picture plain = pictureOf(lab, ShadowMapTechnique::NOTHING, 16);
    const Picture coarse = pictureOf(lab, ShadowMapTechnique::TEXELS, 16),
                  fine = pictureOf(lab, ShadowMapTechnique::TEXELS, 8192);
    const std::uint32_t ground = plain.at(lab.view.width / 2, lab.view.height / 8);
    int red = 0, others = 0, both = 0;
    for (int y = 0; y < lab.view.height; ++y)
        for (int x = 0; x < lab.view.width; ++x) {
            if (plain.at(x, y) != ground || coarse.at(x, y) == ground || fine.at(x, y) == ground)
                continue; // no ground, or one map's reserve
            const auto atCoarse = laidOver(plain.at(x, y), coarse.at(x, y));
            const auto atFine = laidOver(plain.at(x, y), fine.at(x, y));
            ++both;
            red += atCoarse[0] > 100 && atCoarse[2] < 60;
            others += atFine[0] < 60; // green has 51, yellow more
        }
    EXPECT_GT(both, 1000);
    EXPECT_GE(red, both * 95 / 100); // seams of the chequerboard's derivatives
    EXPECT_GE(others, both * 95 / 100);
}

TEST(MapDebugView, OfMapsShowsThemInTheCornerAndLeavesTheRestAlone) {
    const TracedCase lab = test::labEight();
    const Picture plain = pictureOf(lab, ShadowMapTechnique::NOTHING, 256),
                  shown = pictureOf(lab, ShadowMapTechnique::MAP, 256);
    const int side = lab.view.height / 3;
    int within = 0, outside = 0, empty = 0, things = 0;
    for (int y = 0; y < lab.view.height; ++y)
        for (int x = 0; x < lab.view.width; ++x) {
            const bool differs = shown.at(x, y) != plain.at(x, y), framed = x < side && y < side;
            within += framed && differs;
            outside += !framed && differs;
            const std::uint32_t color = shown.at(x, y);
            if (!framed) continue;
            empty += channel(color, 2) > 2 * channel(color, 0);
            things += channel(color, 0) == channel(color, 1) && channel(color, 1) == channel(color, 2);
        }
    EXPECT_EQ(outside, 0);
    EXPECT_GE(within, side * side * 95 / 100);
    EXPECT_GT(empty, side * side / 10);
    EXPECT_GT(things, side * side / 10);
    EXPECT_EQ(empty + things, side * side);
}
