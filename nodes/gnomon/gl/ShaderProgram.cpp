// SPDX-License-Identifier: MIT
#include <gnomon/ScreenPass.h>
#include <gnomon/gl/ShaderProgram.h>

#include <gnomon_shaders.h>

#include <glm/gtc/type_ptr.hpp>
#include <osg/ContextData>
#include <osg/CullFace>
#include <osg/GLExtensions>
#include <osg/Program>

#include <mutex>
#include <vector>

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

/// Keeps for good what has names of a context that is gone: its destructor would have them deleted in the next context of the
/// same ID, where they are somebody else's.
void bury(const osg::ref_ptr<osg::Referenced>& objects) {
    static std::mutex mutex;
    static auto& all = *new std::vector<osg::ref_ptr<osg::Referenced>>;
    const std::lock_guard<std::mutex> lock(mutex);
    if (objects) all.push_back(objects);
}

class OwnShader : public osg::Shader {
public:
    using osg::Shader::Shader;
    void forget(unsigned context) {
        bury(_pcsList[context].get());
        _pcsList[context] = nullptr;
    }
};

/// A program that knows a context from one that had its ID before. OSG does not: where a program is in no graph when a window
/// closes, it would go by names of that window in the next. Where GLSL is older it is none: Mesa 25 crashes as it links it.
class OwnProgram : public osg::Program {
public:
    OwnProgram(const std::string& vertex, const std::string& fragment)
        : _shaders{new OwnShader(osg::Shader::VERTEX, vertex), new OwnShader(osg::Shader::FRAGMENT, fragment)} {
        for (const auto& shader : _shaders) addShader(shader);
    }

    void apply(osg::State& state) const override {
        const auto* gl = state.get<osg::GLExtensions>();
        if (gl->isGlslSupported && gl->glslLanguageVersion < 1.25f) { // 1.20, rounded
            gl->glUseProgram(0);
            state.setLastAppliedProgramObject(nullptr);
            return;
        }
        const unsigned context = state.getContextID();
        const osg::ref_ptr<osg::ContextData> now = osg::getContextData(context);
        if (_contexts[context] != now) forget(context);
        _contexts[context] = now;
        osg::Program::apply(state);
    }
    void resizeGLObjectBuffers(unsigned maxSize) override {
        osg::Program::resizeGLObjectBuffers(maxSize);
        _contexts.resize(maxSize);
    }

protected:
    ~OwnProgram() override = default;

private:
    void forget(unsigned context) const {
        bury(_pcpList[context].get());
        _pcpList[context] = nullptr;
        for (const auto& shader : _shaders) shader->forget(context);
    }

    const std::vector<osg::ref_ptr<OwnShader>> _shaders;
    mutable osg::buffered_value<osg::ref_ptr<osg::ContextData>> _contexts; ///< that its names are of, by ID.
};

/// A program and no more; with back faces in the set, whether they are culled is the caller's.
osg::ref_ptr<osg::StateSet> programState(const char* name, const std::string& vertex, const std::string& fragment) {
    const osg::ref_ptr<osg::Program> program = new OwnProgram(version + vertex, version + fragment);
    program->setName(name);
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    set->setAttribute(program);
    set->setAttribute(new osg::CullFace(osg::CullFace::BACK));
    return set;
}

} // namespace

osg::ref_ptr<osg::StateSet> shaderProgram(const std::string& defines) {
    return programState("gnomon mark", defines + shaders::mark_vert, defines + shaders::mark_frag);
}

osg::ref_ptr<osg::StateSet> cutsProgram(const std::string& defines) {
    return programState("gnomon cuts", "#define CUTS\n" + defines + shaders::mark_vert, defines + shaders::cuts_frag);
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

/// Less than all of the light is a step of eight bits.
glm::dvec4 wantedOf(const ScreenPass& pass, bool fades) {
    using Want = ScreenPass::Want;
    constexpr double half = 0.5, allOfIt = 511.0 / 512.0, any = 2.0;
    const Want want = pass.wanted();
    const double below = want == Want::Blocked   ? half
                         : want == Want::Touched ? allOfIt
                         : want == Want::Factor  ? (fades ? allOfIt : half)
                                                 : any;
    return {below, pass.factor(), fades ? 1.0 : 0.0, 0.0};
}

void setUniform(const osg::State& state, const char* name, const glm::dvec2& value) {
    const glm::vec2 rounded(value);
    state.get<osg::GLExtensions>()->glUniform2fv(placeOf(state, name), 1, glm::value_ptr(rounded));
}

void setUniform(const osg::State& state, const char* name, double value) {
    state.get<osg::GLExtensions>()->glUniform1f(placeOf(state, name), static_cast<GLfloat>(value));
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
