// SPDX-License-Identifier: MIT
// Shadows whose pixels can be counted by hand, seen from straight above.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>

using namespace test;

namespace {

Picture shadowOf(const std::vector<Mesh>& casters, const osg::Vec4d& light, double half, int size) {
    Scene scene = groundScene(casters, half, light);
    scene.addShadow(planar(find(*scene.root, "ground")));
    return render(scene.root, fromAbove(half, size));
}

/// Pixels of grey `value` whose centre is where `inside` says no, or that lack it where `inside` says yes.
template <class Inside>
int misplaced(const Picture& picture, double half, unsigned value, Inside inside) {
    int result = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const double u = ((x + 0.5) / picture.width * 2.0 - 1.0) * half;
            const double v = ((y + 0.5) / picture.height * 2.0 - 1.0) * half;
            result += (picture.at(x, y) == grey(value)) != inside(u, v);
        }
    return result;
}

} // namespace

// Square of side 0.5 at height 0.5 over [-1, 1]², sun at 45°: the same square, 0.5 further; 16 × 16 of 64 × 64 pixels.
TEST(ExactShape, SquareUnderASunAt45DegreesIsASquareOfTheSameSize) {
    const Picture picture = shadowOf({square(0.25, 0.5)}, {1.0, 0.0, 1.0, 0.0}, 1.0, 64);
    EXPECT_EQ(picture.count(shadowedGround), 256);
    EXPECT_EQ(picture.count(litGround), 64 * 64 - 256);
    const auto shadow = [](double x, double y) { return std::abs(x + 0.5) < 0.25 && std::abs(y) < 0.25; };
    EXPECT_EQ(misplaced(picture, 1.0, shadowedGround, shadow), 0);
}

// Lamp at twice the square's height: twice its side, 32 × 32 pixels, of which the square itself hides 16 × 16.
TEST(ExactShape, LampAtTwiceTheHeightDoublesTheSquare) {
    Scene scene = groundScene({square(0.25, 0.5)}, 1.0, {0.0, 0.0, 1.0, 1.0}), lit = scene;
    const Picture plain = render(lit.root, fromAbove(1.0, 64));
    scene.addShadow(planar(find(*scene.root, "ground")));
    EXPECT_EQ(render(scene.root, fromAbove(1.0, 64)).different(plain), 32 * 32 - 16 * 16);
}

// A square under the ground, one above a lamp, and a box through the ground, of whose shadow, x = -1 … 1, its top hides one half.
TEST(ExactShape, WhatIsUnderThePlaneOrAboveALampCastsNothing) {
    struct {
        Mesh caster;
        osg::Vec4d light;
        int pixels;
    } const cases[] = {{square(0.5, -1.0), {1.0, 0.0, 1.0, 0.0}, 0},
                       {moved(square(0.5, 2.0), {1.0, 0.0, 0.0}), {0.0, 0.0, 1.0, 1.0}, 0},
                       {box({-0.5, -0.5, -1.0}, {0.5, 0.5, 1.0}), {1.0, 0.0, 1.0, 0.0}, 32 * 32}};
    for (const auto& each : cases)
        for (const bool named : {true, false}) {
            Scene scene = groundScene({each.caster}, 8.0, each.light), lit = scene;
            const Picture plain = render(lit.root, fromAbove(4.0));
            scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
            EXPECT_EQ(render(scene.root, fromAbove(4.0)).different(plain), each.pixels)
                << each.light.x() << each.light.w() << named;
        }
}

// Sphere of radius R under a sun at elevation e: an ellipse of semi-axes R and R / sin e. Seen from above the sphere
// hides part of it.
TEST(ExactShape, SphereCastsTheEllipseOfItsElevation) {
    const double half = 8.0, radius = 1.5, height = 5.0;
    for (const double degrees : {70.0, 45.0, 25.0}) {
        const double elevation = degrees * M_PI / 180.0;
        const osg::Vec4d sun(-std::cos(elevation), 0.0, std::sin(elevation), 0.0);
        Scene scene = groundScene({sphere({-2.0, 0.0, height}, radius, 256)}, half, sun), lit = scene;
        const Picture plain = render(lit.root, fromAbove(half, 512));
        scene.addShadow(planar(find(*scene.root, "ground")));
        const Picture picture = render(scene.root, fromAbove(half, 512));
        int wrong = 0, inside = 0;
        for (int y = 0; y < 512; ++y)
            for (int x = 0; x < 512; ++x) {
                const double u = (x + 0.5) / 32.0 - half, v = (y + 0.5) / 32.0 - half;
                const double along = (u - (-2.0 + height / std::tan(elevation))) * std::sin(elevation);
                const bool hidden = std::hypot(u + 2.0, v) < radius;
                const bool expected = std::hypot(along, v) < radius && !hidden;
                inside += expected;
                wrong += expected != (picture.at(x, y) != plain.at(x, y));
            }
        EXPECT_GT(inside, 5000) << degrees;
        // A sphere of 256 slices stays within 1.5·(1 - cos(π/256)) = 0.0001 of the true one, 0.004 pixel: of the some
        // 500 pixels on the two outlines about 2 have their centre that near.
        EXPECT_LE(wrong, 6) << degrees;
    }
}

TEST(ExactShape, FiftyOverlappingCastersDarkenAPixelOnce) {
    std::vector<Mesh> casters;
    for (int i = 0; i < 50; ++i) casters.push_back(moved(square(1.0, 1.0 + 0.02 * i), {0.01 * i, 0.0, 0.0}));
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
        Scene scene = groundScene(casters, 4.0);
        scene.addShadow(planar(find(*scene.root, "ground")));
        scene.group->setComposite(composite);
        const Picture picture = render(scene.root, fromAbove(4.0));
        const unsigned dark = composite == gnomon::ShadowCasterGroup::BLEND ? litGround / 2 : shadowedGround;
        EXPECT_GT(picture.count(dark), 1000);
        EXPECT_EQ(picture.count(dark) + picture.count(litGround), 256 * 256) << "some pixel is darker still";
    }
}

namespace {

/// Which pixels the shadow changes, in the third frame, where solids are known.
std::vector<bool> changedBy(const Mesh& caster, const osg::Matrixd& placed, const View& view) {
    const auto third = [&](bool shadow) {
        Scene scene = groundScene({}, 4.0, {1.0, 0.4, 1.3, 0.0});
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(placed);
        transform->addChild(node(caster));
        scene.content->addChild(transform);
        if (shadow) scene.addShadow(planar(find(*scene.root, "ground")));
        Camera camera(scene.root, view);
        camera.frame();
        camera.frame();
        return camera.frame();
    };
    const Picture with = third(true), without = third(false);
    std::vector<bool> changed;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) changed.push_back(with.pixels[i] != without.pixels[i]);
    return changed;
}

} // namespace

TEST(ExactShape, MirroredAndOpenAndInsideOutCastersCastTheSameShadow) {
    const Mesh solid = box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0});
    Mesh insideOut = solid;
    const Mesh open(solid.begin() + 6, solid.end()); // without its floor
    for (std::size_t i = 0; i < insideOut.size(); i += 3) std::swap(insideOut[i], insideOut[i + 1]);
    const View view = fromAbove(4.0);
    const std::vector<bool> expected = changedBy(solid, osg::Matrixd(), view);
    EXPECT_GT(std::count(expected.begin(), expected.end(), true), 1000);
    EXPECT_EQ(changedBy(open, osg::Matrixd(), view), expected);
    EXPECT_EQ(changedBy(insideOut, osg::Matrixd(), view), expected);
    EXPECT_EQ(changedBy(solid, osg::Matrixd::scale(-1.0, 1.0, 1.0), view), expected);
}

// Two sheets that meet in a ridge: open, and turned away from the light in one of the two windings.
TEST(ExactShape, OpenSheetsCastWhicheverWayTheyFace) {
    Mesh tent = joined({quad({-1.0, -1.0, 1.0}, {1.0, 0.0, 0.5}, {0.0, 2.0, 0.0}),
                        quad({0.0, -1.0, 1.5}, {1.0, 0.0, -0.5}, {0.0, 2.0, 0.0})});
    const std::vector<bool> up = changedBy(tent, osg::Matrixd(), fromAbove(4.0));
    for (std::size_t i = 0; i < tent.size(); i += 3) std::swap(tent[i], tent[i + 1]);
    EXPECT_EQ(changedBy(tent, osg::Matrixd(), fromAbove(4.0)), up);
    EXPECT_GT(std::count(up.begin(), up.end(), true), 1000);
}

namespace {

/// How many pixels of ground are dark under an overhead sun and a box of 2 × 2 m that casts but is not drawn.
int shadowedInside(const Mesh& solid, double mirror) {
    Scene scene = groundScene({}, 4.0, {0.0, 0.0, 1.0, 0.0});
    const osg::ref_ptr<osg::Geode> invisible = node(solid);
    invisible->setNodeMask(2u);
    scene.content->addChild(invisible);
    scene.addShadow(planar(find(*scene.root, "ground")));
    View view = fromAbove(4.0);
    view.view = osg::Matrixd::scale(mirror, 1.0, 1.0) * view.view;
    Camera camera(scene.root, view);
    camera.viewer().getCamera()->setCullMask(~2u);
    camera.frame();
    camera.frame(); // from now on solids are known
    return camera.frame().count(shadowedGround);
}

} // namespace

// One sees the ground inside the solid: it lies in the shadow of its roof, whichever way its faces or the view are
// turned.
TEST(ExactShape, GroundInsideASolidIsShadowedByItsRoof) {
    const Mesh solid = box({-1.0, -1.0, -1.0}, {1.0, 1.0, 2.0});
    Mesh insideOut = solid;
    for (std::size_t i = 0; i < insideOut.size(); i += 3) std::swap(insideOut[i], insideOut[i + 1]);
    for (const double mirror : {1.0, -1.0}) {
        EXPECT_EQ(shadowedInside(solid, mirror), 64 * 64) << "mirror " << mirror;
        EXPECT_EQ(shadowedInside(insideOut, mirror), 64 * 64) << "inside out, mirror " << mirror;
    }
}

TEST(ExactShape, ReceiverDrawnTwiceIsBlendedOnce) {
    Scene scene = groundScene({square(1.0, 1.0)}, 4.0);
    osg::ref_ptr<osg::Group> both = new osg::Group;
    for (int i = 0; i < 2; ++i) both->addChild(node(square(4.0)));
    scene.content->addChild(both);
    scene.addShadow(planar(both));
    scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    scene.group->setCasters({find(*scene.root, "caster")});
    const Picture picture = render(scene.root, fromAbove(4.0));
    EXPECT_GT(picture.count(litGround / 2), 1000);
    EXPECT_EQ(picture.count(litGround / 2) + picture.count(litGround), 256 * 256);
}
