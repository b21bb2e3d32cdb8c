// SPDX-License-Identifier: MIT
// Receivers drawn by programs, and by osgFX, alone and beside others: where they read OpenGL's lights the shadow is
// exact.
#include "ReceiverCases.h"

#include <osg/Material>
#include <osg/Program>
#include <osg/VertexProgram>
#include <osgFX/Cartoon>
#include <osgFX/Scribe>

using namespace test;

namespace {

osg::StateSet& stateOf(osg::Node& node) { return *node.getOrCreateStateSet(); }

osg::ref_ptr<osg::Program> program(const std::string& vertex, const std::string& fragment) {
    osg::ref_ptr<osg::Program> result = new osg::Program;
    result->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    result->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return result;
}

const std::string begin = "varying vec4 color;\n"
                          "void main() {\n"
                          "  gl_Position = ftransform();\n"
                          "  vec3 normal = normalize(gl_NormalMatrix * gl_Normal);\n";
const std::string sourceLit = begin +
                              "  float share = max(dot(normal, normalize(gl_LightSource[0].position.xyz)), 0.0);\n"
                              "  color = 0.3 * vec4(0.5, 0.8, 1.0, 1.0) + share * gl_LightSource[0].diffuse; }\n";
const std::string productLit =
    begin + "  float share = max(dot(normal, normalize(gl_LightSource[0].position.xyz)), 0.0);\n"
            "  color = gl_FrontLightModelProduct.sceneColor + share * gl_FrontLightProduct[0].diffuse; }\n";
const std::string productOnly = begin + "  color = gl_FrontLightProduct[0].ambient\n"
                                        "    + abs(normal.z) * gl_FrontLightProduct[0].diffuse; }\n";
const std::string backLit = begin + "  color = 0.2 * vec4(1.0) + abs(normal.z) * gl_BackLightProduct[0].diffuse; }\n";
const std::string plainColor = "varying vec4 color; void main() { gl_FragColor = color; }\n";
const std::string sameDepth = "varying vec4 color;\n"
                              "void main() { gl_FragColor = color; gl_FragDepth = gl_FragCoord.z; }\n";
const std::string otherDepth = "varying vec4 color;\n"
                               "void main() { gl_FragColor = color; gl_FragDepth = 0.05 + 0.95 * gl_FragCoord.z; }\n";
/// The light is read in the fragment shader, of all lights by a loop.
const std::string carriesNormal = "varying vec3 normal;\n"
                                  "void main() { gl_Position = ftransform();\n"
                                  "  normal = gl_NormalMatrix * gl_Normal; }\n";
const std::string fragmentLit =
    "varying vec3 normal;\n"
    "void main() {\n"
    "  vec4 sum = vec4(0.1);\n"
    "  for (int i = 0; i < 2; ++i)\n"
    "    sum += gl_LightSource[i].diffuse *\n"
    "           max(dot(normalize(normal), normalize(gl_LightSource[i].position.xyz)), 0.0);\n"
    "  gl_FragColor = sum; }\n";

/// The right receiver is drawn by a program, the left one by OpenGL's own lighting.
std::function<void(TwoReceivers&)> right(const std::string& vertex, const std::string& fragment) {
    return [=](TwoReceivers& scene) { stateOf(*scene.right).setAttribute(program(vertex, fragment)); };
}

void programsOnBoth(TwoReceivers& scene) {
    stateOf(*scene.left).setAttribute(program(productLit, plainColor));
    stateOf(*scene.right).setAttribute(program(sourceLit, sameDepth));
}

/// Neither Gnomon nor the receiver reads what this screen's program writes.
void programOnScreens(TwoReceivers& scene) {
    stateOf(*scene.screen).setAttribute(program(sourceLit, plainColor));
    stateOf(*scene.late).setAttribute(program(productLit, plainColor));
}

/// OpenGL's assembly programs, which osg::State does not count as programs.
void assembly(TwoReceivers& scene) {
    osg::ref_ptr<osg::VertexProgram> vertex = new osg::VertexProgram;
    vertex->setVertexProgram("!!ARBvp1.0\n"
                             "OPTION ARB_position_invariant;\n"
                             "PARAM half = { 0.5, 0.5, 0.5, 1.0 };\n"
                             "TEMP color;\n"
                             "MUL color, half, state.light[0].diffuse;\n"
                             "ADD result.color, color, state.light[0].ambient;\n"
                             "END\n");
    stateOf(*scene.right).setAttributeAndModes(vertex);
}

void setColor(osg::Geode& geode, const osg::Vec4& color) {
    static_cast<osg::Vec4Array*>(geode.getDrawable(0)->asGeometry()->getColorArray())->front() = color;
}

void unlitBesideLit(TwoReceivers& scene) {
    stateOf(*scene.right).setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    setColor(*scene.right, {0.9f, 0.6f, 0.3f, 1.0f});
}

void blackRight(TwoReceivers& scene) { setColor(*scene.right, {0.0f, 0.0f, 0.0f, 1.0f}); }

std::string fixedColor(const std::string& color) { return "void main() { gl_FragColor = vec4(" + color + "); }\n"; }

/// What is lit has a low alpha, and does not blend: it would show if the other's blending were left on.
void fixedBesideLit(TwoReceivers& scene) {
    stateOf(*scene.left)
        .setAttribute(program("void main() { gl_Position = ftransform(); }\n", fixedColor("0.8, 0.7, 0.5, 1.0")));
    osg::ref_ptr<osg::Material> faint = new osg::Material;
    faint->setDiffuse(osg::Material::FRONT_AND_BACK, {0.8f, 0.8f, 0.8f, 0.25f});
    stateOf(*scene.right).setAttributeAndModes(faint);
}

void blackLeft(TwoReceivers& scene) {
    stateOf(*scene.left)
        .setAttribute(program("void main() { gl_Position = ftransform(); }\n", fixedColor("0.0, 0.0, 0.0, 1.0")));
}

void putUnder(osg::Group& parent, osg::Geode& child, osgFX::Effect* effect) {
    parent.replaceChild(&child, effect);
    effect->addChild(&child);
}

void scribeOnReceiver(TwoReceivers& scene) { putUnder(*scene.receivers, *scene.right, new osgFX::Scribe); }
void cartoonOnReceiver(TwoReceivers& scene) { putUnder(*scene.receivers, *scene.right, new osgFX::Cartoon); }

void scribeOnScreens(TwoReceivers& scene) {
    putUnder(*scene.casters, *scene.screen, new osgFX::Scribe);
    putUnder(*scene.casters, *scene.late, new osgFX::Scribe);
}

void cartoonOnScreens(TwoReceivers& scene) {
    putUnder(*scene.casters, *scene.screen, new osgFX::Cartoon);
    putUnder(*scene.casters, *scene.late, new osgFX::Cartoon);
}

class Effects : public testing::TestWithParam<ReceiverParam> {};

} // namespace

TEST_P(Effects, LitPixelsKeepEveryBitAndShadowedOnesLoseJustThisLight) { expectExact(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Programs, Effects,
    testing::Combine(testing::Values(ReceiverCase{"ReadingLightSource", right(sourceLit, plainColor)},
                                     ReceiverCase{"ReadingLightProduct", right(productLit, plainColor)},
                                     ReceiverCase{"ReadingLightProductAlone", right(productOnly, plainColor)},
                                     ReceiverCase{"ReadingBackLightProduct", right(backLit, plainColor)},
                                     ReceiverCase{"ReadingLightsInFragments", right(carriesNormal, fragmentLit)},
                                     ReceiverCase{"WritingItsDepth", right(sourceLit, sameDepth)},
                                     ReceiverCase{"WritingAnotherDepth", right(sourceLit, otherDepth), false, false},
                                     ReceiverCase{"OnBothReceivers", programsOnBoth},
                                     ReceiverCase{"OnScreens", programOnScreens}, ReceiverCase{"Assembly", assembly}),
                     testing::Values(0, 1)),
    caseName);

// With a factor of 0 what cannot lose a light is black in shadow, exactly; what stands beside it is relit as ever.
INSTANTIATE_TEST_SUITE_P(
    Unrelit, Effects,
    testing::Combine(testing::Values(ReceiverCase{"UnlitBesideLit", unlitBesideLit, false, true, blackRight, 1},
                                     ReceiverCase{"FixedBesideLit", fixedBesideLit, false, true, blackLeft, 1}),
                     testing::Values(0, 1)),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    OsgFX, Effects,
    testing::Combine(testing::Values(ReceiverCase{"ScribeOnReceiver", scribeOnReceiver, false, false},
                                     ReceiverCase{"CartoonOnReceiver", cartoonOnReceiver, false, false},
                                     ReceiverCase{"ScribeOnScreens", scribeOnScreens},
                                     ReceiverCase{"CartoonOnScreens", cartoonOnScreens}),
                     testing::Values(0, 1)),
    caseName);
