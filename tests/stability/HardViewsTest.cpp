// SPDX-License-Identifier: MIT
// Casters that the view does not hold, or holds in part; mirrored ones; views of no size.
// Mirrors and halos where there is nothing to draw, nothing to draw it with, or nothing right about it: the picture is
// that without them, and diagnose() says why wherever a user could wonder.
#include "Trial.h"

#include <gnomon/HaloNode.h>
#include <gnomon/PlanarReflectionNode.h>

#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <support/Panels.h>
#include <support/Scene.h>

#include <cmath>
#include <limits>

using namespace test;

namespace {

/// x of the caster becomes -2 x, by a transform 9 deep.
void mirror(const Scene& scene) {
    osg::ref_ptr<osg::Node> all = scene.content->getChild(1);
    for (const double x : {-2.0, 4.0, 0.25, 0.5, 2.0, -1.0, -1.0, 8.0, 0.125}) {
        osg::ref_ptr<osg::MatrixTransform> over = new osg::MatrixTransform(osg::Matrixd::scale(x, 1.0, 1.0));
        over->addChild(all);
        all = over;
    }
    scene.content->setChild(1, all);
}

GNOMON_BY_TECHNIQUE(HardView);
GNOMON_BY_TECHNIQUE(MirroredCaster);

} // namespace

TEST_P(HardView, BesideACasterShowsItsShadow) {
    Trial trial;
    trial.casters = {box({9.0, -1.0, 0.0}, {10.0, 1.0, 3.0})};
    trial.light = {4.0, 0.0, 1.0, 0.0};
    trial.half = 30.0;
    const Truth truth = truthOf(trial);
    EXPECT_EQ(truth.mask.count(Seen::Caster), 0);
    EXPECT_GT(truth.shadowPixels(), 128 * 20);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(HardView, BeforeACasterShowsItsShadow) {
    Trial trial;
    trial.casters = {box({-1.0, -7.0, 0.0}, {1.0, -6.0, 4.0})};
    trial.light = {0.0, -2.0, 1.0, 0.0};
    trial.view = perspective({1.5, -3.0, 1.5}, {0.0, 2.0, 0.0}, 128, 96);
    const Truth truth = truthOf(trial);
    EXPECT_EQ(truth.mask.count(Seen::Caster), 0);
    EXPECT_GT(truth.shadowPixels(), 1000);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(HardView, WhoseNearPlaneCutsACasterShowsItsShadow) {
    Trial trial;
    trial.casters = {box({-2.5, -0.5, -0.5}, {-1.5, 0.5, 0.75})};
    trial.light = {-1.0, 0.25, 0.5, 0.0};
    trial.view = perspective({-3.0, -0.25, 1.0}, {0.0, 0.0, 0.0}, 128, 96, 60.0);
    const Truth truth = truthOf(trial);
    EXPECT_GT(truth.mask.count(Seen::Caster), 100);
    EXPECT_GT(truth.shadowPixels(), 500);
    EXPECT_TRUE(isRight(trial));
}

TEST_P(HardView, ThatNoShadowReachesIsUnshadowed) {
    Trial trial;
    trial.light = {4.0, 0.0, 1.0, 0.0};
    trial.half = 40.0;
    const Mesh beside = box({-12.0, -1.0, 0.0}, {-10.0, 1.0, 3.0}); // casts away from what is seen
    trial.casters = {beside};
    EXPECT_TRUE(isUnshadowed(trial));
    // One caster on either side of the light's way to what is seen, and nothing between: the box about both is all that
    // is known of it at first.
    trial.casters = {joined({box({9.0, -9.0, 0.0}, {10.0, -6.0, 3.0}), box({9.0, 6.0, 0.0}, {10.0, 9.0, 3.0})})};
    EXPECT_EQ(truthOf(trial).shadowPixels(), 0);
    EXPECT_TRUE(isUnshadowed(trial));
}

TEST_P(HardView, OfNoSizeIsNoHarmToTheNext) {
    Trial trial;
    trial.casters = {box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0})};
    const Truth truth = truthOf(trial);
    Scene scene = trial.buildWithShadow();
    Camera camera(scene.root, trial.view);
    const auto frame = [&camera](int size) {
        camera.viewer().getCamera()->setViewport(0, 0, size, size);
        return camera.frame();
    };
    for (const int size : {0, 1}) frame(size);
    EXPECT_TRUE(shows(frame(128), truth));
}

TEST_P(MirroredCaster, CastsAsMuchAsItsImage) {
    Trial given;
    given.light = {1.0, 0.5, 1.0, 0.0};
    given.casters = {house({0.75, 0.0}, {0.5, 1.0, 1.0}, 30.0)};
    Mesh image = given.casters[0];
    for (glm::dvec3& v : image) v.x *= -2.0;
    Scene lit = given.build(), dark = given.build(), shadowed = given.buildWithShadow();
    dark.takeLightAway();
    for (const Scene* scene : {&lit, &dark, &shadowed}) mirror(*scene);
    const Truth truth{render(lit.root, given.view), render(dark.root, given.view),
                      castRays(square(given.half), {image}, given.light, given.view)};
    EXPECT_GT(truth.shadowPixels(), 200);
    EXPECT_TRUE(isRight(shadowed, given.view, truth));
}

using gnomon::HaloNode;
using gnomon::PlanarReflectionNode;

namespace {

const std::vector<Panel> panels = {
    {{-4.0, -3.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 7.0, 0.0}, {200, 120, 40}, "floor"},
    {{-3.0, 3.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, 2.5}, {40, 200, 80}, "wall"},
};
const View view = perspective({0.5, -7.0, 4.0}, {0.0, 1.0, 0.0}, 120, 90);

osg::ref_ptr<PlanarReflectionNode> mirror(const osg::Vec4d& plane = {0.0, 0.0, 1.0, 0.0}) {
    osg::ref_ptr<PlanarReflectionNode> node = new PlanarReflectionNode;
    node->addChild(group(panels));
    node->setSurface({find(*node, "floor")});
    node->setPlane(plane);
    return node;
}

/// The picture without a mirror, and one cause that holds the text; none if it is empty.
void expectNothing(PlanarReflectionNode& node, const std::string& text, osg::Node* root = nullptr,
                   const View& from = view) {
    const Picture picture = render(root ? root : &node, from);
    const auto causes = node.diagnose();
    EXPECT_EQ(causes.size(), text.empty() ? 0u : 1u) << text;
    for (const std::string& cause : causes) EXPECT_NE(cause.find(text), std::string::npos) << cause;
    node.setReflectance({0.0f, 0.0f, 0.0f});
    EXPECT_EQ(picture.different(render(root ? root : &node, from)), 0) << text;
}

} // namespace

TEST(HardMirrors, PlanesThatAreNoneMirrorNothingAndSaySo) {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (const osg::Vec4d& plane :
         {osg::Vec4d(0, 0, 0, 1), osg::Vec4d(nan, 0, 1, 0), osg::Vec4d(0, 0, infinity, 0), osg::Vec4d(0, 0, 1, nan)})
        expectNothing(*mirror(plane), "the plane's normal, or a transform above the node, is zero or not a number");
}

TEST(HardMirrors, WithoutASurfaceNothingIsMirrored) {
    const auto node = mirror();
    node->setSurface({});
    expectNothing(*node, "setSurface()");
}

TEST(HardMirrors, ASurfaceOfAnotherGraphIsSaid) {
    const auto node = mirror();
    const auto other = group(panels);
    node->setSurface({find(*other, "floor")});
    expectNothing(*node, "is not in this scene graph");
}

TEST(HardMirrors, ATransparentSurfaceIsSaid) {
    const auto node = mirror();
    find(*node, "floor")->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    expectNothing(*node, "drawn after the shadows");
}

TEST(HardMirrors, AnEmptyNodeMirrorsTheBackground) {
    osg::ref_ptr<osg::Group> root = group(panels);
    osg::ref_ptr<PlanarReflectionNode> node = new PlanarReflectionNode;
    root->addChild(node);
    node->setSurface({find(*root, "floor")});
    node->setReflectance({1.0f, 1.0f, 1.0f});
    const Picture picture = render(root, view);
    EXPECT_EQ(colorAt(picture, 60, 20), background);
    EXPECT_TRUE(node->diagnose().empty());
}

TEST(HardMirrors, AnEyeInThePlaneOrBehindItSeesNone) {
    expectNothing(*mirror(), "", nullptr, perspective({0.5, -7.0, 0.0}, {0.0, 1.0, 0.0}, 120, 90));
    expectNothing(*mirror(), "", nullptr, perspective({0.5, -7.0, -3.0}, {0.0, 1.0, 0.0}, 120, 90));
    expectNothing(*mirror({0.0, 0.0, -1.0, 0.0}), "");
    expectNothing(*mirror({0.0, 0.0, 1.0, 1e9}), "", nullptr, perspective({0, -7, -1.1e9}, {0, 0, -1e9}, 120, 90));
}

TEST(HardMirrors, ASingularTransformMirrorsNothing) {
    for (const double scale : {0.0, std::nan("")}) {
        const auto node = mirror();
        osg::ref_ptr<osg::MatrixTransform> flat = new osg::MatrixTransform(osg::Matrixd::scale(1.0, 1.0, scale));
        flat->addChild(node);
        flat->setCullingActive(false);
        render(flat, view);
    }
}

// Near cuts the floor at y = -1: what is left mirrors as before.
TEST(HardMirrors, ASurfaceThroughTheNearPlaneMirrorsInWhatIsLeft) {
    const auto node = mirror();
    const Picture whole = render(node, view);
    View cut = view;
    cut.projection.makePerspective(40.0, 4.0 / 3.0, 7.0, 100.0);
    const Picture picture = render(node, cut);
    int same = 0, gone = 0, other = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const bool isGone = colorAt(picture, x, y) == background;
            gone += isGone && picture.at(x, y) != whole.at(x, y);
            same += picture.at(x, y) == whole.at(x, y);
            other += !isGone && picture.at(x, y) != whole.at(x, y);
        }
    EXPECT_GT(gone, 500);
    EXPECT_GT(same, 3000);
    EXPECT_LT(other, 40) << "edges";
}

TEST(HardMirrors, AreOfTheSamePictureInEveryUnit) {
    const Picture here = render(mirror(), view);
    for (const double unit : {std::ldexp(1.0, -10), std::ldexp(1.0, 10)}) {
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::scale(unit, unit, unit));
        place->addChild(mirror());
        View there = view;
        there.view =
            osg::Matrixd::scale(1.0 / unit, 1.0 / unit, 1.0 / unit) * view.view * osg::Matrixd::scale(unit, unit, unit);
        there.projection.makePerspective(40.0, 4.0 / 3.0, unit, 100.0 * unit);
        EXPECT_LT(render(place, there).different(here), 3) << unit;
    }
}

TEST(HardHalos, OfNothingAreNothing) {
    const Picture plain = render(group(panels), view);
    for (const auto shape : {HaloNode::WHOLE, HaloNode::PARTS, HaloNode::PIXELS}) {
        osg::ref_ptr<osg::Group> root = group(panels);
        osg::ref_ptr<HaloNode> halo = new HaloNode;
        halo->setShape(shape);
        halo->setScale(1.5);
        root->addChild(halo);
        EXPECT_EQ(render(root, view).different(plain), 0);
        halo->addChild(new osg::Geode);
        halo->addChild(test::node(Mesh()));
        EXPECT_EQ(render(root, view).different(plain), 0);
        EXPECT_TRUE(halo->diagnose().empty());
    }
}

// The model's middle is at the eye: larger it is all about it.
TEST(HardHalos, AboutTheEyeAndThroughTheNearPlaneDrawWithoutHarm) {
    for (const auto shape : {HaloNode::WHOLE, HaloNode::PARTS, HaloNode::PIXELS}) {
        osg::ref_ptr<osg::Group> root = group(panels);
        osg::ref_ptr<HaloNode> halo = new HaloNode;
        halo->addChild(test::node(box({-1.5, -9.0, 2.0}, {2.5, -5.0, 6.0})));
        halo->setShape(shape);
        halo->setScale(1000.0);
        root->addChild(halo);
        Camera camera(root, view);
        camera.viewer().getCamera()->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
        camera.frame();
        camera.frame();
        EXPECT_TRUE(halo->diagnose().empty());
    }
}
