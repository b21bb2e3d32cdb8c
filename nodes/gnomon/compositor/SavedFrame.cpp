// SPDX-License-Identifier: MIT
#include <gnomon/compositor/SavedFrame.h>
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/ShaderProgram.h>

#include <gnomon_shaders.h>

namespace gnomon {

SavedFrame::SavedFrame() : _program(quadProgram("gnomon depths", "", shaders::depths_frag)) {}

SavedFrame::SavedFrame(const SavedFrame& other, const osg::CopyOp& copyOp)
    : osg::Object(other, copyOp), _program(quadProgram("gnomon depths", "", shaders::depths_frag)) {}

void SavedFrame::save(osg::State& state, const osg::Viewport& viewport) {
    const PixelRect all = pixelsOf(viewport);
    glScissor(all.x, all.y, all.width, all.height); // osg::State's default need not hold them
    state.haveAppliedAttribute(osg::StateAttribute::SCISSOR);
    _hasColors = _colors.save(state, viewport);
    _depths.drop(state);
    _depths.copy(state, all);
    state.apply();
}

std::string SavedFrame::drawDepths(ScreenPass& pass) {
    osg::State& state = pass.state();
    const FrameDepths::Copy copy = _depths.copy(state, pixelsOf(*state.getCurrentViewport()));
    if (!copy.cause.empty()) return copy.cause;
    state.apply(_program);
    const bool built = hasProgram(state);
    if (built) {
        state.applyTextureAttribute(0, copy.texture);
        setUniform(state, "seen", 0);
        setUniform(state, "rows", copy.rows);
        pass.writeFarDepth();
    }
    state.apply();
    return built ? "" : noProgram;
}

void SavedFrame::resizeGLObjectBuffers(unsigned maxSize) {
    _colors.resizeGLObjectBuffers(maxSize);
    _program->resizeGLObjectBuffers(maxSize);
}

void SavedFrame::releaseGLObjects(osg::State* state) const {
    _colors.release(state);
    _depths.release(state);
    _program->releaseGLObjects(state);
}

} // namespace gnomon
