// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <osg/State>
#include <osg/StateSet>

#include <string>
#include <vector>

namespace gnomon {

class ScreenPass;

/// State that draws geometry as marks: a program that takes each vertex to clip space by the uniform clipFromVertex alone,
/// made in double. GLSL 1.30. It belongs to a node, so that it is released with the node's other OpenGL objects.
/// @param defines  "#define CLIP\n": it writes clip distances to the uniform planes abovePlane and belowLight, too.
///                 "#define CUTOUT\n": it leaves out what the texture `cutout` says, by the uniform alphaTest.
///                 "#define EXTRUDE\n": vertices as ShadowVolumes has them, by the uniform light; coloured by wire.
///                 "#define CLIP_NEAR\n": it writes a clip distance to the uniform `nearest`, see mark.vert.
osg::ref_ptr<osg::StateSet> shaderProgram(const std::string& defines = "");
/// The same by cuts.frag, for MarkEdges. @param defines  of both shaders.
osg::ref_ptr<osg::StateSet> cutsProgram(const std::string& defines);
/// State with a program for ScreenPass::drawQuad(): a fragment shader for each pixel. GLSL 1.30.
osg::ref_ptr<osg::StateSet> quadProgram(const char* name, const std::string& defines, const char* fragmentShader);

/// False if the program that was applied last could not be built.
bool hasProgram(const osg::State& state);
constexpr const char* noProgram =
    "the shader program cannot be built in this context. Use OpenGL 3.0 with GLSL 1.30, or later.";

/// What a pass wants of a mark's program, as a uniform. x: fragments of pixels that less of the light than this reaches; y: what is
/// left of a colour where nothing arrives; z: 1 if the mark fades.
glm::dvec4 wantedOf(const ScreenPass& pass, bool fades);

/// Uniforms of the program that was applied last.
void setUniform(const osg::State& state, const char* name, const glm::dvec4& value);
void setUniform(const osg::State& state, const char* name, const glm::dmat4& value);
void setUniform(const osg::State& state, const char* name, const glm::dvec2& value);
void setUniform(const osg::State& state, const char* name, double value);
void setUniform(const osg::State& state, const char* name, int value); ///< a sampler's texture unit.
/// Of an array.
void setUniform(const osg::State& state, const char* name, const std::vector<glm::dvec4>& values);

} // namespace gnomon
