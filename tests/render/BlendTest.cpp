// SPDX-License-Identifier: MIT
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace test;

namespace {

const View slanted = perspective({-10.0, -14.0, 12.0}, {0.0, 0.0, 0.0});
const std::vector<Mesh> twoCasters = {house({-2.0, 1.0}, {2.0, 2.0, 2.0}, 30.0), sphere({3.0, 2.0, 3.0}, 1.0, 24)};

Scene blended(bool named, float dark) {
    Scene scene = groundScene(twoCasters);
    scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
    scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    scene.group->setDark(dark);
    return scene;
}

/// The picture with each channel multiplied by `factor`, rounded as OpenGL rounds; alpha stays.
Picture multiplied(Picture picture, double factor) {
    for (std::uint32_t& pixel : picture.pixels) {
        std::uint32_t result = pixel & 0xff000000u;
        for (int shift = 0; shift < 24; shift += 8)
            result |= static_cast<std::uint32_t>(std::lround(((pixel >> shift) & 0xffu) * factor)) << shift;
        pixel = result;
    }
    return picture;
}

class Blend : public testing::TestWithParam<bool> {};

} // namespace

TEST_P(Blend, ShadowedPixelsAreMultipliedByTheFactorOnceAndLitOnesKeepEveryBit) {
    const Picture lit = render(groundScene(twoCasters).root, slanted);
    const Mask mask = castRays(square(8.0), twoCasters, {1.0, 0.0, 1.0, 0.0}, slanted);
    for (const float dark : {0.0f, 0.2f, 0.4f}) { // factors that bytes of 228, 165 and 102 take without a half to round
        const Picture actual = render(blended(GetParam(), dark).root, slanted);
        const Comparison found = compare(actual, lit, multiplied(lit, dark), mask);
        EXPECT_EQ(found.wrongInside + found.wrongAtEdge, 0) << dark;
        EXPECT_LE(found.flipped, found.edges / 50) << dark;
    }
}

TEST_P(Blend, FactorOneChangesNothing) {
    EXPECT_EQ(render(blended(GetParam(), 1.0f).root, slanted).different(render(groundScene(twoCasters).root, slanted)),
              0);
}

INSTANTIATE_TEST_SUITE_P(Planar, Blend, testing::Bool(),
                         [](const auto& named) { return named.param ? "NamedReceiver" : "Unnamed"; });

TEST(Blend, FactorIsClampedAndNaNIsRefused) {
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    EXPECT_EQ(group->getDark(), 0.5f);
    group->setDark(2.0f);
    EXPECT_EQ(group->getDark(), 1.0f);
    group->setDark(std::nanf(""));
    EXPECT_EQ(group->getDark(), 1.0f);
    group->setDark(-1.0f);
    EXPECT_EQ(group->getDark(), 0.0f);
}
