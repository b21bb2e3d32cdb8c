// SPDX-License-Identifier: MIT
// Several relit lights: each pixel is that of one of 2ⁿ renders without Gnomon, in which some of the n lights are dark.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

using namespace test;

namespace {

const std::vector<osg::Vec4d> suns = {{1.0, 0.0, 1.0, 0.0}, {-1.0, 0.5, 1.0, 0.0}, {0.3, -1.0, 1.2, 0.0}};
const std::vector<Mesh> casters = {box({-1.0, -1.0, 0.5}, {1.0, 1.0, 1.5}), sphere({2.0, 2.0, 1.5}, 0.8, 12)};
const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 200, 150);

/// @param dark  bit i: light i without its diffuse.
Scene build(int lights, unsigned dark) {
    Scene scene = groundScene(casters, 8.0, suns[0]);
    const auto diffuse = [dark](int i) {
        const float share = dark & (1u << i) ? 0.0f : 0.25f;
        return osg::Vec4(share, i == 1 ? share : share / 2.0f, i == 2 ? share : share / 3.0f, 1.0f);
    };
    scene.light->getLight()->setDiffuse(diffuse(0));
    for (int i = 1; i < lights; ++i) {
        osg::ref_ptr<osg::LightSource> light = new osg::LightSource;
        light->getLight()->setLightNum(i);
        light->getLight()->setPosition(osg::Vec4(suns[static_cast<std::size_t>(i)]));
        light->getLight()->setAmbient({0.05f, 0.0f, 0.0f, 1.0f});
        light->getLight()->setDiffuse(diffuse(i));
        light->getLight()->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
        scene.root->addChild(light);
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0 + static_cast<unsigned>(i), osg::StateAttribute::ON);
    }
    return scene;
}

/// Lights, whether the receiver is named, reserved stencil bits.
class SeveralLights : public testing::TestWithParam<std::tuple<int, bool, unsigned>> {};

} // namespace

TEST_P(SeveralLights, EachPixelLosesJustTheLightsThatItsRaysMiss) {
    const auto [lights, named, reserved] = GetParam();
    std::vector<Picture> renders;
    for (unsigned dark = 0; dark < (1u << lights); ++dark) renders.push_back(render(build(lights, dark).root, view));
    std::vector<Mask> masks;
    for (int i = 0; i < lights; ++i)
        masks.push_back(castRays(square(8.0), casters, suns[static_cast<std::size_t>(i)], view));
    Scene scene = build(lights, 0);
    scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
    test::reserving(scene.root, reserved);
    Camera camera(scene.root, view);
    camera.frame();
    const Picture actual = camera.frame();
    int wrong = 0;
    std::vector<int> seen(1u << lights, 0);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            unsigned dark = 0;
            bool edge = false;
            for (int i = 0; i < lights; ++i) {
                const Mask& mask = masks[static_cast<std::size_t>(i)];
                if (mask.at(x, y) == Seen::ShadowedReceiver) dark |= 1u << i;
                edge = edge || mask.atEdge(x, y);
            }
            ++seen[dark];
            wrong += !edge && actual.at(x, y) != renders[dark].at(x, y);
        }
    EXPECT_EQ(wrong, 0);
    for (const int count : seen) EXPECT_GT(count, 0) << "some combination of shadows does not occur";
    const osg::ref_ptr<osg::Image> stencil = camera.context().stencil();
    EXPECT_TRUE(
        std::all_of(stencil->data(), stencil->data() + stencil->getTotalSizeInBytes(), [](auto v) { return v == 0; }));
}

INSTANTIATE_TEST_SUITE_P(Planar, SeveralLights,
                         testing::Combine(testing::Values(1, 2, 3), testing::Bool(),
                                          testing::Values(0x00u, 0xc0u, 0xf0u, 0xf8u, 0xfcu)));
