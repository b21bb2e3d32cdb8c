// SPDX-License-Identifier: MIT
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/map/SpotMark.h>

#include <glm/matrix.hpp>

namespace gnomon {

std::string SpotMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    constexpr unsigned seenUnit = 0;
    osg::State& state = *renderInfo.getState();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect pixels = pixelsInScissor(viewport);
    if (pixels.empty()) return "";
    const FrameDepthCopy::Copy copy = resources->seen.copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    state.apply(resources->coneProgram.get());
    if (!hasProgram(state)) return noProgram;
    state.applyTextureAttribute(seenUnit, copy.texture);
    setUniform(state, "seen", int(seenUnit));
    setUniform(state, "rows", copy.rows);
    setUniform(state, "depthError", copy.error);
    setUniform(state, "coneFromPixel", coneFromScene * glm::inverse(clipFromScene) * clipFromPixel(viewport));
    pass.stencilEqual(bit, 0, bit);
    pass.drawQuad();
    state.apply();
    return "";
}

} // namespace gnomon
