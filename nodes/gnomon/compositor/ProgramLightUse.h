// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/LightUniform.h>

#include <osg/GLExtensions>
#include <osg/Program>
#include <osg/State>

#include <map>
#include <vector>

namespace gnomon {

/// Whether what is drawn in the state that is applied depends on lights, and so can lose one: by fixed function, by a
/// program that reads the colours of OpenGL's lights, or by uniforms that the user named.
class ProgramLightUse {
public:
    /// @param uniforms  of the user; must outlive this.
    ProgramLightUse(const osg::State& state, const std::vector<LightUniform>& uniforms)
        : _state(state), _uniforms(uniforms) {}

    /// True if it can lose all of `dark` (bit i: OpenGL light i).
    bool canLose(unsigned dark);

    /// Sets the named uniforms of these lights to 0 in the program in use.
    void darken(unsigned dark);
    /// Puts back what darken() changed.
    void restore();

private:
    using Program = osg::Program::PerContextProgram;
    struct DarkUniform {
        GLint location;
        int components;
        GLfloat value[4]; ///< that it had.
    };

    bool readsUniforms(const Program& program, unsigned dark) const;

    const osg::State& _state;
    const std::vector<LightUniform>& _uniforms;
    std::map<const Program*, bool> _readsColors;
    std::vector<DarkUniform> _changed;
};

} // namespace gnomon
