// SPDX-License-Identifier: MIT
#pragma once
#include <osg/GLExtensions>
#include <osg/State>

namespace gnomon {

/// The depth texture on a unit is read as it is, not compared; put back at its end. osg::Sampler (3.6) binds a name that it
/// has deleted.
class UncomparedSampler {
public:
    static bool isSupported(const osg::State& state) {
        return osg::isGLExtensionOrVersionSupported(state.getContextID(), "GL_ARB_sampler_objects", 3.3f) &&
               state.get<osg::GLExtensions>()->glGenSamplers;
    }

    UncomparedSampler(const osg::State& state, unsigned unit) : _gl(*state.get<osg::GLExtensions>()), _unit(unit) {
        _gl.glGenSamplers(1, &_sampler);
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            _gl.glSamplerParameteri(_sampler, filter, GL_NEAREST);
        _gl.glBindSampler(_unit, _sampler);
    }
    ~UncomparedSampler() {
        _gl.glBindSampler(_unit, 0);
        _gl.glDeleteSamplers(1, &_sampler);
    }
    UncomparedSampler(const UncomparedSampler&) = delete;
    UncomparedSampler& operator=(const UncomparedSampler&) = delete;

private:
    const osg::GLExtensions& _gl;
    const unsigned _unit;
    GLuint _sampler = 0;
};

} // namespace gnomon
