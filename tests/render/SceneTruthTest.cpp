// SPDX-License-Identifier: MIT
// The truth of a scene graph: objects, transforms, alpha tests, what is drawn.
#include <SceneTruth.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/Camera>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Texture2D>

#include <cmath>
#include <limits>

using gnomon::examples::Clear;
using gnomon::examples::SceneCamera;
using gnomon::examples::SceneTruth;
using gnomon::metrics::TruthMaps;

namespace {

SceneCamera cameraOf(const test::View& view) { return {view.view, view.projection, view.width, view.height}; }

/// Pixels of an object.
int count(const gnomon::metrics::Grid<int>& ids, int id) {
    return static_cast<int>(std::count(ids.cells.begin(), ids.cells.end(), id));
}

/// A ground of half side 4 and, 2 above it, a lid of half side 1 given as one of 2 under a transform that halves it.
osg::ref_ptr<osg::Group> lidOverGround(const osg::Vec3d& at = {}) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(at));
    place->addChild(test::node(test::square(4.0), "ground"));
    osg::ref_ptr<osg::MatrixTransform> half =
        new osg::MatrixTransform(osg::Matrixd::scale(0.5, 0.5, 0.5) * osg::Matrixd::translate(0.0, 0.0, 2.0));
    half->addChild(test::node(test::square(2.0), "lid"));
    place->addChild(half);
    return place;
}

TEST(SceneTruth, KnowsObjectsUnderTransformsWhatBlocksThemAndHowFarAway) {
    const SceneTruth truth(*lidOverGround());
    EXPECT_EQ(truth.triangles(), 4u);
    const TruthMaps maps = truth.maps(cameraOf(test::fromAbove(4.0, 160)), {2.0, 0.0, 2.0, 0.0});
    // From above the lid covers 40 x 40 px of 160 x 160; its shadow, a square of its size, falls 2 to the left.
    EXPECT_EQ(count(maps.receiver, 1), 160 * 160 - 40 * 40);
    EXPECT_EQ(count(maps.receiver, 2), 40 * 40);
    EXPECT_EQ(count(maps.blocker, 2), 40 * 40) << "40 × 40 px two to the left, beside the lid as it is seen";
    for (int y = 0; y < 160; ++y)
        for (int x = 0; x < 160; ++x) {
            const bool shadow = x >= 20 && x < 60 && y >= 60 && y < 100;
            ASSERT_EQ(maps.litCentre.at(x, y) == 0, shadow) << x << ", " << y;
            ASSERT_EQ(maps.lit.at(x, y), shadow ? 0.0 : 1.0) << x << ", " << y;
            ASSERT_NEAR(maps.blockerDistance.at(x, y), shadow ? std::sqrt(8.0) : 0.0, 1e-2) << "the start is lifted";
            ASSERT_NEAR(maps.facing.at(x, y), std::sqrt(0.5), 1e-9);
        }
    EXPECT_NEAR(maps.edgeLength.at(80, 80), std::sqrt(8.0), 1e-6) << "the lid's diagonal, as it stands in the world";
    EXPECT_NEAR(maps.position.at(80, 80).z + truth.origin().z(), 2.0, 1e-6);
}

TEST(SceneTruth, WhatBlendsByOneAlphaBelowOneIsNotThereIfAsked) {
    for (const float alpha : {0.7f, 1.0f}) {
        const osg::ref_ptr<osg::Group> scene = lidOverGround();
        osg::Geometry& lid = *test::find(*scene, "lid")->asGeode()->getDrawable(0)->asGeometry();
        const osg::Vec4 color(1.0f, 1.0f, 1.0f, alpha);
        lid.setColorArray(new osg::Vec4Array(1, &color), osg::Array::BIND_OVERALL);
        lid.getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        const auto shadow = [&](Clear clear) {
            const TruthMaps maps =
                SceneTruth(*scene, clear).maps(cameraOf(test::fromAbove(4.0, 160)), {2.0, 0.0, 2.0, 0.0});
            EXPECT_LT(count(maps.drawn, 0), alpha < 1.0f || clear == Clear::HIDES ? 200 : 40 * 40 + 200);
            return 160 * 160 -
                   static_cast<int>(std::count(maps.litCentre.cells.begin(), maps.litCentre.cells.end(), 1));
        };
        EXPECT_EQ(shadow(Clear::HIDES), 40 * 40);
        EXPECT_EQ(shadow(Clear::PASSES), alpha < 1.0f ? 0 : 40 * 40);
    }
}

TEST(SceneTruth, FindsEveryPixelDrawnAsItIsTrueButWhereItSeesSomethingElse) {
    const test::View view = test::perspective({-5.0, -7.0, 5.0}, {0.0, 0.0, 0.5}, 320, 240);
    osg::ref_ptr<osg::Group> scene = lidOverGround();
    const TruthMaps plain = SceneTruth(*scene).maps(cameraOf(view), {1.0, 0.0, 2.0, 0.0});
    int seen = 0, other = 0;
    for (std::size_t i = 0; i < plain.receiver.cells.size(); ++i) {
        seen += plain.receiver.cells[i] != 0;
        other += plain.receiver.cells[i] != plain.drawn.cells[i];
    }
    EXPECT_GT(seen, 20000);
    EXPECT_LT(other, 20) << "silhouettes, where the rasteriser decides";

    osg::ref_ptr<osg::Camera> unseen = new osg::Camera; // drawn, and no part of the truth
    unseen->setReferenceFrame(osg::Transform::RELATIVE_RF);
    unseen->setRenderOrder(osg::Camera::NESTED_RENDER);
    unseen->addChild(test::node(test::quad({-0.5, -2.0, 0.5}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0})));
    scene->addChild(unseen);
    const TruthMaps hidden = SceneTruth(*scene).maps(cameraOf(view), {1.0, 0.0, 2.0, 0.0});
    scene->removeChild(unseen);
    scene->addChild(unseen->getChild(0)); // now as an object of its own: where it is seen is known
    const TruthMaps third = SceneTruth(*scene).maps(cameraOf(view), {1.0, 0.0, 2.0, 0.0});
    int covered = 0, wrong = 0;
    for (std::size_t i = 0; i < hidden.drawn.cells.size(); ++i) {
        const bool cover = third.receiver.cells[i] == 3;
        covered += cover;
        wrong += (hidden.drawn.cells[i] != hidden.receiver.cells[i]) != cover;
    }
    EXPECT_GT(covered, 500);
    EXPECT_LT(wrong, 60) << "silhouettes";
}

TEST(SceneTruth, OfACulledFaceNothingIsDrawnHoweverCloseBehindItAnotherLies) {
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(test::node(test::square(4.0), "ground"));
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(
        osg::Matrixd::rotate(osg::PI, osg::Vec3d(1.0, 0.0, 0.0)) * osg::Matrixd::translate(0.0, 0.0, 1e-4));
    place->addChild(test::node(test::square(1.0), "lid"));
    scene->addChild(place);
    const SceneCamera camera = cameraOf(test::perspective({0.0, -9.0, 2.0}, {}, 160, 120));
    const auto drawn = [&] { return count(SceneTruth(*scene).maps(camera, {2.0, 0.0, 2.0, 0.0}).drawn, 2); };
    EXPECT_GT(drawn(), 200);
    place->getOrCreateStateSet()->setMode(GL_CULL_FACE, osg::StateAttribute::ON);
    EXPECT_EQ(drawn(), 0);
}

/// Stripes that stand along y: texel columns 0 and 2 of 4 are there, 1 and 3 not.
osg::ref_ptr<osg::Geode> fence(bool tested, osg::Texture::FilterMode filter) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(4, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned x = 0; x < 4; ++x) image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, x % 2 ? 0.0f : 1.0f), x, 0);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MAG_FILTER, filter);
    texture->setFilter(osg::Texture::MIN_FILTER, filter);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}));
    osg::StateSet& state = *geode->getOrCreateStateSet();
    state.setTextureAttributeAndModes(0, texture);
    state.setAttribute(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    state.setMode(GL_ALPHA_TEST, tested);
    return geode;
}

TEST(SceneTruth, TexelsThatFailTheAlphaTestNeitherAreSeenNorBlock) {
    for (const bool tested : {true, false})
        for (const auto filter : {osg::Texture::NEAREST, osg::Texture::LINEAR}) {
            osg::ref_ptr<osg::Group> scene = new osg::Group;
            scene->addChild(test::node(test::square(4.0)));
            scene->addChild(fence(tested, filter));
            const TruthMaps maps = SceneTruth(*scene).maps(cameraOf(test::fromAbove(4.0, 160)), {2.0, 0.0, 2.0, 0.0});
            // The fence is 40 px wide, a stripe 10; columns 60 to 99 show it, 20 to 59 its shadow. Where filtered, alpha
            // passes 1/2 half way between texel centres: at the same places.
            for (int x = 20; x < 100; ++x) {
                const bool there = !tested || (x / 10) % 2 == 0;
                ASSERT_EQ(maps.receiver.at(x, 80), x >= 60 && there ? 2 : 1) << x << (tested ? " tested" : "");
                const bool dark = x < 60 && there;
                ASSERT_EQ(maps.litCentre.at(x, 80) == 0, dark) << x << (tested ? " tested" : "");
            }
        }
}

TEST(SceneTruth, TexelsThatBlendWithLessThanAHalfNeitherAreSeenNorBlockIfAsked) {
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(test::node(test::square(4.0)));
    const osg::ref_ptr<osg::Node> blended = fence(false, osg::Texture::NEAREST);
    blended->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    blended->getOrCreateStateSet()->setAttribute(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false)); // as leaves may
    scene->addChild(blended);
    const SceneCamera camera = cameraOf(test::fromAbove(4.0, 160));
    const osg::Vec4d sun(2.0, 0.0, 2.0, 0.0);
    const TruthMaps passing = SceneTruth(*scene, Clear::PASSES).maps(camera, sun);
    EXPECT_EQ(count(passing.receiver, 2), 20 * 40) << "of stripes, as above";
    EXPECT_EQ(count(passing.blocker, 2), 20 * 40);
    EXPECT_GT(count(passing.drawn, 2), 19 * 40) << "as rays see it, though it leaves no depth";
    EXPECT_EQ(count(SceneTruth(*scene, Clear::HIDES).maps(camera, sun).receiver, 2), 40 * 40);
}

TEST(SceneTruth, AnAlphaTestAboveTheSurfaceRulesAsOverridesSay) {
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(test::node(test::square(4.0)));
    scene->addChild(fence(true, osg::Texture::NEAREST));
    scene->getOrCreateStateSet()->setMode(GL_ALPHA_TEST, osg::StateAttribute::OFF);
    const SceneCamera camera = cameraOf(test::fromAbove(4.0, 160));
    EXPECT_EQ(count(SceneTruth(*scene).maps(camera, {2.0, 0.0, 2.0, 0.0}).receiver, 2), 20 * 40);
    scene->getOrCreateStateSet()->setMode(GL_ALPHA_TEST, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    EXPECT_EQ(count(SceneTruth(*scene).maps(camera, {2.0, 0.0, 2.0, 0.0}).receiver, 2), 40 * 40);
}

TEST(SceneTruth, IsTheSameAtUtmCoordinates) {
    const osg::Vec3d utm(432100.25, 6400000.5, 812.0);
    test::View view = test::perspective({-5.0, -7.0, 5.0}, {0.0, 0.0, 0.5}, 160, 120);
    const TruthMaps here = SceneTruth(*lidOverGround()).maps(cameraOf(view), {3.0, 1.0, 6.0, 1.0});
    view.view = osg::Matrixd::translate(-utm) * view.view;
    const TruthMaps there =
        SceneTruth(*lidOverGround(utm)).maps(cameraOf(view), {3.0 + utm.x(), 1.0 + utm.y(), 6.0 + utm.z(), 1.0});
    int different = 0;
    for (std::size_t i = 0; i < here.lit.cells.size(); ++i)
        different += here.lit.cells[i] != there.lit.cells[i] || here.drawn.cells[i] != there.drawn.cells[i];
    EXPECT_LE(different, 2) << "samples within a rounding of an edge";
}

TEST(SceneTruth, OfNothingIsRefused) {
    osg::ref_ptr<osg::Group> empty = new osg::Group;
    EXPECT_THROW(SceneTruth truth(*empty), std::runtime_error);
    empty->addChild(test::node(test::Mesh(3, glm::dvec3(std::numeric_limits<double>::quiet_NaN()))));
    EXPECT_THROW(SceneTruth truth(*empty), std::runtime_error);
}

} // namespace
