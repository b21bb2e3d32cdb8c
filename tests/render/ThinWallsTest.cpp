// SPDX-License-Identifier: MIT
// Where a thin wall stands on the floor, no light gets through by the joint, whose pixels are of two surfaces.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>

using test::Mask;
using test::Picture;
using test::Scene;
using test::Seen;

namespace {

const osg::Vec4d sun(-0.5, 1.0, 0.6, 0.0); // behind the walls, as the eye has them

/// Two walls on a floor.
std::vector<test::Mesh> wallsOf(double thick) {
    return {test::box({-3.0, 0.0, 0.0}, {3.0, thick, 2.0}), test::box({-3.0, -3.0, 0.0}, {-3.0 + thick, 0.0, 2.0})};
}

/// True if all that is seen about a pixel is wall or floor in shadow.
bool isWithinShadow(const Mask& mask, int x, int y) {
    for (int v = y - 2; v <= y + 2; ++v)
        for (int u = x - 2; u <= x + 2; ++u) {
            if (u < 0 || v < 0 || u >= mask.width || v >= mask.height) return false;
            if (mask.at(u, v) != Seen::ShadowedReceiver && mask.at(u, v) != Seen::Caster) return false;
        }
    return true;
}

/// Pixels of the floor beside a wall that are lit though all about them is in shadow.
template <class Technique>
int litAtJoints(double thick, const test::View& view) {
    const std::vector<test::Mesh> walls = wallsOf(thick);
    Scene scene = test::groundScene(walls, 8.0, sun), dark = test::groundScene(walls, 8.0, sun);
    dark.takeLightAway();
    scene.addShadow(new Technique);
    const Picture shown = test::render(scene.root, view), wanted = test::render(dark.root, view);
    const Mask mask = test::castRays(test::square(8.0), walls, sun, view);
    int lit = 0, joint = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (mask.at(x, y) != Seen::ShadowedReceiver || !mask.atEdge(x, y) || !isWithinShadow(mask, x, y)) continue;
            ++joint;
            lit += shown.at(x, y) != wanted.at(x, y);
        }
    EXPECT_GT(joint, 50);
    return lit;
}

/// Of a wall's outside, as many texels are lit as it is thick: in a map, where that is less than two, they may miss it.
TEST(ThinWalls, LetNoLightThroughWhereTheyStandOnTheFloor) {
    for (const double height : {1.0, 2.5, 5.0}) {
        const test::View view = test::perspective({1.0, -7.0, height}, {0.0, 0.0, 0.5}, 200, 150);
        EXPECT_EQ(litAtJoints<gnomon::TracedShadowTechnique>(0.04, view), 0) << "traced, from " << height;
        EXPECT_EQ(litAtJoints<gnomon::ShadowMapTechnique>(0.2, view), 0) << "map, from " << height;
    }
}

} // namespace
