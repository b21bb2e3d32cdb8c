// SPDX-License-Identifier: MIT
// Each cure of planar shadows, switched off, shows its classic fault; switched on again, nothing is left of it.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace test;
using gnomon::PlanarShadowNode;
using gnomon::ShadowCasterGroup;

namespace {

using Switch = void (PlanarShadowNode::*)(bool);

struct Cure {
    const char* name;
    Switch set;
};
const std::vector<Cure> cures = {{"stencil", &PlanarShadowNode::setStencilCure},
                                 {"offset", &PlanarShadowNode::setOffsetCure},
                                 {"clip", &PlanarShadowNode::setClipCure}};

const osg::Vec4d sun(1.0, 0.0, 1.0, 0.0); // at 45°: shadows lie a height further to -x
const View above = fromAbove(4.0);        // 32 pixels a metre

/// A running camera on a scene whose technique can be changed between frames.
struct Watched {
    Watched(const std::vector<Mesh>& casters, const View& view, bool named, double half = 8.0,
            const osg::Vec4d& light = sun)
        : scene(groundScene(casters, half, light)),
          plain(render(scene.root, view)),
          technique(planar(named ? find(*scene.root, "ground") : nullptr)) {
        scene.addShadow(technique);
        camera = std::make_unique<Camera>(scene.root, view);
    }
    Picture frame() { return camera->frame(); }

    Scene scene;
    Picture plain; ///< without shadow
    osg::ref_ptr<PlanarShadowNode> technique;
    std::unique_ptr<Camera> camera;
};

class PlanarCures : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Planar, PlanarCures, testing::Bool(),
                         [](const auto& named) { return named.param ? "NamedReceiver" : "Unnamed"; });

/// Squares of side 1 whose shadows are x = -1.5 … -0.5 and -1.25 … -0.25, of which the first square hides x > -0.5.
const std::vector<Mesh> twoSquares = {square(0.5, 1.0), moved(square(0.5, 2.0), {1.25, 0.0, 0.0})};

} // namespace

TEST_P(PlanarCures, WithoutStencilAPixelUnderTwoTrianglesDarkensTwice) {
    for (const auto composite : {ShadowCasterGroup::RELIGHT, ShadowCasterGroup::BLEND}) {
        Watched watched(twoSquares, above, GetParam());
        watched.scene.group->setComposite(composite);
        watched.technique->setStencilCure(false);
        const Picture picture = watched.frame();
        EXPECT_EQ(picture.count(litGround / 4), 24 * 32) << "overlap";
        EXPECT_EQ(picture.count(litGround / 2), 8 * 32) << "under one square alone";
        EXPECT_EQ(picture.count(litGround), 256 * 256 - 32 * 32);
    }
}

TEST_P(PlanarCures, WithoutStencilTheFactorIsTheGroups) {
    Watched watched({square(0.5, 1.0)}, above, GetParam());
    watched.technique->setStencilCure(false);
    watched.scene.group->setDark(0.25f);
    EXPECT_EQ(watched.frame().count(litGround / 4), 32 * 32);
}

// Each ray goes into the box and out of it; from the second frame on solids are known, of which one half could be culled.
TEST_P(PlanarCures, WithoutStencilABoxDarkensTwiceInEveryFrame) {
    Watched watched({box({-0.5, -0.5, 1.0}, {0.5, 0.5, 2.0})}, above, GetParam());
    watched.technique->setStencilCure(false);
    const Picture first = watched.frame();
    EXPECT_EQ(first.count(litGround / 4), 64 * 32); // x = -2.5 … -0.5
    for (int i = 0; i < 3; ++i) EXPECT_EQ(watched.frame().different(first), 0);
}

// The ground ends at x = -1.25: of the shadow of the first square a quarter metre would lie beyond.
TEST_P(PlanarCures, WithoutStencilTheShadowStillEndsAtTheReceiversEdge) {
    Watched watched({square(0.5, 1.0)}, above, GetParam(), 1.25);
    watched.technique->setStencilCure(false);
    const Picture picture = watched.frame();
    EXPECT_EQ(picture.count(litGround / 2), 24 * 32);
    EXPECT_EQ(picture.different(watched.plain), 24 * 32);
}

TEST_P(PlanarCures, WithoutOffsetTheShadowFightsTheReceiverForEachPixel) {
    const View slanted = perspective({-6.0, -9.0, 7.0}, {0.0, 0.0, 0.0});
    for (const auto composite : {ShadowCasterGroup::RELIGHT, ShadowCasterGroup::BLEND}) {
        Watched watched({box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0})}, slanted, GetParam());
        watched.scene.group->setComposite(composite);
        const Picture cured = watched.frame();
        watched.technique->setOffsetCure(false);
        const Picture fought = watched.frame();
        int lit = 0, dark = 0, other = 0;
        for (std::size_t i = 0; i < cured.pixels.size(); ++i) {
            const bool isLit = fought.pixels[i] == watched.plain.pixels[i];
            other += !isLit && fought.pixels[i] != cured.pixels[i];
            lit += isLit && cured.pixels[i] != watched.plain.pixels[i];
            dark += !isLit && fought.pixels[i] == cured.pixels[i];
        }
        EXPECT_EQ(other, 0) << "pixels that are neither lit nor as in the shadow";
        EXPECT_EQ(lit + dark, cured.different(watched.plain));
        EXPECT_GT(lit, (lit + dark) / 20) << "of " << lit + dark;
        EXPECT_GT(dark, (lit + dark) / 20) << "of " << lit + dark;
    }
}

// A square 1 m under the ground: the line through it and the sun meets the ground 1 m towards the sun.
TEST_P(PlanarCures, WithoutClipWhatLiesUnderThePlaneThrowsAnAntiShadow) {
    Watched watched({square(0.5, -1.0)}, above, GetParam());
    EXPECT_EQ(watched.frame().different(watched.plain), 0);
    watched.technique->setClipCure(false);
    const Picture picture = watched.frame();
    EXPECT_EQ(picture.different(watched.plain), 32 * 32);
    EXPECT_EQ(picture.at(128 + 32, 128), grey(shadowedGround)); // (1, 0)
}

// A lamp at 1 m, a square at 2 m and x = 1: through the lamp it lands upside down at x = -1.
TEST_P(PlanarCures, WithoutClipWhatIsAboveALampThrowsAnAntiShadow) {
    Watched watched({moved(square(0.5, 2.0), {1.0, 0.0, 0.0})}, above, GetParam(), 8.0, {0.0, 0.0, 1.0, 1.0});
    EXPECT_EQ(watched.frame().different(watched.plain), 0);
    watched.technique->setClipCure(false);
    const Picture picture = watched.frame();
    EXPECT_EQ(picture.different(watched.plain), 32 * 32);
    EXPECT_NE(picture.at(128 - 32, 128), watched.plain.at(128 - 32, 128));
}

// Shadow x = -1.5 … 0.5 of what is above, anti-shadow x = -0.5 … 1.5 of what is under; the top hides -0.5 … 0.5.
TEST_P(PlanarCures, WithoutClipABoxThroughThePlaneThrowsBoth) {
    Watched watched({box({-0.5, -0.5, -1.0}, {0.5, 0.5, 1.0})}, above, GetParam());
    EXPECT_EQ(watched.frame().different(watched.plain), 32 * 32);
    watched.technique->setClipCure(false);
    EXPECT_EQ(watched.frame().different(watched.plain), 2 * 32 * 32);
}

TEST_P(PlanarCures, SwitchedOnAgainLeaveNothingOfTheirFault) {
    const View slanted = perspective({-6.0, -9.0, 7.0}, {0.0, 0.0, 0.0});
    Watched watched({box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0}), box({1.5, -0.5, -2.0}, {2.5, 0.5, -0.5})}, slanted,
                    GetParam());
    const Picture cured = watched.frame();
    for (const Cure& cure : cures) {
        (*watched.technique.*cure.set)(false);
        EXPECT_GT(watched.frame().different(cured), 0) << cure.name;
        (*watched.technique.*cure.set)(true);
        for (int i = 0; i < 2; ++i) EXPECT_EQ(watched.frame().different(cured), 0) << cure.name;
    }
}

TEST(PlanarCures, AreOnInANewNodeAndKeptByACopy) {
    const osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    EXPECT_TRUE(node->getStencilCure() && node->getOffsetCure() && node->getClipCure());
    node->setOffsetCure(false);
    const osg::ref_ptr<PlanarShadowNode> copy = new PlanarShadowNode(*node);
    EXPECT_TRUE(copy->getStencilCure() && !copy->getOffsetCure() && copy->getClipCure());
}
