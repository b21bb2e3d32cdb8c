// SPDX-License-Identifier: MIT
// Programs that read a light by a uniform of their own lose it once the uniform is named.
#include <support/Causes.h>
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/Depth>
#include <osg/Program>
#include <osg/Uniform>

using namespace test;

namespace {

const View slanted = perspective({-10.0, -14.0, 12.0}, {0.0, 0.0, 0.0});
const std::vector<Mesh> twoCasters = {house({-2.0, 1.0}, {2.0, 2.0, 2.0}, 30.0), sphere({3.0, 2.0, 3.0}, 1.0, 24)};

osg::ref_ptr<osg::Program> programReading(const std::string& type, const std::string& colour) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, "void main() { gl_Position = ftransform(); }"));
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT, "uniform " + type +
                                                   " sunColor; uniform float lamp;\n"
                                                   "void main() { gl_FragColor = vec4(0.2 + 0.1 * lamp) + vec4(" +
                                                   colour + ", 0.0); }"));
    return program;
}

struct Case {
    std::string type, colour; ///< in GLSL
    osg::ref_ptr<osg::Uniform> uniform, black;
    bool named;
};

std::ostream& operator<<(std::ostream& out, const Case& given) { return out << given.type << given.named; }

class LightUniforms : public testing::TestWithParam<Case> {};

Scene build(const Case& given, osg::Uniform* sun) {
    Scene scene = groundScene(twoCasters);
    osg::StateSet* state = find(*scene.root, "ground")->getOrCreateStateSet();
    state->setAttribute(programReading(given.type, given.colour));
    state->addUniform(sun);
    state->addUniform(new osg::Uniform("lamp", 1.0f));
    return scene;
}

} // namespace

TEST_P(LightUniforms, NamedOneIsZeroWhereTheLightIsGoneAndNowhereElse) {
    const Case& given = GetParam();
    Scene lit = build(given, given.uniform), gone = build(given, given.black), shadowed = build(given, given.uniform);
    gone.takeLightAway();
    // The same program and uniform, drawn after the shadows without depth, so that it receives nothing.
    osg::ref_ptr<osg::Geode> late = node(quad({-4.0, -6.0, 0.1}, {8.0, 0.0, 0.0}, {0.0, 1.0, 0.0}), "late");
    late->setStateSet(new osg::StateSet(*find(*lit.root, "ground")->getStateSet()));
    late->getStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    late->getStateSet()->setAttribute(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
    const auto technique = planar(given.named ? find(*shadowed.root, "ground") : nullptr);
    shadowed.addShadow(technique);
    shadowed.group->addLightUniform({0, "sunColor"});
    shadowed.group->addLightUniform({1, "lamp"}); // of a light that casts nothing here
    for (Scene* scene : {&lit, &gone, &shadowed}) scene->root->addChild(late);
    const Picture litPicture = render(lit.root, slanted);
    const Mask mask = castRays(square(8.0), twoCasters, {1.0, 0.0, 1.0, 0.0}, slanted);
    Picture dark = render(gone.root, slanted);
    Camera camera(shadowed.root, slanted);
    for (int frame = 0; frame < 2; ++frame) {
        const Comparison found = compare(camera.frame(), litPicture, dark, mask);
        EXPECT_EQ(found.wrongInside + found.wrongAtEdge, 0) << "frame " << frame;
    }
    EXPECT_EQ(causesButLitSurfaces(*technique), std::vector<std::string>());
}

INSTANTIATE_TEST_SUITE_P(
    Types, LightUniforms,
    testing::Values(Case{"float", "vec3(sunColor)", new osg::Uniform("sunColor", 0.5f),
                         new osg::Uniform("sunColor", 0.0f), true},
                    Case{"vec2", "sunColor.xyx", new osg::Uniform("sunColor", osg::Vec2(0.5f, 0.3f)),
                         new osg::Uniform("sunColor", osg::Vec2()), true},
                    Case{"vec3", "sunColor", new osg::Uniform("sunColor", osg::Vec3(0.5f, 0.3f, 0.1f)),
                         new osg::Uniform("sunColor", osg::Vec3()), false},
                    Case{"vec4", "sunColor.rgb", new osg::Uniform("sunColor", osg::Vec4(0.5f, 0.3f, 0.1f, 1.0f)),
                         new osg::Uniform("sunColor", osg::Vec4()), true}),
    [](const auto& given) { return given.param.type; });

TEST(LightUniforms, UnnamedOneLeavesTheFactorAndTheReason) {
    const Case given{"vec3", "sunColor", new osg::Uniform("sunColor", osg::Vec3(0.5f, 0.3f, 0.1f)), nullptr, true};
    Scene scene = build(given, given.uniform);
    const auto technique = planar(find(*scene.root, "ground"));
    scene.addShadow(technique);
    scene.group->addLightUniform({1, "sunColor"}); // another light's
    render(scene.root, slanted);
    const std::vector<std::string> causes = causesButLitSurfaces(*technique);
    ASSERT_EQ(causes.size(), 1u);
    EXPECT_NE(causes[0].find("addLightUniform"), std::string::npos);
}

TEST(LightUniforms, OneThatIsNoColourLeavesTheFactorAndTheReason) {
    const Case given{"float", "vec3(0.5 * sunColor)", new osg::Uniform("sunColor", 1.0f), nullptr, true};
    Scene scene = build(given, given.uniform);
    osg::StateSet* state = find(*scene.root, "ground")->getStateSet();
    state->setAttribute(programReading("int", "vec3(0.5 * float(sunColor))"));
    state->removeUniform("sunColor");
    state->addUniform(new osg::Uniform("sunColor", 1));
    const auto technique = planar(find(*scene.root, "ground"));
    scene.addShadow(technique);
    scene.group->addLightUniform({0, "sunColor"});
    render(scene.root, slanted);
    EXPECT_EQ(causesButLitSurfaces(*technique).size(), 1u);
}

TEST(LightUniforms, MayBeSetToThemselves) {
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addLightUniform({1, "a"});
    group->addLight({2, osg::Vec4d(0.0, 0.0, 1.0, 0.0)});
    group->setLightUniforms(group->getLightUniforms());
    group->setLights(group->getLights());
    EXPECT_EQ(group->getLightUniforms().size(), 1u);
    EXPECT_EQ(group->getLights().size(), 1u);
}

TEST(LightUniforms, LightNumbersThatOpenGLLacksAreRefused) {
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    for (const int number : {-1, 8}) group->addLightUniform({number, "sunColor"});
    EXPECT_TRUE(group->getLightUniforms().empty());
    group->setLightUniforms({{7, "a"}, {8, "b"}});
    ASSERT_EQ(group->getLightUniforms().size(), 1u);
    EXPECT_EQ(group->getLightUniforms()[0].name, "a");
}
