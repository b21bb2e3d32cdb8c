// SPDX-License-Identifier: MIT
// The colour of every pixel: either that of the lit render or that of a render in which this light is dark, both made
// without Gnomon, as a mask of rays cast in double says.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/Fog>
#include <osg/Material>
#include <osg/Texture2D>

#include <functional>

using namespace test;

namespace {

const View slanted = perspective({-10.0, -14.0, 12.0}, {0.0, 0.0, 0.0});
const std::vector<Mesh> twoCasters = {house({-2.0, 1.0}, {2.0, 2.0, 2.0}, 30.0), sphere({3.0, 2.0, 3.0}, 1.0, 24)};

struct Case {
    std::string name;
    osg::Vec4d light{1.0, 0.0, 1.0, 0.0};
    View view = slanted;
    bool named = true;
    std::function<void(Scene&)> change = [](Scene&) {};
};

std::ostream& operator<<(std::ostream& out, const Case& given) { return out << given.name; }

class ExactColors : public testing::TestWithParam<Case> {};

Scene build(const Case& given) {
    Scene scene = groundScene(twoCasters, 8.0, given.light);
    given.change(scene);
    return scene;
}

void texture(Scene& scene) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int i = 0; i < 8 * 8 * 3; ++i) image->data()[i] = static_cast<unsigned char>(40 + (i * 37) % 200);
    osg::ref_ptr<osg::Texture2D> texels = new osg::Texture2D(image);
    osg::Node* ground = find(*scene.root, "ground");
    ground->getOrCreateStateSet()->setTextureAttributeAndModes(0, texels);
    auto* geometry = ground->asGeode()->getDrawable(0)->asGeometry();
    osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
    for (const osg::Vec3& v : *static_cast<osg::Vec3Array*>(geometry->getVertexArray()))
        coordinates->push_back({v.x(), v.y()});
    geometry->setTexCoordArray(0, coordinates);
}

void specular(Scene& scene) {
    scene.light->getLight()->setSpecular({0.5f, 0.5f, 0.5f, 1.0f});
    auto* material =
        dynamic_cast<osg::Material*>(scene.root->getStateSet()->getAttribute(osg::StateAttribute::MATERIAL));
    material->setSpecular(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 1.0f});
    material->setShininess(osg::Material::FRONT_AND_BACK, 10.0f);
}

void fog(Scene& scene) {
    osg::ref_ptr<osg::Fog> attribute = new osg::Fog;
    attribute->setMode(osg::Fog::LINEAR);
    attribute->setStart(10.0f);
    attribute->setEnd(30.0f);
    scene.root->getOrCreateStateSet()->setAttributeAndModes(attribute);
}

/// Two halves of the ground, each with a state set that applies the light again, colours and all.
void lightInStateSets(Scene& scene) {
    osg::ref_ptr<osg::Group> halves = new osg::Group;
    for (const double left : {-8.0, 0.0}) {
        const osg::ref_ptr<osg::Geode> half = node(quad({left, -8.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 16.0, 0.0}));
        half->getOrCreateStateSet()->setAttributeAndModes(new osg::Light(*scene.light->getLight()));
        halves->addChild(half);
    }
    halves->setName("ground");
    scene.content->replaceChild(find(*scene.content, "ground"), halves);
}

void takeLightAwayFromStateSets(Scene& scene) {
    osg::Group* halves = find(*scene.root, "ground")->asGroup();
    for (unsigned i = 0; i < halves->getNumChildren(); ++i) {
        osg::StateSet* state = halves->getChild(i)->getStateSet();
        if (auto* light = state ? state->getAttribute(osg::StateAttribute::LIGHT) : nullptr)
            static_cast<osg::Light*>(light)->setDiffuse({0.0f, 0.0f, 0.0f, 1.0f});
    }
}

Picture dark(const Case& given) {
    Scene scene = build(given);
    scene.takeLightAway();
    takeLightAwayFromStateSets(scene);
    return render(scene.root, given.view);
}

View orthographic() {
    View view = slanted;
    view.projection.makeOrtho(-10.0, 10.0, -7.5, 7.5, 1.0, 100.0);
    return view;
}

View offCentre() {
    View view = slanted;
    view.projection.makeFrustum(-0.2, 0.6, -0.5, 0.1, 1.0, 100.0);
    return view;
}

} // namespace

TEST(ExactColors, GroundIs228InTheLightAnd102InShadow) {
    Scene scene = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})});
    scene.addShadow(planar(find(*scene.root, "ground")));
    const Picture picture = render(scene.root, fromAbove(8.0));
    EXPECT_EQ(picture.at(20, 20), grey(litGround));
    EXPECT_EQ(picture.at(128 - 24, 128), grey(shadowedGround)); // 1.5 m up, so 1.5 m against the sun: x = -1.5
    EXPECT_EQ(picture.count(litGround) + picture.count(shadowedGround), 256 * 256);
}

TEST_P(ExactColors, LitPixelsKeepEveryBitAndShadowedOnesLoseJustThisLight) {
    const Case& given = GetParam();
    Scene lit = build(given), shadowed = build(given);
    shadowed.addShadow(planar(given.named ? find(*shadowed.root, "ground") : nullptr));
    const Mask mask = castRays(square(8.0), twoCasters, given.light, given.view);
    ASSERT_GT(mask.count(Seen::ShadowedReceiver), 1000) << "the case shows no shadow to judge";
    Camera camera(shadowed.root, given.view);
    const Picture first = camera.frame();
    const Comparison found = compare(first, render(lit.root, given.view), dark(given), mask);
    EXPECT_EQ(found.wrongInside, 0);
    EXPECT_EQ(found.wrongAtEdge, 0);
    // The rasteriser snaps corners to 1/256 pixel; by depth alone the foot of a wall may go a pixel either way.
    EXPECT_LE(found.flipped, found.edges / (given.named ? 100 : 50));
    camera.frame();
    EXPECT_EQ(camera.frame().different(first), 0) << "the third frame, where solids are known, is another picture";
}

INSTANTIATE_TEST_SUITE_P(
    Planar, ExactColors,
    testing::Values(Case{"Sun"}, Case{"LowSun", {3.0, 1.0, 1.0, 0.0}}, Case{"Lamp", {3.0, -2.0, 8.0, 1.0}},
                    Case{"Unnamed", {1.0, 0.0, 1.0, 0.0}, slanted, false},
                    Case{"UnnamedLamp", {3.0, -2.0, 8.0, 1.0}, slanted, false},
                    Case{"Orthographic", {1.0, 0.0, 1.0, 0.0}, orthographic()},
                    Case{"UnnamedOrthographic", {1.0, 0.0, 1.0, 0.0}, orthographic(), false},
                    Case{"OffCentre", {1.0, 0.0, 1.0, 0.0}, offCentre()},
                    Case{"Textured", {1.0, 0.0, 1.0, 0.0}, slanted, true, texture},
                    Case{"Specular", {1.0, 0.0, 1.0, 0.0}, slanted, true, specular},
                    Case{"Fog", {1.0, 0.0, 1.0, 0.0}, slanted, true, fog},
                    Case{"UnnamedFog", {1.0, 0.0, 1.0, 0.0}, slanted, false, fog},
                    Case{"LightInStateSets", {1.0, 0.0, 1.0, 0.0}, slanted, true, lightInStateSets},
                    Case{"UnnamedLightInStateSets", {1.0, 0.0, 1.0, 0.0}, slanted, false, lightInStateSets}),
    [](const auto& given) { return given.param.name; });
