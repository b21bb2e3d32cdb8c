// SPDX-License-Identifier: MIT
// Things without depth that are drawn first, or between others. A backdrop of the clear colour must change nothing.
#include <support/Causes.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Projection>

#include <algorithm>
#include <cctype>
#include <cstdlib>

using namespace test;

namespace {

using Group = gnomon::ShadowCasterGroup;
const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 120, 90);
const Mesh table = moved(quad({-5.0, -5.0, 0.0}, {10.0, 0.0, 0.0}, {0.0, 4.0, 0.0}), {0.0, 0.0, 0.5});

/// Unlit, without depth, of this colour, in a bin of its own.
osg::ref_ptr<osg::Geode> flat(const Mesh& mesh, const osg::Vec4& color, int bin) {
    const osg::ref_ptr<osg::Geode> result = node(mesh, "flat");
    static_cast<osg::Vec4Array*>(result->getDrawable(0)->asGeometry()->getColorArray())->front() = color;
    osg::StateSet* state = result->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    state->setRenderBinDetails(bin, "RenderBin");
    return result;
}

/// OSG's usual recipe: a rectangle of the screen, through an orthographic projection of its own.
osg::ref_ptr<osg::Node> onScreen(const glm::dvec3& corner, double width, double height, int bin) {
    const osg::Vec4 color = bin < 0 ? osg::Vec4(0.0f, 0.0f, 0.25f, 1.0f) : osg::Vec4(1.0f, 1.0f, 0.0f, 1.0f);
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    place->setCullingActive(false);
    place->addChild(flat(quad(corner, {width, 0.0, 0.0}, {0.0, height, 0.0}), color, bin));
    osg::ref_ptr<osg::Projection> lens = new osg::Projection;
    lens->setCullingActive(false);
    lens->addChild(place);
    return lens;
}

/// A picture with the technique, and what that says; an empty specification is none.
Picture picture(Scene& scene, const std::string& spec, Group::Composite composite, std::size_t causes = 0) {
    if (spec.empty()) return render(scene.root, view);
    scene.addShadow(spec);
    scene.group->setComposite(composite);
    const Picture result = render(scene.root, view);
    const auto* technique = dynamic_cast<gnomon::ShadowTechnique*>(scene.group->getChild(1));
    EXPECT_EQ(causesButLitSurfaces(*technique).size(), causes) << causesButLitSurfaces(*technique)[0];
    return result;
}

Scene boxScene() { return groundScene({box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0})}); }

/// True of two colours that differ by one step at most: of soft edges, one more rounding.
bool nearlySame(std::uint32_t a, std::uint32_t b) {
    for (int shift = 0; shift < 32; shift += 8)
        if (std::abs(static_cast<int>(a >> shift & 0xffu) - static_cast<int>(b >> shift & 0xffu)) > 1) return false;
    return true;
}

/// By what specification.
class Backdrop : public testing::TestWithParam<std::string> {
protected:
    /// True if a thing in the scene's root leaves every bit of every shadow.
    static void expectUnseen(const osg::ref_ptr<osg::Node>& thing) {
        Scene lit = boxScene();
        for (const Group::Composite composite : {Group::RELIGHT, Group::BLEND}) {
            Scene without = boxScene(), with = boxScene();
            with.root->addChild(thing);
            const Picture expected = picture(without, GetParam(), composite);
            EXPECT_GT(expected.different(render(lit.root, view)), 100);
            EXPECT_EQ(picture(with, GetParam(), composite).different(expected), 0) << composite;
        }
    }
};
INSTANTIATE_TEST_SUITE_P(Of, Backdrop,
                         testing::Values("planar", "planar:receiver=ground", "hull", "map", "map:edges=smooth",
                                         "map:edges=soft,size=128", "volume", "traced", "auto"),
                         [](const auto& given) {
                             std::string name = given.param;
                             std::replace_if(
                                 name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                             return name;
                         });

} // namespace

TEST_P(Backdrop, DrawnFirstThroughAProjectionOfItsOwnLeavesEveryShadow) {
    expectUnseen(onScreen({-1.0, -1.0, 0.0}, 2.0, 2.0, -10));
}

TEST_P(Backdrop, ASkyDrawnFirstWithoutDepthTakesNoFactorAndIsNotNamed) {
    expectUnseen(flat(box({-30.0, -30.0, -25.0}, {30.0, 30.0, 30.0}), {0.0f, 0.0f, 0.25f, 1.0f}, -1));
}

// The ground, then a sign that lies over most of it, then a table: the sign is as bright as ever, the rest as without it.
TEST_P(Backdrop, DrawnBetweenHidesShadowsOfWhatIsBeforeItAlone) {
    const bool named = GetParam().find("receiver") != std::string::npos || GetParam() == "hull";
    const auto build = [](bool sign) {
        Scene scene = boxScene();
        const osg::ref_ptr<osg::Geode> later = node(table, "table");
        later->getOrCreateStateSet()->setRenderBinDetails(3, "RenderBin");
        scene.content->addChild(later);
        if (sign) scene.root->addChild(onScreen({-0.6, -0.8, 0.0}, 1.2, 1.4, 2));
        return scene;
    };
    Scene bare = build(false), covered = build(true);
    const Picture without = render(bare.root, view), with = render(covered.root, view);
    for (const Group::Composite composite : {Group::RELIGHT, Group::BLEND}) {
        Scene scene = build(true), plain = build(false);
        const Picture actual = picture(scene, GetParam(), composite), shadowed = picture(plain, GetParam(), composite);
        int behind = 0, beside = 0, wrong = 0;
        for (std::size_t i = 0; i < actual.pixels.size(); ++i) {
            const bool isSign = with.pixels[i] != without.pixels[i];
            const bool isShadowed = shadowed.pixels[i] != without.pixels[i];
            behind += isSign && isShadowed;
            beside += !isSign && isShadowed;
            wrong += isSign ? actual.pixels[i] != with.pixels[i] : !nearlySame(actual.pixels[i], shadowed.pixels[i]);
        }
        EXPECT_GT(behind, 30) << "shadows that the sign hides";
        if (!named) EXPECT_GT(beside, 30) << "shadows on the table";
        EXPECT_EQ(wrong, 0) << composite;
    }
}
