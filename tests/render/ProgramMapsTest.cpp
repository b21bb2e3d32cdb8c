// SPDX-License-Identifier: MIT
// Programs that ask maps themselves what share of the light arrives.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/Program>

#include <cmath>
#include <iostream>

using gnomon::ShadowMapTechnique;
using test::Picture;
using test::Scene;
using test::TracedCase;

namespace {

constexpr const char* vertex = R"(#version 130
out vec3 eye;
void main() {
    eye = (gl_ModelViewMatrix * gl_Vertex).xyz;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";
constexpr const char* fragment = R"(#version 130
in vec3 eye;
float gnomon_visibility(vec3 eye);
void main() { gl_FragColor = vec4(vec3(gnomon_visibility(eye)), 1.0); }
)";

/// Everything shows the share of the light, by a program of its own.
struct Asking {
    explicit Asking(const TracedCase& of) : given(of) {
        technique->setSize(2048);
        technique->setProgramUnit(3);
        scene.addShadow(technique);
        osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
        program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
        program->addShader(new osg::Shader(osg::Shader::FRAGMENT, technique->programFunction()));
        scene.content->getOrCreateStateSet()->setAttribute(program);
    }

    TracedCase given;
    Scene scene = given.build();
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
};

/// Of pixels that are no edges and face the light: those on the other side of one half; and those in which nearly all or nearly
/// nothing arrives.
struct Wrong {
    int wrong = 0, lit = 0, dark = 0;
};

Wrong against(const gnomon::TruthImage& truth, const Picture& picture) {
    Wrong result;
    for (int y = 1; y + 1 < truth.height; ++y)
        for (int x = 1; x + 1 < truth.width; ++x) {
            const gnomon::TruthPixel& pixel = truth.at(x, y);
            bool inside = pixel.seen() && pixel.facing > 0.05;
            for (int v = y - 1; v <= y + 1; ++v)
                for (int u = x - 1; u <= x + 1; ++u)
                    inside = inside && truth.at(u, v).seen() && !truth.at(u, v).isEdge() &&
                             truth.at(u, v).litCentre == pixel.litCentre &&
                             glm::distance(truth.at(u, v).normal, pixel.normal) < 0.2;
            if (!inside) continue;
            const int share = int(picture.at(x, y) & 0xffu);
            result.wrong += pixel.litCentre != (share > 127);
            result.lit += share == 255;
            result.dark += share == 0;
        }
    return result;
}

} // namespace

TEST(ProgramMaps, FindsWhatRaysFind) {
    for (const TracedCase& given : {test::labEight(), test::townOfHouses(), test::room()}) {
        Asking asking(given);
        const Wrong result = against(given.truth(), test::render(asking.scene.root, given.view));
        std::cout << given.name << ": wrong " << result.wrong << ", lit " << result.lit << ", dark " << result.dark
                  << "\n";
        EXPECT_EQ(result.wrong, 0) << given.name;
        EXPECT_GT(result.lit, 20000) << given.name;
        EXPECT_GT(result.dark, 3000) << given.name;
        EXPECT_EQ(asking.technique->diagnose(), std::vector<std::string>());
    }
}

TEST(ProgramMaps, FindsTheFirstCascadeThatHoldsAPlace) {
    const TracedCase street = test::longStreet(45.0);
    Asking asking(street);
    asking.technique->setCascades(3);
    const Wrong result = against(street.truth(), test::render(asking.scene.root, street.view));
    EXPECT_EQ(asking.technique->passes(), 3u);
    EXPECT_LE(result.wrong, (result.lit + result.dark) / 2000);
    EXPECT_GT(result.dark, 3000);
}

TEST(ProgramMaps, FindsAllOfTheLightWhereThereIsNoneToBlock) {
    Asking asking(test::labEight());
    test::Camera camera(asking.scene.root, asking.given.view);
    const auto dark = [](const Picture& picture) { return picture.count(0); };
    const Picture before = camera.frame();
    EXPECT_GT(dark(before), 3000);
    EXPECT_EQ(asking.technique->passes(), 1u);
    EXPECT_EQ(camera.frame().different(before), 0);
    EXPECT_EQ(asking.technique->passes(), 1u) << "nothing has changed";
    asking.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF);
    EXPECT_EQ(dark(camera.frame()), 0) << "the light is off";
    asking.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    EXPECT_EQ(camera.frame().different(before), 0) << "and on again";
    asking.technique->setNodeMask(0);
    EXPECT_EQ(dark(camera.frame()), 0) << "the technique is hidden";
    asking.technique->setNodeMask(~0u);
    EXPECT_EQ(camera.frame().different(before), 0) << "and shown again";
    EXPECT_EQ(asking.technique->diagnose(), std::vector<std::string>());
}

TEST(ProgramMaps, FindsInEachOfTwoViewsWhatIsTrueThere) {
    Asking asking(test::labEight());
    TracedCase other = asking.given;
    other.view = test::perspective({10.0, -6.0, 5.0}, {0.0, 0.0, 1.0}, 640, 480);
    test::Camera first(asking.scene.root, asking.given.view), second(asking.scene.root, other.view);
    for (int frame = 0; frame < 2; ++frame) {
        EXPECT_EQ(against(asking.given.truth(), first.frame()).wrong, 0) << frame;
        EXPECT_EQ(against(other.truth(), second.frame()).wrong, 0) << frame;
    }
}
