// SPDX-License-Identifier: MIT
// A technique by public headers alone, that of examples/owntechnique: its shadow is the share that it says.
#include "../../examples/owntechnique/BlobShadow.h"

#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowCasterGroup.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace test;

namespace {

constexpr int size = 128;
constexpr double half = 4.0; // of what is seen, from straight above

/// A ball of radius 1, as the box about it, 2 above the ground; what arrives at the ground's (x, y) from (1, 0, 1).
double arrivesAt(double x, double y) {
    const double across = std::hypot((x + 2.0) * std::sqrt(0.5), y); // of the ray by the middle
    const double t = std::min(std::max(2.0 * across - 1.0, 0.0), 1.0);
    return t * t * (3.0 - 2.0 * t);
}

class OwnTechnique : public testing::TestWithParam<gnomon::ShadowCasterGroup::Composite> {};

} // namespace

TEST_P(OwnTechnique, ByPublicHeadersTakesTheShareOfTheLightThatItSays) {
    Scene lit = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 3.0})});
    Scene shadowed = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 3.0})});
    osg::ref_ptr<BlobShadow> blobs = new BlobShadow;
    shadowed.addShadow(blobs);
    shadowed.group->setCasters({shadowed.content->getChild(1)});
    shadowed.group->setComposite(GetParam());
    const View view = fromAbove(half, size);
    const Picture bare = render(lit.root, view), picture = render(shadowed.root, view);
    const bool relights = GetParam() == gnomon::ShadowCasterGroup::RELIGHT;
    const double dark = relights ? shadowedGround : shadowed.group->getDark() * litGround;
    int shaded = 0;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const double x = (column + 0.5) * 2.0 * half / size - half, y = (row + 0.5) * 2.0 * half / size - half;
            if (std::abs(x) < 1.2 && std::abs(y) < 1.2) continue; // the box, and pixels beside it
            const double arrives = arrivesAt(x, y);
            shaded += arrives > 0.1 && arrives < 0.9;
            const std::size_t at = std::size_t(row) * size + std::size_t(column);
            ASSERT_EQ(bare.pixels[at] & 0xffu, litGround);
            // Two steps of eight bits: of the share in alpha, and of the colours that are mixed.
            ASSERT_NEAR(double(picture.pixels[at] & 0xffu), dark + arrives * (litGround - dark), 2.0) << x << " " << y;
        }
    EXPECT_GT(shaded, 300);
    EXPECT_EQ(blobs->diagnose(), std::vector<std::string>());
}

INSTANTIATE_TEST_SUITE_P(Composites, OwnTechnique,
                         testing::Values(gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND));
