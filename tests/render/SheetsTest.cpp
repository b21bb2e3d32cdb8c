// SPDX-License-Identifier: MIT
// Single sheets seen from behind, the light before them: OpenGL lights both sides alike, and a sheet does not shadow itself.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>

#include <algorithm>

using gnomon::ShadowCasterGroup;
using test::Picture;
using test::Scene;
using test::View;

namespace {

const test::Mesh inside = test::insideOut(test::box({-4.0, -4.0, 0.0}, {4.0, 4.0, 3.0}));
const osg::Vec4d lamp(0.5, 0.7, 2.0, 1.0);

/// Walls and roof of a room, from outside.
View fromOutside(double near) { return test::perspective({-9.0, -13.0, 8.0}, {0.0, 0.0, 1.0}, 160, 120, 40.0, near); }

Scene sceneOf(const test::Mesh& mesh, gnomon::ShadowTechnique* technique) {
    Scene scene = test::scene(lamp);
    scene.content->addChild(test::node(mesh));
    if (technique) scene.addShadow(technique);
    if (technique) scene.group->setComposite(ShadowCasterGroup::BLEND); // which shows on what is unlit, too
    return scene;
}

Picture pictureOf(const test::Mesh& mesh, double near, gnomon::ShadowTechnique* technique) {
    return test::render(sceneOf(mesh, technique).root, fromOutside(near));
}

/// Pixels that differ, further than `reach` from where two faces of a box or its outline meet.
int differentAwayFromEdges(const Picture& a, const Picture& b, const test::Mesh& box, int reach) {
    std::vector<test::Mask> faces;
    for (auto face = box.begin(); face != box.end(); face += 6) {
        test::Mesh others(box.begin(), face);
        others.insert(others.end(), face + 6, box.end());
        faces.push_back(test::castRays(test::Mesh(face, face + 6), {others}, {0.0, 0.0, 1.0, 0.0}, fromOutside(1.0)));
        for (test::Seen& seen : faces.back().pixels) // whether it is lit does not matter
            if (seen == test::Seen::ShadowedReceiver) seen = test::Seen::LitReceiver;
    }
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const auto atEdge = [&](const test::Mask& mask) { return mask.atEdge(x, y, reach); };
            count += a.at(x, y) != b.at(x, y) && std::none_of(faces.begin(), faces.end(), atEdge);
        }
    return count;
}

TEST(Sheets, SeenFromBehindDoNotShadowThemselves) {
    for (const double near : {1.0, 0.01}) { // whose depths are coarse
        const Picture lit = pictureOf(inside, near, nullptr);
        const Picture traced = pictureOf(inside, near, new gnomon::TracedShadowTechnique),
                      mapped = pictureOf(inside, near, new gnomon::ShadowMapTechnique),
                      volume = pictureOf(inside, near, new gnomon::ShadowVolumeTechnique);
        EXPECT_EQ(differentAwayFromEdges(traced, lit, inside, 1), 0) << near;
        EXPECT_EQ(differentAwayFromEdges(volume, lit, inside, 1), 0) << near;
        EXPECT_EQ(differentAwayFromEdges(mapped, lit, inside, 2), 0) << near; // a texel is less than a pixel
    }
}

/// The same room with walls of 0.1: their outer faces are seen from before, and face away from the lamp.
TEST(Sheets, OfTwoFacesTheOuterOneIsInShadow) {
    const test::Mesh outside = test::box({-4.1, -4.1, -0.1}, {4.1, 4.1, 3.1});
    test::Mesh room = inside;
    room.insert(room.end(), outside.begin(), outside.end());
    const Picture lit = pictureOf(room, 1.0, nullptr), traced = pictureOf(room, 1.0, new gnomon::TracedShadowTechnique),
                  mapped = pictureOf(room, 1.0, new gnomon::ShadowMapTechnique),
                  volume = pictureOf(room, 1.0, new gnomon::ShadowVolumeTechnique);
    Picture dark = lit; // half as bright where anything is seen
    for (std::uint32_t& pixel : dark.pixels)
        if (pixel != lit.at(0, 0)) pixel = test::grey(((pixel & 0xffu) + 1u) / 2u);
    EXPECT_GT(dark.different(lit), 3000);
    EXPECT_EQ(differentAwayFromEdges(traced, dark, outside, 1), 0);
    EXPECT_EQ(differentAwayFromEdges(volume, dark, outside, 1), 0);
    EXPECT_EQ(differentAwayFromEdges(mapped, dark, outside, 2), 0);
}

} // namespace
