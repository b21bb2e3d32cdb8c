// SPDX-License-Identifier: MIT
#include <gnomon/compositor/ProgramLightUse.h>

#include <osg/FragmentProgram>
#include <osg/VertexProgram>

#include <array>
#include <string>

namespace gnomon {
namespace {

bool contains(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

bool namesColor(const std::string& source) { return contains(source, "diffuse") || contains(source, "specular"); }

/// True if GLSL text uses what a light colours: a product of light and material, a light's colour, or a light as a whole.
bool usesLightColor(const std::string& source) {
    if (contains(source, "LightProduct")) return true;
    const std::string name = "gl_LightSource";
    for (std::size_t at = source.find(name); at != std::string::npos; at = source.find(name, at + 1)) {
        const std::size_t bracket =
            source.find(']', at); // an index that itself has brackets is taken for a whole light
        const std::size_t next =
            bracket == std::string::npos ? bracket : source.find_first_not_of(" \t\r\n", bracket + 1);
        if (next == std::string::npos || source[next] != '.') return true;
        const std::size_t member = source.find_first_not_of(" \t\r\n", next + 1);
        for (const char* color : {"diffuse", "specular"})
            if (member != std::string::npos && source.compare(member, std::string(color).size(), color) == 0)
                return true;
    }
    return false;
}

/// OSG's own list of a program's uniforms leaves the built-in ones out, so OpenGL is asked.
bool readsLights(const osg::GLExtensions& gl, GLuint program) {
    GLint count = 0;
    gl.glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        char name[64] = {}; // cut off if longer: only how it begins matters
        GLint size = 0;
        GLenum type = 0;
        gl.glGetActiveUniform(program, static_cast<GLuint>(i), sizeof name, nullptr, &size, &type, name);
        for (const std::string light : {"gl_LightSource", "gl_FrontLightProduct", "gl_BackLightProduct"})
            if (std::string(name).compare(0, light.size(), light) == 0) return true;
    }
    return false;
}

/// OpenGL may list all of a light where its position alone is read: the text tells better, if there is one.
bool textUsesColor(const osg::Program& program) {
    bool hasText = false;
    for (unsigned i = 0; i < program.getNumShaders(); ++i) {
        const std::string& source = program.getShader(i)->getShaderSource();
        if (usesLightColor(source)) return true;
        hasText = hasText || !source.empty();
    }
    return !hasText;
}

/// An assembly program that is in use; null if none is.
template <typename AssemblyProgram>
const AssemblyProgram* assemblyIn(const osg::State& state, GLenum mode, osg::StateAttribute::Type type) {
    if (!state.getLastAppliedMode(mode)) return nullptr;
    return dynamic_cast<const AssemblyProgram*>(state.getLastAppliedAttribute(type));
}

bool assemblyReads(const std::string& source) { return contains(source, "state.light") && namesColor(source); }

/// By fixed function, or by assembly programs in its place.
bool fixedFunctionReads(const osg::State& state) {
    const auto* vertex =
        assemblyIn<osg::VertexProgram>(state, GL_VERTEX_PROGRAM_ARB, osg::StateAttribute::VERTEXPROGRAM);
    const auto* fragment =
        assemblyIn<osg::FragmentProgram>(state, GL_FRAGMENT_PROGRAM_ARB, osg::StateAttribute::FRAGMENTPROGRAM);
    if (fragment && assemblyReads(fragment->getFragmentProgram())) return true;
    return vertex ? assemblyReads(vertex->getVertexProgram()) : state.getLastAppliedMode(GL_LIGHTING);
}

/// 0 for a type that is no light's colour.
int componentsOf(GLenum type) {
    switch (type) {
    case GL_FLOAT:
        return 1;
    case GL_FLOAT_VEC2:
        return 2;
    case GL_FLOAT_VEC3:
        return 3;
    case GL_FLOAT_VEC4:
        return 4;
    default:
        return 0;
    }
}

void setUniform(const osg::GLExtensions& gl, GLint location, int components, const GLfloat* value) {
    const auto set = std::array{gl.glUniform1fv, gl.glUniform2fv, gl.glUniform3fv, gl.glUniform4fv};
    set.at(static_cast<std::size_t>(components - 1))(location, 1, value);
}

} // namespace

bool ProgramLightUse::canLose(unsigned dark) {
    const Program* program = _state.getLastAppliedProgramObject();
    if (!program) return fixedFunctionReads(_state);
    const auto [known, isNew] = _readsColors.insert({program, false});
    if (isNew)
        known->second = readsLights(*_state.get<osg::GLExtensions>(), program->getHandle()) &&
                        textUsesColor(*program->getProgram());
    return known->second || readsUniforms(*program, dark);
}

bool ProgramLightUse::readsUniforms(const Program& program, unsigned dark) const {
    unsigned read = 0;
    for (const LightUniform& uniform : _uniforms) {
        const auto active = program.getActiveUniforms().find(osg::Uniform::getNameID(uniform.name));
        const bool isColor = active != program.getActiveUniforms().end() && componentsOf(active->second._type) > 0;
        if (isColor) read |= 1u << uniform.number;
    }
    return (dark & ~read) == 0;
}

void ProgramLightUse::darken(unsigned dark) {
    const Program* program = _state.getLastAppliedProgramObject();
    if (!program) return;
    const osg::GLExtensions& gl = *_state.get<osg::GLExtensions>();
    for (const LightUniform& uniform : _uniforms) {
        const auto active = program->getActiveUniforms().find(osg::Uniform::getNameID(uniform.name));
        if (!(dark & (1u << uniform.number)) || active == program->getActiveUniforms().end()) continue;
        DarkUniform changed{active->second._location, componentsOf(active->second._type), {}};
        if (changed.components == 0) continue;
        gl.glGetUniformfv(program->getHandle(), changed.location, changed.value);
        const GLfloat black[4] = {};
        setUniform(gl, changed.location, changed.components, black);
        _changed.push_back(changed);
    }
}

void ProgramLightUse::restore() {
    for (const DarkUniform& uniform : _changed)
        setUniform(*_state.get<osg::GLExtensions>(), uniform.location, uniform.components, uniform.value);
    _changed.clear();
}

} // namespace gnomon
