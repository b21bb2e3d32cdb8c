// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/MarkProgram.h>
#include <gnomon/gl/FrameDepths.h>
#include <gnomon/gl/ShaderProgram.h>

#include <glm/matrix.hpp>

namespace gnomon {
namespace {

/// Between them stands what the user gives.
constexpr const char* before = R"(
uniform sampler2D gnomon_seen;
uniform vec2 gnomon_rows;
uniform vec4 gnomon_wanted;
uniform mat4 gnomon_frameFromPixel;
)";
constexpr const char* after = R"(
void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    int row = int(gnomon_rows.x + gnomon_rows.y * float(here.y));
    float e = 1.0 - texelFetch(gnomon_seen, ivec2(here.x, row), 0).r;
    vec4 place = gnomon_frameFromPixel * vec4(gl_FragCoord.xy, e, 1.0);
    float arrives = e > 0.0 ? clamp(arrivesAt(place.xyz / place.w), 0.0, 1.0) : 1.0;
    if (arrives >= gnomon_wanted.x) discard;
    gl_FragColor = vec4(vec3(mix(gnomon_wanted.y, 1.0, arrives)), arrives);
}
)";

} // namespace

struct MarkProgram::Parts {
    osg::ref_ptr<osg::StateSet> program;
    std::shared_ptr<FrameDepths> seen = FrameDepths::shared();
};

MarkProgram::MarkProgram(const std::string& arrives) : _parts(new Parts) {
    _parts->program = quadProgram("gnomon own mark", "", (before + arrives + after).c_str());
}

MarkProgram::~MarkProgram() = default;

std::string MarkProgram::draw(ScreenPass& pass, const osg::Matrixd& clipFromFrame,
                              const osg::StateSet& uniforms) const {
    osg::State& state = pass.state();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect pixels = pixelsInScissor(viewport);
    if (pixels.empty()) return "";
    const FrameDepths::Copy copy = _parts->seen->copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    const osg::ref_ptr<osg::StateSet> set = new osg::StateSet(uniforms);
    set->merge(*_parts->program);
    state.apply(set);
    if (!hasProgram(state)) return noProgram;
    state.applyTextureAttribute(0, copy.texture);
    setUniform(state, "gnomon_seen", 0);
    setUniform(state, "gnomon_rows", copy.rows);
    setUniform(state, "gnomon_wanted", wantedOf(pass, true));
    setUniform(state, "gnomon_frameFromPixel", glm::inverse(toGlm(clipFromFrame)) * clipFromPixel(viewport));
    pass.drawQuad();
    state.apply();
    return "";
}

void MarkProgram::resizeGLObjectBuffers(unsigned maxSize) { _parts->program->resizeGLObjectBuffers(maxSize); }

void MarkProgram::releaseGLObjects(osg::State* state) const {
    _parts->program->releaseGLObjects(state);
    _parts->seen->release(state);
}

} // namespace gnomon
