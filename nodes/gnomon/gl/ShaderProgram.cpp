// SPDX-License-Identifier: MIT
#include <gnomon/gl/ShaderProgram.h>

#include <gnomon_shaders.h>

#include <glm/gtc/type_ptr.hpp>
#include <osg/CullFace>
#include <osg/GLExtensions>
#include <osg/Program>

namespace gnomon {
namespace {

constexpr const char* version = "#version 130\n";

GLint placeOf(const osg::State& state, const char* name) {
    return state.getLastAppliedProgramObject()->getUniformLocation(osg::Uniform::getNameID(name));
}

/// OSG does not know arrays by their plain names.
GLint placeOfArray(const osg::State& state, const char* name) {
    const GLuint program = state.getLastAppliedProgramObject()->getHandle();
    return state.get<osg::GLExtensions>()->glGetUniformLocation(program, name);
}

/// A program and no more; with back faces in the set, whether they are culled is the caller's.
osg::ref_ptr<osg::StateSet> programState(const char* name, const std::string& vertex, const std::string& fragment) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName(name);
    program->addShader(new osg::Shader(osg::Shader::VERTEX, version + vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, version + fragment));
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    set->setAttribute(program);
    set->setAttribute(new osg::CullFace(osg::CullFace::BACK));
    return set;
}

} // namespace

osg::ref_ptr<osg::StateSet> shaderProgram(const std::string& defines) {
    return programState("gnomon mark", defines + shaders::mark_vert, defines + shaders::mark_frag);
}

osg::ref_ptr<osg::StateSet> quadProgram(const char* name, const std::string& defines, const char* fragmentShader) {
    return programState(name, defines + shaders::quad_vert, defines + fragmentShader);
}

bool hasProgram(const osg::State& state) { return state.getLastAppliedProgramObject() != nullptr; }

void setUniform(const osg::State& state, const char* name, const glm::dvec4& value) {
    const glm::vec4 rounded(value);
    state.get<osg::GLExtensions>()->glUniform4fv(placeOf(state, name), 1, glm::value_ptr(rounded));
}

void setUniform(const osg::State& state, const char* name, const glm::dmat4& value) {
    const glm::mat4 rounded(value);
    state.get<osg::GLExtensions>()->glUniformMatrix4fv(placeOf(state, name), 1, GL_FALSE, glm::value_ptr(rounded));
}

void setUniform(const osg::State& state, const char* name, const glm::dvec2& value) {
    const glm::vec2 rounded(value);
    state.get<osg::GLExtensions>()->glUniform2fv(placeOf(state, name), 1, glm::value_ptr(rounded));
}

void setUniform(const osg::State& state, const char* name, int value) {
    state.get<osg::GLExtensions>()->glUniform1i(placeOf(state, name), value);
}

void setUniform(const osg::State& state, const char* name, const std::vector<glm::dvec4>& values) {
    const std::vector<glm::vec4> rounded(values.begin(), values.end());
    state.get<osg::GLExtensions>()->glUniform4fv(placeOfArray(state, name), static_cast<GLsizei>(rounded.size()),
                                                 glm::value_ptr(rounded.front()));
}

} // namespace gnomon
