// SPDX-License-Identifier: MIT
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/MapMark.h>
#include <gnomon_shaders.h>

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace gnomon {
namespace {

constexpr unsigned mapUnit = 0;

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
    quad.map->bind(state, mapUnit);
    const UncomparedSampler raw(state, mapUnit);
    setUniform(state, "depths", int(mapUnit));
    setUniform(state, "frame", glm::dvec4(frame.x, frame.y, frame.width, frame.height));
    pass.drawQuad();
}

constexpr unsigned mostMaps = 12; // as visibility.glsl has it

osg::Vec4f vec4(const glm::dvec4& v) { return {float(v.x), float(v.y), float(v.z), float(v.w)}; }

osg::ref_ptr<osg::Uniform> vectors(const char* name, const std::vector<glm::dvec4>& values) {
    osg::ref_ptr<osg::Uniform> uniform = new osg::Uniform(osg::Uniform::FLOAT_VEC4, name, mostMaps);
    for (unsigned i = 0; i < values.size(); ++i) uniform->setElement(i, vec4(values[i]));
    return uniform;
}

osg::ref_ptr<osg::Uniform> matrices(const char* name, const std::vector<glm::dmat4>& values) {
    osg::ref_ptr<osg::Uniform> uniform = new osg::Uniform(osg::Uniform::FLOAT_MAT4, name, mostMaps);
    for (unsigned i = 0; i < values.size(); ++i)
        uniform->setElement(i, osg::Matrixf(glm::value_ptr(glm::mat4(values[i]))));
    return uniform;
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

std::string SoftMapMark::markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    return markBelow(allOfIt, renderInfo, pass, bit);
}

std::string SoftMapMark::drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const {
    constexpr double any = 2.0;
    return quad.draw(renderInfo, pass, {any, share == Share::Blocked, 1.0});
}

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

ProgramMaps::ProgramMaps(unsigned unit) {
    state = new osg::StateSet;
    state->addUniform(new osg::Uniform("gnomon_map", int(unit)));
    state->addUniform(new osg::Uniform("gnomon_maps", 0));
}

ProgramMaps::ProgramMaps(const MapLookupPass& quad, const glm::dmat4& sceneFromEye, unsigned unit) : _quad(quad) {
    std::vector<glm::dmat4> mapFromEye;
    for (const MapLookUp& lookUp : quad.lookUps) mapFromEye.push_back(lookUp.mapFromScene * sceneFromEye);
    std::vector<glm::dvec4> farthest = quad.errors(&MapErrors::farthest);
    for (glm::dvec4& error : farthest) error.w = quad.cascades ? 1.0 : 0.0;
    state = new osg::StateSet;
    state->setTextureAttribute(unit, quad.map->texture());
    state->addUniform(new osg::Uniform("gnomon_map", int(unit)));
    state->addUniform(new osg::Uniform("gnomon_maps", int(quad.lookUps.size())));
    state->addUniform(new osg::Uniform("gnomon_mapTexel",
                                       osg::Vec2f(1.0f / float(quad.map->size.x), 1.0f / float(quad.map->size.y))));
    state->addUniform(matrices("gnomon_mapFromEye", mapFromEye));
    state->addUniform(vectors("gnomon_mapPlace", quad.places()));
    state->addUniform(vectors("gnomon_mapNear", quad.errors(&MapErrors::nearest)));
    state->addUniform(vectors("gnomon_mapFar", farthest));
}

std::string ProgramMaps::drawAhead(osg::RenderInfo& renderInfo) const {
    return _quad ? _quad->showMap(renderInfo) : "";
}

std::string visibilityFunction(const std::string& filter) {
    return "#version 130\n" + filter +
           "uniform vec2 gnomon_mapTexel;\n#define maps gnomon_map\n#define texel gnomon_mapTexel\n"
           "#define lit gnomon_lit\n" +
           shaders::map_filter_frag + shaders::visibility_glsl;
}

} // namespace gnomon
