// SPDX-License-Identifier: MIT
// Programs that draw elsewhere than arrays and matrices say: what is said of them, and what serves instead.
#include "Trial.h"

#include <osg/Program>

using namespace test;

namespace {

GNOMON_BY_TECHNIQUE(ProgramPlaces);

const char* const colored = "gl_FrontColor = gl_Color; ";

osg::ref_ptr<osg::Program> vertexProgram(const std::string& body) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, "void main() { " + (colored + body) + " }"));
    return program;
}

const Mesh standing = box({-1.5, -0.5, 0.0}, {-0.5, 0.5, 1.0});
const Mesh displaced = moved(standing, {2.0, 0.5, 0.5});
constexpr const char* displacing =
    "vec4 v = gl_Vertex; v.xyz += vec3(2.0, 0.5, 0.5); gl_Position = gl_ModelViewProjectionMatrix * v;";

/// A box whose program draws it elsewhere, on a ground that is the receiver.
struct Moving {
    Moving() {
        box = node(standing, "figure");
        box->getOrCreateStateSet()->setAttribute(vertexProgram(displacing));
        scene.content->addChild(box);
        technique = castingTechnique(find(*scene.root, "ground"));
        scene.addShadow(technique);
    }
    std::vector<std::string> causes() {
        camera.frame();
        return technique->diagnose();
    }

    Scene scene = groundScene({});
    osg::ref_ptr<osg::Geode> box;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    Camera camera{scene.root, fromAbove(4.0, 128)};
};

/// The figure on the ground, without shadows.
Scene sceneOf(osg::Node* figure) {
    Scene scene = groundScene({});
    scene.content->addChild(figure);
    return scene;
}

bool has(const std::vector<std::string>& causes, const std::string& text) {
    return std::any_of(causes.begin(), causes.end(), [&](const auto& c) { return c.find(text) != std::string::npos; });
}

} // namespace

TEST_P(ProgramPlaces, ACasterThatAProgramMovesIsNamed) {
    Moving moving;
    EXPECT_TRUE(has(moving.causes(), "the program of 'figure' moves its vertices"));
    moving.box->getStateSet()->setAttribute(vertexProgram("gl_Position = ftransform();"));
    EXPECT_TRUE(moving.causes().empty());
}

TEST_P(ProgramPlaces, AProxyThatIsNeverDrawnCastsInItsPlace) {
    Moving moving;
    const osg::ref_ptr<osg::Geode> proxy = node(displaced, "proxy");
    moving.scene.content->addChild(proxy);
    moving.box->setNodeMask(0x1);
    proxy->setNodeMask(0x2);
    moving.camera.viewer().getCamera()->setCullMask(~0x2u);
    moving.scene.group->setCasters({nullptr, ~0x1u});
    Scene lit = sceneOf(moving.box), dark = sceneOf(moving.box);
    dark.takeLightAway();
    const View view = fromAbove(4.0, 128);
    const Truth truth{render(lit.root, view), render(dark.root, view),
                      castRays(square(8.0), {displaced}, {1.0, 0.0, 1.0, 0.0}, view), 2};
    EXPECT_TRUE(shows(moving.camera.frame(), truth));
    EXPECT_TRUE(moving.technique->diagnose().empty());
}

TEST_P(ProgramPlaces, ALogarithmicDepthIsNamedAsTheCause) {
    Moving moving;
    moving.scene.content->removeChild(moving.box);
    moving.scene.content->addChild(node(standing, "box"));
    osg::StateSet& state = *moving.scene.root->getOrCreateStateSet();
    state.setAttribute(vertexProgram("gl_Position = ftransform(); gl_Position.z = (2.0 * log2(gl_Position.w + 1.0) / "
                                     "log2(1001.0) - 1.0) * gl_Position.w;"));
    const std::vector<std::string> causes = moving.causes();
    EXPECT_TRUE(has(causes, "the program of 'ground' replaces OpenGL's depth"));
    EXPECT_FALSE(has(causes, "moves its vertices"));
    state.removeAttribute(osg::StateAttribute::PROGRAM);
    EXPECT_TRUE(moving.causes().empty());
}
