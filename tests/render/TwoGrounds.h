// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <functional>
#include <string>
#include <vector>

namespace test {

/// Which receiver the technique names: none, both grounds, or the left one alone, which then is the only one to receive.
enum class Named { Nothing, Both, Left };

/// Two grounds side by side in z = 0, named "left" and "right" under "grounds"; over them a "house", and a "screen" that
/// hides part of the left one and does not touch it. House and screen cast, and receive nothing.
struct TwoGrounds {
    osg::Vec4d light{1.0, 0.3, 1.2, 0.0};
    Named named = Named::Nothing;
    View view = perspective({-6.0, -10.0, 8.0}, {-0.5, 0.0, 0.0}, 240, 180, 30.0);

    Scene build() const;
    /// The technique for z = 0; it names what `named` says.
    osg::ref_ptr<gnomon::PlanarShadowNode> addShadow(Scene& scene) const;
    /// @param over   lies in z = 0 on the grounds: receives where nothing is named, else hides what does.
    /// @param before stands before the grounds, and casts.
    Mask mask(const Mesh& over = {}, const Mesh& before = {}) const;
};

/// Two lights from different sides, with each of the three receivers.
std::vector<TwoGrounds> allTwoGrounds();
std::ostream& operator<<(std::ostream& out, const TwoGrounds& given);
std::string nameOf(const TwoGrounds& given);

/// GLSL of a function that gives a vertex the colour which light 0 makes of it.
constexpr const char* litColor =
    "vec4 litColor() {\n"
    "  vec4 eye = gl_ModelViewMatrix * gl_Vertex, l = gl_LightSource[0].position;\n"
    "  float c = max(dot(normalize(gl_NormalMatrix * gl_Normal), normalize(l.xyz - l.w * eye.xyz)), 0.0);\n"
    "  return vec4(0.3, 0.2, 0.1, 1.0) + c * gl_LightSource[0].diffuse; }\n";

/// What is done to a scene or its viewer, alike with and without Gnomon.
using Change = std::function<void(Scene&)>;
using Setting = std::function<void(Camera&)>;

struct Trial {
    Change change = [](Scene&) {};
    Setting set = [](Camera&) {};
    Mesh over, before;      ///< see TwoGrounds::mask()
    std::string cause = {}; ///< part of the one sentence that diagnose() says where no receiver is named
};

/// Frames 1 and 3 (display lists compile in the first, solids are known in the third) have, away from edges, every bit of
/// a render without Gnomon: of one in which the light is dark where rays meet a caster, else of one in which it shines.
/// Nothing is said against it by diagnose() or OpenGL, and the stencil buffer is zero afterwards.
::testing::AssertionResult isExact(const TwoGrounds& place, const Trial& trial);

struct Frames {
    Picture first, third;
};
Frames frames(Camera& camera);
/// Without Gnomon; dark: as if no receiver got the light.
Frames unshadowed(const TwoGrounds& place, const Trial& trial, bool dark);
Picture cropped(const Picture& picture, int left, int bottom, int width, int height);
::testing::AssertionResult judge(const Picture& actual, const Picture& lit, const Picture& dark, const Mask& mask);

} // namespace test
