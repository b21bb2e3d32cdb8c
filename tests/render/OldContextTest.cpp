// SPDX-License-Identifier: MIT
// A program of its own: Mesa reads which OpenGL to pretend to be once a process.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>

#include <cstdlib>

using namespace test;

TEST(OldContext, WithoutTheShadingLanguageThereIsNoShadowAndTheReason) {
    setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    setenv("MESA_GLSL_VERSION_OVERRIDE", "120", 1);
    unsetenv("GNOMON_TEST_DRIVER"); // the refused program is what this is about
    const View view = perspective({-6.0, -10.0, 6.0}, {0.0, 0.0, 0.0}, 300, 200);
    const auto build = [] { return groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})}); };
    Scene scene = build();
    const auto technique = planar(find(*scene.root, "ground"));
    scene.addShadow(technique);
    EXPECT_EQ(render(scene.root, view).different(render(build().root, view)), 0);
    ASSERT_EQ(technique->diagnose().size(), 1u);
    EXPECT_NE(technique->diagnose()[0].find("GLSL 1.30"), std::string::npos);
}
