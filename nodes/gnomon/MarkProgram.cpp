// SPDX-License-Identifier: MIT
#include <gnomon/MarkProgram.h>

#include <gnomon_shaders.h>

#include <glm/gtc/type_ptr.hpp>
#include <osg/CullFace>
#include <osg/GLExtensions>
#include <osg/Program>

namespace gnomon {
namespace {

GLint placeOf(const osg::State& state, const char* name) {
    return state.getLastAppliedProgramObject()->getUniformLocation(osg::Uniform::getNameID(name));
}

} // namespace

osg::ref_ptr<osg::StateSet> markProgram(const std::string& defines) {
    const std::string version = "#version 130\n";
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("gnomon mark");
    program->addShader(new osg::Shader(osg::Shader::VERTEX, version + defines + shaders::mark_vert));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, version + shaders::mark_frag));
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    set->setAttribute(program);
    set->setAttribute(new osg::CullFace(osg::CullFace::BACK)); // whether it is on is the caller's
    return set;
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

} // namespace gnomon
