// SPDX-License-Identifier: MIT
// Single sheets seen from behind, the light before them: OpenGL lights both sides alike, and a sheet does not shadow itself.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <glm/geometric.hpp>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/BlendColor>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Depth>

#include <algorithm>
#include <functional>

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

/// From below, with a box on the sheet and a sun above both. What is dark of the back is what the box shadows.
TEST(Sheets, SeenFromBehindTakeTheShadowsOfOthers) {
    const test::Mesh sheet = test::square(4.0, 1.0), box = test::box({-0.5, -0.5, 1.0}, {0.5, 0.5, 3.0});
    const osg::Vec4d sun(1.0, -0.6, 1.4, 0.0);
    const View view = test::perspective({1.0, -7.0, -6.0}, {0.0, 0.0, 1.0}, 160, 120);
    const test::Mask truth = test::castRays(sheet, {box}, sun, view);
    ASSERT_GT(truth.count(test::Seen::ShadowedReceiver), 300);
    for (const unsigned reserved : {0u, 0xf8u}) { // of three bits not more than two count
        Scene lit = test::scene(sun), scene = test::scene(sun);
        for (Scene* each : {&lit, &scene}) {
            each->content->addChild(test::node(sheet));
            each->content->addChild(test::node(box));
        }
        scene.addShadow(new gnomon::ShadowVolumeTechnique);
        scene.group->setComposite(ShadowCasterGroup::BLEND);
        test::reserving(scene.root, reserved);
        const Picture plain = test::render(lit.root, view), shadowed = test::render(scene.root, view);
        int wrong = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                if (truth.at(x, y) >= test::Seen::LitReceiver && !truth.atEdge(x, y, 1))
                    wrong += (truth.at(x, y) == test::Seen::ShadowedReceiver) != (shadowed.at(x, y) != plain.at(x, y));
        EXPECT_EQ(wrong, 0) << reserved;
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

/// The frame that ought to be, and what of it is not.
test::Comparison compared(const std::function<Scene()>& build, gnomon::ShadowTechnique* technique, const View& view,
                          const test::Mask& truth, unsigned reserved = 0) {
    Scene lit = build(), dark = build(), scene = build();
    dark.takeLightAway();
    scene.addShadow(technique);
    scene.group->setOpaqueFrom(0.5f); // which the pane has
    test::reserving(scene.root, reserved);
    test::Camera camera(scene.root, view), litCamera(lit.root, view), darkCamera(dark.root, view);
    for (test::Camera* each : {&camera, &litCamera, &darkCamera}) each->viewer().getCamera()->setCullMask(1);
    return test::compare(camera.frame(), litCamera.frame(), darkCamera.frame(), truth);
}

/// A dolls' house: the light is not the camera, so a face that the view culls blocks the sun all the same.
TEST(Sheets, WhoseBacksAreCulledKeepTheSunFromTheRoomBehindThem) {
    const osg::Vec4d sun(-0.4, -0.5, 0.75, 0.0);
    const View view = test::perspective({6.0, -11.0, 9.0}, {0.0, 0.0, 1.5}, 200, 150);
    const test::Mesh room = test::insideOut(test::box({-3.0, -3.0, 0.1}, {3.0, 3.0, 4.0})), ground = test::square(20.0),
                     thing = test::box({-0.6, -0.6, 1.0}, {0.6, 0.6, 2.0});
    test::Mesh seen = test::joined({ground, thing}); // and the walls that face the eye
    for (std::size_t i = 0; i < room.size(); i += 3) {
        const glm::dvec3 normal = glm::cross(room[i + 1] - room[i], room[i + 2] - room[i]);
        if (glm::dot(normal, glm::dvec3(6.0, -11.0, 9.0) - room[i]) > 0.0)
            seen.insert(seen.end(), room.begin() + std::ptrdiff_t(i), room.begin() + std::ptrdiff_t(i + 3));
    }
    const test::Mask truth = test::castRays(seen, {}, sun, view, {room, thing});
    ASSERT_GT(truth.count(test::Seen::ShadowedReceiver), 4000);
    const auto build = [&] {
        Scene scene = test::scene(sun);
        scene.content->addChild(test::node(ground));
        scene.content->addChild(test::node(thing));
        const osg::ref_ptr<osg::Node> walls = test::node(room);
        walls->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace);
        scene.content->addChild(walls);
        return scene;
    };
    const std::vector<osg::ref_ptr<gnomon::ShadowTechnique>> techniques{new gnomon::ShadowVolumeTechnique,
                                                                        new gnomon::TracedShadowTechnique};
    for (const auto& technique : techniques) {
        const test::Comparison found = compared(build, technique, view, truth);
        EXPECT_EQ(found.wrongInside, 0) << technique->className();
        EXPECT_LT(found.flipped, 120) << technique->className(); // along the culled walls' edges
    }
}

/// A ground, and a caster whose backs the view culls.
Scene onGround(const osg::Vec4d& light, const test::Mesh& ground, const test::Mesh& caster) {
    Scene scene = test::scene(light);
    scene.content->addChild(test::node(ground));
    const osg::ref_ptr<osg::Node> node = test::node(caster);
    node->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace);
    scene.content->addChild(node);
    return scene;
}

/// A bowl's underside close above the ground, seen from above: nearer to that than a pixel of the ground is long.
TEST(Sheets, WhoseBacksAreCulledShadowWhatLiesCloseBehindThem) {
    const osg::Vec4d sun(0.3, -1.0, 1.5, 0.0);
    const View view = test::perspective({2.0, -9.0, 5.0}, {0.0, 0.0, 0.0}, 120, 90);
    const test::Mesh ground = test::square(8.0), sheet = test::insideOut(test::square(1.5, 0.02));
    const test::Mask truth = test::castRays(ground, {}, sun, view, {sheet});
    ASSERT_GT(truth.count(test::Seen::ShadowedReceiver), 300);
    const auto build = [&] { return onGround(sun, ground, sheet); };
    EXPECT_EQ(compared(build, new gnomon::ShadowVolumeTechnique, view, truth).wrongInside, 0);
    EXPECT_EQ(compared(build, new gnomon::TracedShadowTechnique, view, truth).wrongInside, 0);
}

/// Of a solid about the eye and the lamp one sees nothing, and through it a ground that it keeps all light from.
TEST(Sheets, WhoseBacksAreCulledAboutTheEyeAndTheLampShadowAllBeyond) {
    const View view = test::perspective({0.0, -2.0, 2.5}, {0.0, 2.0, 0.0}, 120, 90);
    const test::Mesh ground = test::square(20.0), solid = test::box({-4.0, -4.0, 1.0}, {4.0, 4.0, 4.0});
    const test::Mask truth = test::castRays(ground, {}, lamp, view, {solid});
    ASSERT_EQ(truth.count(test::Seen::ShadowedReceiver), 120 * 90);
    const auto build = [&] { return onGround(lamp, ground, solid); };
    EXPECT_EQ(compared(build, new gnomon::ShadowVolumeTechnique, view, truth).wrongInside, 0);
    EXPECT_EQ(compared(build, new gnomon::TracedShadowTechnique, view, truth).wrongInside, 0);
}

/// What one looks through is a pane, or a node that the camera's mask leaves out.
TEST(Sheets, ThatOneLooksThroughShadowWhatIsBehindThem) {
    const test::Mesh slab = test::box({-1.5, -0.2, 0.5}, {1.5, 0.2, 3.0}),
                     sheet = test::quad({-1.5, 0.0, 0.5}, {3.0, 0.0, 0.0}, {0.0, 0.0, 2.5});
    const test::Mesh ground = test::square(8.0), post = test::box({-3.0, 0.8, 0.0}, {-2.6, 1.2, 4.0});
    const View view = test::perspective({2.0, -9.0, 5.0}, {0.0, 1.0, 0.5}, 120, 90);
    for (const test::Mesh& caster : {slab, test::insideOut(slab), sheet})
        for (const osg::Vec4d& light : {osg::Vec4d(0.3, -1.0, 1.5, 0.0), osg::Vec4d(0.3, 1.0, 1.5, 0.0),
                                        osg::Vec4d(1.0, -4.0, 6.0, 1.0), osg::Vec4d(1.0, 4.0, 6.0, 1.0)}) {
            const test::Mask truth = test::castRays(ground, {post}, light, view, {caster});
            ASSERT_GT(truth.count(test::Seen::ShadowedReceiver), 100);
            for (const bool pane : {true, false}) {
                const auto build = [&] {
                    Scene scene = test::scene(light);
                    scene.content->addChild(test::node(ground));
                    scene.content->addChild(test::node(post));
                    const osg::ref_ptr<osg::Node> node = test::node(caster);
                    if (pane) {
                        osg::StateSet& state = *node->getOrCreateStateSet();
                        state.setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
                        state.setAttributeAndModes(new osg::BlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA));
                        state.setAttribute(new osg::BlendColor(osg::Vec4(0.0f, 0.0f, 0.0f, 0.6f)));
                        state.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
                        state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
                    } else
                        node->setNodeMask(2);
                    scene.content->addChild(node);
                    return scene;
                };
                const unsigned reserved = light.x() == 0.3 ? 0xf8u : 0u; // of three bits not more than two count
                EXPECT_EQ(compared(build, new gnomon::ShadowVolumeTechnique, view, truth, reserved).wrongInside, 0)
                    << pane << " " << light.y() << " " << light.w();
            }
        }
}

} // namespace
