// SPDX-License-Identifier: MIT
#include <gnomon/gl/MarkEdges.h>
#include <gnomon/gl/ShaderProgram.h>

#include <gnomon_shaders.h>

namespace gnomon {
namespace {

constexpr unsigned seenUnit = 0, marksUnit = 1, cutsUnit = 2;
constexpr unsigned endBit = 1;
constexpr GLfloat width = 3.0f; // of lines, so that all pixels that one cuts are drawn

void setTexture(osg::State& state, const char* name, unsigned unit, unsigned texture) {
    bindTexture(state, unit, texture);
    setUniform(state, name, int(unit));
}

} // namespace

MarkEdges::MarkEdges(Of of)
    : _of(of),
      _ends(quadProgram("gnomon ends", "", shaders::ends_frag)),
      _cuts(cutsProgram(of == Of::Sides ? "#define EXTRUDE\n" : "#define LINES\n#define CLIP\n")),
      _shares(quadProgram("gnomon shares", "", shaders::shares_frag)) {}

std::string MarkEdges::find(ScreenPass& pass, const Mark& mark, unsigned marks) const {
    osg::State& state = pass.state();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect pixels = pixelsInScissor(viewport), all = pixelsOf(viewport);
    const FrameDepths::Copy copy = _seen->copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    state.apply(_ends);
    if (!hasProgram(state)) return noProgram;
    setTexture(state, "marks", marksUnit, marks);
    pass.stencilEqual(endBit, 0, endBit);
    pass.drawQuad();
    state.apply(_cuts);
    if (!hasProgram(state)) return noProgram;
    setTexture(state, "marks", marksUnit, marks);
    state.applyTextureAttribute(seenUnit, copy.texture);
    setUniform(state, "seen", int(seenUnit));
    setUniform(state, "rows", copy.rows);
    setUniform(state, "doubt", copy.error.x);
    setUniform(state, "within",
               glm::dvec4(pixels.x, pixels.y, pixels.x + pixels.width - 1, pixels.y + pixels.height - 1));
    pass.stencilAny(endBit);
    pass.beginMost();
    glEnable(depthClamp);
    if (_of == Of::Lines) {
        setUniform(state, "viewport", glm::dvec4(all.x, all.y, all.width, all.height));
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        glLineWidth(width);
    }
    mark.drawEdges(pass);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glLineWidth(1.0f);
    state.haveAppliedAttribute(osg::StateAttribute::LINEWIDTH);
    state.haveAppliedAttribute(osg::StateAttribute::POLYGONMODE);
    glDisable(depthClamp);
    pass.endMix();
    bindTexture(state, marksUnit, 0);
    state.apply();
    return "";
}

std::string MarkEdges::draw(ScreenPass& pass, unsigned marks, unsigned cuts) const {
    osg::State& state = pass.state();
    state.apply(_shares);
    if (!hasProgram(state)) return noProgram;
    setTexture(state, "marks", marksUnit, marks);
    setTexture(state, "cuts", cutsUnit, cuts);
    pass.testDepth(GL_GREATER); // where something is seen
    glEnable(GL_ALPHA_TEST);
    glAlphaFunc(GL_LESS, 1.0f);
    pass.drawQuad(1.0);
    glDisable(GL_ALPHA_TEST);
    glDisable(GL_DEPTH_TEST);
    for (const unsigned unit : {marksUnit, cutsUnit}) bindTexture(state, unit, 0);
    state.apply();
    return "";
}

void MarkEdges::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& program : {_ends, _cuts, _shares}) program->resizeGLObjectBuffers(maxSize);
}

void MarkEdges::releaseGLObjects(osg::State* state) const {
    for (const auto& program : {_ends, _cuts, _shares}) program->releaseGLObjects(state);
    _seen->release(state);
}

} // namespace gnomon
