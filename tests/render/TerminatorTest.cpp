// SPDX-License-Identifier: MIT
// Round bodies of few facets, shaded by their vertices' normals: they shadow themselves nowhere that shading shows.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowCasterGroup.h>
#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using gnomon::ShadowCasterGroup;
using test::Picture;
using test::Scene;
using test::View;

namespace {

constexpr const char* techniques[] = {"map", "volume", "traced", "auto"};
const osg::Vec4d suns[] = {{0.5, -0.4, 0.7, 0.0}, {-0.8, -0.3, 0.25, 0.0}, {0.1, 0.9, 0.3, 0.0}};
const osg::Vec4d lamp(3.0, -3.0, 2.0, 1.0);

osg::ref_ptr<osg::Node> shape(osg::Shape* of, float detail) {
    const osg::ref_ptr<osg::TessellationHints> hints = new osg::TessellationHints;
    hints->setDetailRatio(detail);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(of, hints));
    return geode;
}

/// Convex bodies, the first of some 24 segments.
osg::ref_ptr<osg::Node> ball(float detail = 0.6f) { return shape(new osg::Sphere(osg::Vec3(), 1.0f), detail); }
osg::ref_ptr<osg::Node> drum() { return shape(new osg::Cylinder(osg::Vec3(), 0.7f, 1.6f), 0.6f); }
/// A ball that is stretched as a whole.
osg::ref_ptr<osg::Node> egg() {
    const osg::ref_ptr<osg::MatrixTransform> egg = new osg::MatrixTransform(osg::Matrixd::scale(0.6, 1.0, 1.3));
    egg->addChild(ball());
    return egg;
}

/// @param from  0 to 3: with the light, from either side, and against it.
View viewOf(int from) {
    const double angle = std::acos(0.0) * from;
    return test::perspective({5.0 * std::cos(angle), 5.0 * std::sin(angle), 2.0}, {0.0, 0.0, 0.0}, 200, 160, 30.0);
}

/// @param spec  empty: without shadows.
Picture pictureOf(osg::Node* body, const osg::Vec4d& light, const std::string& spec, const View& view) {
    Scene scene = test::scene(light);
    scene.content->addChild(body);
    if (!spec.empty()) scene.addShadow(spec);
    return test::render(scene.root, view);
}

/// Pixels of `a` that are darker by more than this of 255.
int darker(const Picture& a, const Picture& b, int by) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += int(b.pixels[i] & 0xff) - int(a.pixels[i] & 0xff) > by;
    return count;
}

/// All of light's diffuse is 178 of 255, so that 8 is a step of 3 degrees of shading.
constexpr int step = 8;
constexpr int stepOfMap = 12; // which decides by texels

} // namespace

TEST(Terminator, ConvexSmoothBodiesAreNoDarkerThanWithoutShadows) {
    const std::pair<const char*, osg::ref_ptr<osg::Node>> bodies[] = {{"ball", ball()},
                                                                      {"ball of few facets", ball(0.35f)},
                                                                      {"ball of many facets", ball(2.5f)},
                                                                      {"egg", egg()},
                                                                      {"drum", drum()}};
    for (const auto& [name, body] : bodies)
        for (const osg::Vec4d& light : {suns[0], suns[1], suns[2], lamp})
            for (int from = 0; from < 4; ++from) {
                const View view = viewOf(from);
                const Picture without = pictureOf(body, light, "", view);
                for (const std::string technique : techniques)
                    EXPECT_EQ(
                        darker(pictureOf(body, light, technique, view), without, technique == "map" ? stepOfMap : step),
                        0)
                        << name << " " << technique << " " << light.x() << " from " << from;
                for (const std::string smooth : {"map:edges=smooth", "map:edges=smooth,filter=fine"})
                    EXPECT_LE(darker(pictureOf(body, light, smooth, view), without, stepOfMap), 1) // at the drum's rim
                        << name << " " << smooth << " " << light.x() << " from " << from;
            }
}

TEST(Terminator, HasTeethWhereFacetsAreAsked) {
    const osg::ref_ptr<osg::Node> body = drum();
    const Picture without = pictureOf(body, suns[0], "", viewOf(1));
    for (const std::string technique : techniques)
        EXPECT_GT(darker(pictureOf(body, suns[0], technique + ":terminator=facets", viewOf(1)), without, step), 50)
            << technique;
}

/// A box beside the ball, which would be lit through it, and the ground below: where the offset moves what casts along the
/// light's rays, no outline moves. Three pixels of 40,000 are the rounding of where volumes begin.
TEST(Terminator, OutlinesOfShadowsStay) {
    Scene scene = test::groundScene({test::box({-2.6, -0.3, 0.0}, {-2.0, 0.3, 1.6})});
    const osg::ref_ptr<osg::MatrixTransform> above = new osg::MatrixTransform(osg::Matrixd::translate(0.0, 0.0, 1.2));
    above->addChild(ball());
    scene.content->addChild(above);
    const View view = test::perspective({-9.0, -6.0, 7.0}, {-1.0, 0.0, 0.5}, 240, 180, 35.0);
    for (const std::string technique : techniques) {
        Scene other = test::scene();
        other.content->addChild(scene.content);
        other.addShadow(technique + ":composite=blend");
        const Picture offset = test::render(other.root, view);
        other.group->setTerminatorOffset(false);
        const Picture facets = test::render(other.root, view);
        Scene hidden = test::scene();
        hidden.content->addChild(above);
        const Picture body = test::render(hidden.root, view), nothing = test::render(test::scene().root, view);
        int differ = 0, dark = 0;
        for (std::size_t i = 0; i < body.pixels.size(); ++i) {
            if (body.pixels[i] != nothing.pixels[i]) continue; // of the ball itself
            differ += offset.pixels[i] != facets.pixels[i];
            dark += int(facets.pixels[i] & 0xff) < 120;
        }
        EXPECT_GT(dark, 500) << technique;
        EXPECT_LE(differ, 3) << technique;
    }
}

/// The eye is in the shadow behind the ball, where volumes are counted from behind.
TEST(Terminator, SeenFromWithinTheShadow) {
    const View view = test::perspective({-2.2, 0.0, -1.2}, {0.0, 0.0, 0.0}, 160, 120, 60.0, 0.1);
    const osg::ref_ptr<osg::Node> body = ball();
    const Picture without = pictureOf(body, {1.0, 0.0, 0.5, 0.0}, "", view);
    for (const std::string technique : techniques)
        EXPECT_EQ(darker(pictureOf(body, {1.0, 0.0, 0.5, 0.0}, technique, view), without, step), 0) << technique;
}

TEST(Terminator, FollowsNormalsThatChange) {
    Scene scene = test::scene(suns[1]);
    const osg::ref_ptr<osg::Node> body = ball();
    osg::Geometry& geometry = *body->asGeode()->getDrawable(0)->asGeometry();
    geometry.setUseDisplayList(false); // of buffers the arrays' counts tell
    geometry.setUseVertexBufferObjects(true);
    auto& normals = static_cast<osg::Vec3Array&>(*geometry.getNormalArray());
    const osg::ref_ptr<osg::Vec3Array> smooth = new osg::Vec3Array(normals);
    std::fill(normals.begin(), normals.end(), osg::Vec3(0.0f, 0.0f, 1.0f));
    scene.content->addChild(body);
    for (const std::string technique : techniques) {
        Scene shadowed = test::scene(suns[1]);
        shadowed.content->addChild(body);
        shadowed.addShadow(technique);
        test::Camera camera(shadowed.root, viewOf(3));
        camera.frame();
        std::copy(smooth->begin(), smooth->end(), normals.begin());
        normals.dirty();
        const Picture without = pictureOf(body, suns[1], "", viewOf(3));
        EXPECT_EQ(darker(camera.frame(), without, step), 0) << technique;
        std::fill(normals.begin(), normals.end(), osg::Vec3(0.0f, 0.0f, 1.0f));
        normals.dirty();
    }
}
