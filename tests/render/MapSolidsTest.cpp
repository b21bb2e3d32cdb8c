// SPDX-License-Identifier: MIT
// Maps drawn again leave out the faces of solids that are turned away from the light: what they show stays the same.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <algorithm>

using gnomon::ShadowMapTechnique;
using test::Camera;
using test::Picture;
using test::Scene;

namespace {

const osg::Vec4d elsewhere(1.0, 2.0, 5.0, 0.0);

Scene build(const std::vector<test::Mesh>& casters, const osg::Vec4d& light, ShadowMapTechnique::View view,
            int size = 1024) {
    Scene scene = test::groundScene(casters, 8.0, light);
    osg::ref_ptr<osg::MatrixTransform> mirror = new osg::MatrixTransform(osg::Matrix::scale(-1.0, 1.0, 1.0));
    mirror->addChild(test::node(test::box({1.0, -5.0, 0.0}, {2.0, -3.0, 1.5}))); // its faces look inwards
    scene.content->addChild(mirror);
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(size);
    technique->setView(view);
    scene.addShadow(technique);
    return scene;
}

/// The frame of a light once the map has been drawn for others.
Picture drawnAgain(Scene scene, const test::View& view) {
    osg::Light& light = *scene.light->getLight();
    const osg::Vec4 meant = light.getPosition();
    Camera camera(scene.root, view);
    light.setPosition(osg::Vec4(elsewhere));
    for (int frame = 0; frame < 2; ++frame) {
        camera.frame();
        light.setPosition(light.getPosition() + osg::Vec4(0.1f, 0.0f, 0.0f, 0.0f));
    }
    light.setPosition(meant);
    return camera.frame();
}

const test::View aside = test::perspective({-9.0, -12.0, 9.0}, {0.0, 0.0, 0.0}, 320, 240);

/// In a map drawn first all faces are. @param texels  that may be others in a picture of the map.
void expectTheSameDrawnAgain(const std::vector<test::Mesh>& casters, const std::vector<osg::Vec4d>& lights,
                             int texels) {
    const int size = 256; // fewer than are of use for any of the lights: all maps have as many
    for (const osg::Vec4d& light : lights)
        for (const auto view : {ShadowMapTechnique::NOTHING, ShadowMapTechnique::MAP})
            EXPECT_LE(drawnAgain(build(casters, light, view, size), aside)
                          .different(test::render(build(casters, light, view, size).root, aside)),
                      view == ShadowMapTechnique::MAP ? texels : 0)
                << light.x() << ", " << light.y() << ", " << light.z() << ", view " << view;
}

/// Pixels that the lamp's light reaches once the map is drawn again.
int differentFromDark(const std::vector<test::Mesh>& casters, const osg::Vec4d& lamp) {
    Scene dark = build(casters, lamp, ShadowMapTechnique::NOTHING);
    dark.takeLightAway();
    return drawnAgain(build(casters, lamp, ShadowMapTechnique::NOTHING), aside)
        .different(test::render(dark.root, aside));
}

/// A mesh without the faces that lie where a coordinate has one value.
test::Mesh without(const test::Mesh& mesh, int axis, double level) {
    test::Mesh result;
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3)
        if (!std::all_of(&mesh[i], &mesh[i] + 3, [&](const auto& corner) { return corner[axis] == level; }))
            result.insert(result.end(), &mesh[i], &mesh[i] + 3);
    return result;
}

} // namespace

// Solids; one inside out and an open quad, whose backs are turned to the sun; two that stand in one another. In the map itself
// the nearest face is seen, whichever are drawn; where faces meet a texel may show either.
TEST(MapSolids, LookTheSameWhenTheirBacksAreLeftOut) {
    const std::vector<test::Mesh> casters{test::sphere({0.0, 0.0, 1.5}, 1.0),
                                          test::insideOut(test::box({2.0, 2.0, 0.0}, {3.0, 3.0, 2.0})),
                                          test::quad({-4.0, 2.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 1.0, 2.0}),
                                          test::quad({-4.0, -2.0, 3.0}, {0.0, 1.0, 0.0}, {2.0, 0.0, 0.0}),
                                          test::box({-3.0, -5.0, 0.0}, {-2.0, -4.0, 2.0}),
                                          test::box({-2.5, -4.5, -1.0}, {-1.0, -3.5, 1.0})};
    const std::vector<osg::Vec4d> lights{{1.0, 0.5, 1.0, 0.0}, {-1.0, 0.2, 0.4, 0.0}, {1.0, 0.0, 5.0, 1.0}};
    expectTheSameDrawnAgain(casters, lights, 5);
}

// A chimney without ends, a bottle without its bottom, and both turned inside out: the sun shines through the first, into the
// second, and from where it sees no hole; and a lamp stands over the chimney, under the bottle, and in the chimney. Rows of
// texels where faces meet are longer than above.
TEST(MapSolids, WithHolesLookTheSameDrawnAgain) {
    const test::Mesh chimney = without(without(test::box({-0.5, -0.5, 0.2}, {0.5, 0.5, 4.2}), 2, 0.2), 2, 4.2),
                     bottle = without(test::box({2.0, -0.5, 1.0}, {5.0, 0.5, 2.0}), 0, 5.0);
    ASSERT_EQ(chimney.size(), 24u);
    ASSERT_EQ(bottle.size(), 30u);
    const std::vector<osg::Vec4d> lights{{0.0, 0.0, 1.0, 0.0},  {0.05, 0.02, 1.0, 0.0}, {1.0, 0.1, 0.4, 0.0},
                                         {-1.0, 0.3, 0.5, 0.0}, {0.1, 0.0, 7.0, 1.0},   {7.0, 0.0, 1.5, 1.0},
                                         {0.1, 0.0, 2.0, 1.0}};
    expectTheSameDrawnAgain({chimney, bottle}, lights, 20);
    expectTheSameDrawnAgain({test::insideOut(chimney), test::insideOut(bottle)}, lights, 20);
}

// The sides of a box as six drawables make one solid together, with the lamp in it. Where they
// meet, a texel may reach past them; with light anywhere else thousands of pixels differ.
TEST(MapSolids, OfManyDrawablesHoldTheLightOfALampInsideToo) {
    const std::vector<test::Mesh> sides{test::quad({-1.0, -1.0, 1.0}, {0.0, 2.0, 0.0}, {2.0, 0.0, 0.0}),
                                        test::quad({-1.0, -1.0, 3.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}),
                                        test::quad({-1.0, -1.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0}),
                                        test::quad({-1.0, 1.0, 1.0}, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0}),
                                        test::quad({-1.0, -1.0, 1.0}, {0.0, 0.0, 2.0}, {0.0, 2.0, 0.0}),
                                        test::quad({1.0, -1.0, 1.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 2.0})};
    EXPECT_LE(differentFromDark(sides, {0.2, 0.1, 2.0, 1.0}), 3);
}

// A lamp in a closed box sees nothing but backs.
TEST(MapSolids, HoldTheLightOfALampInside) {
    const std::vector<test::Mesh> closed{test::box({-1.0, -1.0, 1.0}, {1.0, 1.0, 3.0})};
    EXPECT_EQ(differentFromDark(closed, {0.0, 0.0, 2.0, 1.0}), 0);
}
