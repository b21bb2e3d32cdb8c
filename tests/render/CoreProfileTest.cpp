// SPDX-License-Identifier: MIT
// A program of its own, all of whose contexts have a core profile.
#include "GlComplaints.h"

#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/HaloNode.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/DisplaySettings>
#include <osg/Program>

#include <EGL/egl.h>
#include <dlfcn.h>

using namespace test;

/// In place of EGL's own, which HeadlessContext calls.
extern "C" EGLContext eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext share, const EGLint*) {
    const EGLint wanted[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const auto real = reinterpret_cast<decltype(&eglCreateContext)>(dlsym(RTLD_NEXT, "eglCreateContext"));
    return real(display, config, share, wanted);
}

namespace {

const View slanted = perspective({-6.0, -10.0, 6.0}, {0.0, 0.0, 0.0}, 300, 200);

/// Lit by a program that needs nothing of what a core profile lacks.
osg::ref_ptr<osg::Program> litProgram() {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(
        osg::Shader::VERTEX, "#version 330 core\nin vec4 osg_Vertex; in vec3 osg_Normal; out float light;\n"
                             "uniform mat4 osg_ModelViewProjectionMatrix;\n"
                             "void main() { light = 0.3 + 0.6 * max(dot(osg_Normal, vec3(0.7, 0.0, 0.7)), 0.0);\n"
                             "gl_Position = osg_ModelViewProjectionMatrix * osg_Vertex; }"));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       "#version 330 core\nin float light; out vec4 color; uniform float sun;\n"
                                       "void main() { color = vec4(vec3(light * sun), 1.0); }"));
    return program;
}

Scene modernScene() {
    Scene scene = groundScene({box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})});
    osg::StateSet& state = *scene.content->getOrCreateStateSet();
    state.setAttribute(litProgram());
    state.addUniform(new osg::Uniform("sun", 1.0f));
    return scene;
}

struct Shot {
    Picture picture;
    std::size_t complaints = 0;
};

/// The second frame; OpenSceneGraph itself complains of what a core profile lacks.
Shot shotOf(osg::Node* root) {
    osg::DisplaySettings::instance()->setVertexBufferHint(osg::DisplaySettings::VERTEX_ARRAY_OBJECT); // as it needs
    Camera camera(root, slanted);
    osg::State& state = *camera.context().graphicsContext()->getState();
    state.setUseModelViewAndProjectionUniforms(true);
    state.setUseVertexAttributeAliasing(true);
    GlComplaints complaints(camera);
    camera.frame();
    Shot shot{camera.frame(), 0};
    shot.complaints = complaints.all().size();
    return shot;
}

class CoreProfile : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Shadows, CoreProfile, testing::Values(0, 1, 2, 3));

osg::ref_ptr<gnomon::ShadowTechnique> techniqueOf(int number, osg::Node* ground) {
    if (number == 0) return planar(ground);
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    if (number == 1) technique = new gnomon::TracedShadowTechnique;
    if (number == 2) technique = new gnomon::ShadowMapTechnique;
    if (number == 3) technique = new gnomon::TerrainShadowGeode;
    technique->setReceiver({ground});
    return technique;
}

void expectRefused(const std::vector<std::string>& causes) {
    ASSERT_EQ(causes.size(), 1u);
    EXPECT_NE(causes[0].find("core profile"), std::string::npos) << causes[0];
}

} // namespace

TEST_P(CoreProfile, ATechniqueIsRefusedWithTheReasonAndTouchesNoPixel) {
    const Shot without = shotOf(modernScene().root);
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
        Scene scene = modernScene();
        const auto technique = techniqueOf(GetParam(), find(*scene.root, "ground"));
        scene.addShadow(technique);
        scene.group->setComposite(composite);
        const Shot with = shotOf(scene.root);
        EXPECT_NE(without.picture.at(150, 40), without.picture.at(0, 199)); // something is drawn
        EXPECT_EQ(with.picture.different(without.picture), 0);
        EXPECT_EQ(with.complaints, without.complaints);
        expectRefused(technique->diagnose());
    }
}

TEST_F(CoreProfile, AnEffectIsRefusedWithTheReasonAndTouchesNoPixel) {
    const Shot without = shotOf(modernScene().root);
    Scene scene = modernScene();
    const osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
    mirror->addChild(node(box({2.0, -1.0, 0.0}, {3.0, 0.0, 1.0}), "shown"));
    mirror->setSurface({find(*scene.root, "ground")});
    mirror->setReflectance({0.5f, 0.5f, 0.5f});
    scene.root->addChild(mirror);
    shotOf(scene.root);
    expectRefused(mirror->diagnose());
}
