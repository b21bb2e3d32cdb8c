// SPDX-License-Identifier: MIT
// Shadow volumes where they break: lamps on casters and in them, eyes in shadow, bad meshes, many layers.
#include "VolumeTrial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

using test::expectFloor;
using test::Mesh;
using test::TracedCase;

namespace {

const test::View slanted = test::perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.3}, 160, 120);

TracedCase onGround(const char* name, const std::vector<Mesh>& casters, const osg::Vec4d& light,
                    const test::View& view = slanted) {
    TracedCase given{name, {test::square(6.0)}, light, view};
    given.meshes.insert(given.meshes.end(), casters.begin(), casters.end());
    return given;
}

Mesh without(Mesh mesh, std::size_t first, std::size_t triangles) {
    mesh.erase(mesh.begin() + std::ptrdiff_t(3 * first), mesh.begin() + std::ptrdiff_t(3 * (first + triangles)));
    return mesh;
}

Mesh turned(Mesh mesh, std::size_t every) {
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3 * every) std::swap(mesh[i + 1], mesh[i + 2]);
    return mesh;
}

Mesh twice(const Mesh& mesh) { return test::joined({mesh, mesh}); }

/// Triangles without an area, at corners and along edges.
Mesh withNeedles(Mesh mesh) {
    const std::size_t count = mesh.size();
    for (std::size_t i = 0; i < count; i += 3) {
        mesh.insert(mesh.end(), {mesh[i], mesh[i], mesh[i + 1]});
        mesh.insert(mesh.end(), {mesh[i], mesh[i + 1], (mesh[i] + mesh[i + 1]) / 2.0});
    }
    return mesh;
}

/// Each triangle in two, by the middle of its longest side: the neighbours' long sides pass new vertices by.
Mesh withJunctions(const Mesh& mesh, std::size_t every) {
    Mesh result;
    for (std::size_t i = 0; i < mesh.size(); i += 3) {
        std::array<glm::dvec3, 3> t{mesh[i], mesh[i + 1], mesh[i + 2]};
        if (i / 3 % every) {
            result.insert(result.end(), t.begin(), t.end());
            continue;
        }
        while (glm::distance(t[0], t[1]) < std::max(glm::distance(t[1], t[2]), glm::distance(t[2], t[0])))
            std::rotate(t.begin(), t.begin() + 1, t.end());
        const glm::dvec3 middle = 0.37 * t[0] + 0.63 * t[1];
        result.insert(result.end(), {t[0], middle, t[2], middle, t[1], t[2]});
    }
    return result;
}

/// Three sheets on one edge, as no surface has them.
Mesh fins() {
    const glm::dvec3 low(0.0), up(0.0, 0.0, 1.2);
    return test::joined({test::quad(low, {0.8, 0.2, 0.0}, up), test::quad(low, {-0.6, 0.5, 0.0}, up),
                         test::quad(low, {-0.1, -0.8, 0.0}, up)});
}

/// One of each fault, on a ground.
std::vector<Mesh> badMeshes() {
    const Mesh house = test::house({0.0, 0.0}, {1.1, 0.9, 1.0}, 25.0), ball = test::sphere({0.0, 0.0, 0.7}, 0.6, 12);
    const std::vector<Mesh> all{
        without(ball, 20, 30),   turned(house, 3),       turned(ball, 2),      twice(house), withNeedles(house), fins(),
        withJunctions(house, 2), withJunctions(ball, 3), test::insideOut(ball)};
    std::vector<Mesh> placed;
    for (std::size_t i = 0; i < all.size(); ++i)
        placed.push_back(test::moved(all[i], {3.0 * double(i % 3) - 3.0, 3.0 * double(i / 3) - 3.0, 0.01}));
    return placed;
}

TEST(VolumeMeshes, OfAnyFaultCastTheirShadow) {
    const test::View view = test::perspective({-6.0, -11.0, 10.0}, {0.3, 0.3, 0.0}, 320, 240);
    expectFloor(onGround("bad meshes, sun", badMeshes(), {0.8, 0.5, 1.0, 0.0}, view));
    expectFloor(onGround("bad meshes, low sun", badMeshes(), test::sunAt(200.0, 20.0), view));
    expectFloor(onGround("bad meshes, lamp", badMeshes(), {0.4, -0.3, 3.0, 1.0}, view));
}

TEST(VolumeMeshes, OfThreeHundredShellsAreCountedWithoutOverflow) {
    std::vector<Mesh> shells;
    for (int i = 1; i <= 300; ++i) {
        const double half = 0.7 + 0.002 * i;
        shells.push_back(test::box({-half, -half, 1.4 - half}, {half, half, 1.4 + half}));
    }
    expectFloor(onGround("shells", shells, {0.8, 0.5, 1.0, 0.0}));
}

TEST(VolumeLights, OnAVertexInAFacesPlaneAndInACasterAreRight) {
    const Mesh block = test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}),
               post = test::box({2.0, -0.5, 0.0}, {2.5, 0.5, 1.0});
    expectFloor(onGround("above a vertex", {block, post}, {1.0, 1.0, 2.0 + 1e-4, 1.0}));
    expectFloor(onGround("in a face's plane", {block, post}, {3.5, 1.0, 3.0, 1.0}));
    expectFloor(onGround("in an edge's line", {block, post}, {1.0, 1.0, 3.5, 1.0}));
    expectFloor(onGround("sun along a face", {block, post}, {1.0, 0.0, 1.0, 0.0}));
    const Mesh cage = test::box({-3.0, -3.0, -0.5}, {3.0, 3.0, 3.5});
    expectFloor(onGround("in a closed caster", {cage, test::box({0.8, -0.4, 0.0}, {1.2, 0.4, 1.5})},
                         {0.0, 0.0, 3.0, 1.0},
                         test::perspective({0.5, -2.8, 2.8}, {1.5, 0.3, 0.0}, 160, 120, 60.0, 0.1, 20.0)));
}

TEST(VolumeViews, FromShadowAndThroughCutCastersAreRight) {
    const Mesh block = test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}),
               post = test::box({2.0, -0.5, 0.0}, {2.5, 0.5, 1.0});
    const osg::Vec4d sun(-1.0, 0.2, 1.0, 0.0);
    expectFloor(onGround("eye in the shadow", {block, post}, sun,
                         test::perspective({1.3, 0.0, 0.8}, {3.0, 1.0, 0.0}, 160, 120, 70.0, 0.05, 40.0)));
    expectFloor(onGround(
        "eye in a caster", {test::insideOut(test::box({-4.0, -4.0, -1.0}, {4.0, 4.0, 5.0})), block, post},
        {-2.0, 0.5, 4.0, 1.0}, test::perspective({-3.0, -3.0, 3.0}, {1.0, 0.0, 0.0}, 160, 120, 70.0, 0.05, 40.0)));
    expectFloor(onGround("near plane through a caster", {block, post}, sun,
                         test::perspective({0.0, -3.0, 1.6}, {0.4, 0.0, 0.8}, 160, 120, 80.0, 2.6, 40.0)),
                200);
    test::View orthographic = slanted;
    orthographic.projection = osg::Matrixd::ortho(-5.0, 5.0, -3.75, 3.75, 1.0, 40.0);
    expectFloor(onGround("orthographic", {block, post}, sun, orthographic));
}

} // namespace
