// SPDX-License-Identifier: MIT
// OSG's interlaced stereo keeps in the stencil buffer, from the first frame on, which pixels are whose eye's. Each eye's
// pixels must be those of a picture that is that eye's alone.
#include "GlComplaints.h"

#include <gnomon/HaloNode.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gtest/gtest.h>
#include <support/Scene.h>

#include <ostream>

using namespace test;
using Mode = osg::DisplaySettings::StereoMode;

namespace {

const View from = perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.5}, 240, 180);

/// Drawn after the shadows.
osg::ref_ptr<osg::Node> glass() {
    osg::ref_ptr<osg::Node> pane = node(quad({-3.0, -2.5, 0.1}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0}), "glass");
    osg::StateSet* set = pane->getOrCreateStateSet();
    set->setMode(GL_BLEND, osg::StateAttribute::ON);
    set->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    const osg::ref_ptr<osg::Geometry> geometry = pane->asGeode()->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array(1);
    color->front().set(1.0f, 0.3f, 0.1f, 0.5f);
    geometry->setColorArray(color, osg::Array::BIND_OVERALL);
    set->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return pane;
}

/// Where the box's shadow reaches it; half of it clear, by the alphas of its vertices.
osg::ref_ptr<osg::Node> leaf() {
    const osg::ref_ptr<osg::Geode> leaf = node(quad({-3.0, -0.3, 0.1}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0}), "leaf");
    leaf->setStateSet(glass()->getStateSet());
    const osg::ref_ptr<osg::Geometry> geometry = leaf->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(geometry->getVertexArray()->getNumElements());
    for (std::size_t i = 0; i < colors->size(); ++i) (*colors)[i].set(0.3f, 1.0f, 0.1f, i % 2 ? 1.0f : 0.0f);
    geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    return leaf;
}

/// A ground, a box, what mirrors or glows, and a pane of glass.
Scene build(const std::string& given) {
    Scene scene = groundScene({box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0})}, 4.0, {1.0, 0.3, 1.2, 0.0});
    scene.root->addChild(glass());
    if (given == "halo") {
        osg::ref_ptr<gnomon::HaloNode> halo = new gnomon::HaloNode;
        halo->addChild(node(box({1.5, -2.0, 0.2}, {2.5, -1.0, 1.2}), "glowing"));
        halo->setScale(1.3);
        scene.content->addChild(halo);
    } else if (given == "mirror") {
        osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
        mirror->addChild(scene.content);
        mirror->setSurface({find(*scene.root, "ground")});
        mirror->setReflectance({0.5f, 0.5f, 0.5f});
        scene.root->replaceChild(scene.content, mirror);
    } else if (!given.empty())
        scene.addShadow(given);
    return scene;
}

struct Drawn {
    Picture first, third;
    std::vector<std::string> complaints;
    bool keepsPattern = true; ///< nothing but the eyes' pattern is in the stencil buffer.
};

Drawn draw(const Scene& scene, Mode mode) {
    Camera camera(scene.root, from);
    osg::ref_ptr<osg::DisplaySettings> settings = new osg::DisplaySettings;
    settings->setStereo(true);
    settings->setStereoMode(mode);
    settings->setEyeSeparation(0.3f);
    camera.viewer().getCamera()->setDisplaySettings(settings);
    const GlComplaints complaints(camera);
    Drawn drawn;
    drawn.first = camera.frame();
    camera.frame();
    drawn.third = camera.frame();
    drawn.complaints = complaints.all();
    const osg::ref_ptr<osg::Image> stencil = camera.context().stencil();
    std::size_t ones = 0;
    for (std::size_t i = 0; i < stencil->getTotalSizeInBytes(); ++i) {
        drawn.keepsPattern = drawn.keepsPattern && stencil->data()[i] <= 1;
        ones += stencil->data()[i];
    }
    drawn.keepsPattern = drawn.keepsPattern && 2 * ones == drawn.third.pixels.size();
    return drawn;
}

Drawn draw(const std::string& given, Mode mode) { return draw(build(given), mode); }

/// Whether a picture has different colours about a pixel.
bool atEdge(const Picture& picture, int x, int y) {
    bool edge = x == 0 || y == 0 || x + 1 == picture.width || y + 1 == picture.height;
    for (int i = 0; i < 9 && !edge; ++i) edge = picture.at(x + i % 3 - 1, y + i / 3 - 1) != picture.at(x, y);
    return edge;
}

/// Pixels that are not those of the eye's own picture. @param swapped  the right eye has the even ones.
/// @param edges  count those at edges, too.
int wrong(const Picture& actual, const Picture& left, const Picture& right, Mode mode, bool swapped,
          bool edges = true) {
    int count = 0;
    for (int y = 0; y < actual.height; ++y)
        for (int x = 0; x < actual.width; ++x) {
            const int place = (mode == Mode::HORIZONTAL_INTERLACE ? 0 : x) + (mode == Mode::VERTICAL_INTERLACE ? 0 : y);
            const Picture& own = (place % 2 == 0) != swapped ? left : right;
            count += actual.at(x, y) != own.at(x, y) && (edges || !atEdge(own, x, y));
        }
    return count;
}

struct Case {
    Mode mode;
    std::string given;
};
std::ostream& operator<<(std::ostream& out, const Case& it) { return out << it.mode << " " << it.given; }

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const char* given :
         {"planar", "planar:composite=blend,receiver=ground", "map", "map:composite=blend,edges=smooth",
          "map:edges=smooth", "map:receiver=ground", "traced", "traced:composite=blend", "hull", "hull:composite=blend",
          "volume:edges=smooth", "planar:edges=smooth,composite=blend", "traced:edges=smooth", "halo", "mirror"})
        all.push_back({Mode::HORIZONTAL_INTERLACE, given});
    for (const char* given : {"planar", "map"})
        for (const Mode mode : {Mode::VERTICAL_INTERLACE, Mode::CHECKERBOARD}) all.push_back({mode, given});
    return all;
}

class InterlacedStereo : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Stereo, InterlacedStereo, testing::ValuesIn(cases()));

} // namespace

TEST_P(InterlacedStereo, ShowsEachEyeItsOwnPicture) {
    const auto& [mode, given] = GetParam();
    const Drawn bare = draw("", mode), actual = draw(given, mode);
    const Drawn bareLeft = draw("", Mode::LEFT_EYE), bareRight = draw("", Mode::RIGHT_EYE);
    const bool swapped = wrong(bare.third, bareLeft.third, bareRight.third, mode, true) == 0;
    ASSERT_EQ(wrong(bare.third, bareLeft.third, bareRight.third, mode, swapped), 0) << "without Gnomon";
    const Drawn left = draw(given, Mode::LEFT_EYE), right = draw(given, Mode::RIGHT_EYE);
    EXPECT_GT(left.third.different(bareLeft.third), 500);
    EXPECT_GT(left.third.different(right.third), 5000);
    // Smooth edges lie by the slope of what is seen, of which an eye knows every other pixel; and marks' edges are hard then.
    const bool smooth = given.find("smooth") != std::string::npos;
    EXPECT_EQ(wrong(actual.first, left.first, right.first, mode, swapped, !smooth), 0);
    EXPECT_EQ(wrong(actual.third, left.third, right.third, mode, swapped, !smooth), 0);
    EXPECT_LE(wrong(actual.third, left.third, right.third, mode, swapped), smooth ? 200 : 0);
    EXPECT_EQ(actual.complaints, std::vector<std::string>());
    EXPECT_TRUE(actual.keepsPattern);
}

/// The frame's own stencil buffer has the pattern, so there is no other framebuffer to work in.
TEST(InterlacedStereo, LeavesThatBlendReceiveNothingAndAreSaidTo) {
    const Scene bare = build(""), scene = build("map");
    for (const Scene* each : {&bare, &scene}) each->root->addChild(leaf());
    const Drawn without = draw(bare, Mode::HORIZONTAL_INTERLACE), with = draw(scene, Mode::HORIZONTAL_INTERLACE);
    EXPECT_GT(with.third.different(without.third), 500) << "the ground keeps its shadow";
    EXPECT_TRUE(with.keepsPattern);
    const auto* technique = dynamic_cast<const gnomon::ShadowTechnique*>(scene.group->getChild(1));
    ASSERT_NE(technique, nullptr);
    const std::vector<std::string> causes = technique->diagnose();
    EXPECT_TRUE(std::any_of(causes.begin(), causes.end(), [](const std::string& cause) {
        return cause.find("receives no shadow if any of it is clear in parts") != std::string::npos;
    }));
}
