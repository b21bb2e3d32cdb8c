// SPDX-License-Identifier: MIT
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/MapDebugView.h>

#include <cmath>

namespace gnomon {
namespace {

constexpr unsigned unit = 0;

/// A third as high as the view, one beside the other from the lower left corner on.
PixelRect frameOf(const MapLookupPass& quad, const osg::Viewport& viewport, int before) {
    const int height = static_cast<int>(viewport.height() / 3.0);
    const int width = static_cast<int>(std::lround(double(height) * quad.map->size.x / quad.map->size.y));
    return {static_cast<int>(viewport.x()) + before * width, static_cast<int>(viewport.y()), width, height};
}

void drawPicture(const MapLookupPass& quad, osg::State& state, ScreenPass& pass, int before) {
    if (!UncomparedSampler::isSupported(state)) return;
    const PixelRect frame = frameOf(quad, *state.getCurrentViewport(), before);
    glScissor(frame.x, frame.y, frame.width, frame.height);
    quad.map->bind(state, unit);
    const UncomparedSampler raw(state, unit);
    setUniform(state, "depths", int(unit));
    setUniform(state, "frame", glm::dvec4(frame.x, frame.y, frame.width, frame.height));
    pass.drawQuad();
}

} // namespace

void drawMapView(const MapLookupPass& quad, ShadowMapOptions::View view, osg::RenderInfo& renderInfo, ScreenPass& pass,
                 int before) {
    constexpr const char* defines[] = {"", "#define PICTURE\n", "#define TEXELS\n", ""};
    osg::State& state = *renderInfo.getState();
    if (view == ShadowMapOptions::NOTHING || (view != ShadowMapOptions::MAP && before > 0)) return;
    if (!quad.showMap(renderInfo).empty()) return; // which marking has said
    FrameDepthCopy::Copy copy;
    if (view != ShadowMapOptions::MAP)
        copy = quad.resources->seen.copy(state, pixelsInScissor(*state.getCurrentViewport()));
    if (!copy.cause.empty()) return; // the same
    state.apply(quad.resources->viewProgram(defines[int(view)] + quad.mapDefines()).get());
    if (!hasProgram(state)) return;
    pass.beginBlend();
    if (view == ShadowMapOptions::MAP) {
        drawPicture(quad, state, pass, before);
    } else {
        quad.setConstants(state, copy, {0.0, false, 1.0}, {});
        pass.drawQuad();
    }
    state.apply();
}

} // namespace gnomon
