// SPDX-License-Identifier: MIT
#include <gnomon/FramebufferBindings.h>
#include <gnomon/MapMark.h>
#include <gnomon/MarkProgram.h>
#include <gnomon/ScreenPass.h>

#include <gnomon_shaders.h>

#include <OpenThreads/ScopedLock>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned seenUnit = 0, mapUnit = 1;
constexpr double border = 2.0; // texels at a tile's sides that a comparison may reach over

struct Span {
    int from, to;
};

/// Pixels of a viewport along one axis. One that begins left of the window has no pixels there.
Span seenSpan(double origin, double size) { return {std::max(int(origin), 0), int(origin + size)}; }

/// Whole quads of pixels, which OpenGL shades together, as far as they are in view.
Span wholeQuads(int from, int size, const Span& view) {
    return {std::max(from & ~1, view.from), std::min((from + size + 1) & ~1, view.to)};
}

PixelRect wholeQuads(const PixelRect& pixels, const osg::Viewport& viewport) {
    const Span x = wholeQuads(pixels.x, pixels.width, seenSpan(viewport.x(), viewport.width()));
    const Span y = wholeQuads(pixels.y, pixels.height, seenSpan(viewport.y(), viewport.height()));
    return {x.from, y.from, x.to - x.from, y.to - y.from};
}

bool isOdd(const PixelRect& p) { return ((p.x | p.y | (p.x + p.width) | (p.y + p.height)) & 1) != 0; }

} // namespace

glm::dmat4 clipFromPixel(const osg::Viewport& viewport) {
    const glm::dvec3 half(viewport.width() / 2.0, viewport.height() / 2.0, -0.5);
    const glm::dmat4 atCorner = glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, -1.0, 1.0));
    return glm::translate(glm::scale(atCorner, 1.0 / half), glm::dvec3(-viewport.x(), -viewport.y(), 0.0));
}

MapResources::MapResources()
    : casterProgram(markProgram()),
      cutoutProgram(markProgram("#define CUTOUT\n")),
      coneProgram(quadProgram("gnomon cone", "#define CONE\n#define SURROUND\n", shaders::cone_frag)) {}

osg::ref_ptr<const osg::StateSet> MapResources::program(const std::string& defines) {
    Lock lock(_mutex);
    osg::ref_ptr<osg::StateSet>& set = _programs[defines];
    if (!set) set = quadProgram("gnomon map", defines + shaders::cone_frag, shaders::map_frag);
    return set;
}

void MapResources::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& set : {casterProgram, cutoutProgram, coneProgram}) set->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    for (const auto& [defines, set] : _programs) set->resizeGLObjectBuffers(maxSize);
}

void MapResources::release(osg::State* state) {
    for (const auto& set : {casterProgram, cutoutProgram, coneProgram}) set->releaseGLObjects(state);
    seen.release(state);
    Lock lock(_mutex);
    for (const auto& [defines, set] : _programs) set->releaseGLObjects(state);
}

std::string MapMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect marked = pixelsInScissor(viewport);
    if (marked.empty()) return "";
    const PixelRect pixels = wholeQuads(marked, viewport);
    unsigned drawn = 0;
    const std::string cause = map->show(renderInfo, *picture, drawn);
    resources->passes += drawn;
    if (!cause.empty()) return cause;
    const SeenDepth::Copy copy = resources->seen.copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    state.apply(resources->program(isOdd(pixels) ? defines + "#define ODD\n" : defines).get());
    if (!hasProgram(state)) return noProgram;
    map->bind(state, mapUnit); // after the program: osg::State takes textures away that are in none of its sets
    resources->seen.bind(state, seenUnit);
    setUniforms(state, copy.error);
    if (isOdd(pixels))
        setUniform(state, "seenPixels",
                   glm::dvec4(pixels.x, pixels.y, pixels.x + pixels.width - 1, pixels.y + pixels.height - 1));
    pass.stencilEqual(bit, 0, bit);
    pass.drawQuad();
    state.apply();
    return "";
}

void MapMark::setUniforms(osg::State& state, const glm::dvec4& depthError) const {
    const glm::dmat4 sceneFromPixel = glm::inverse(clipFromScene) * clipFromPixel(*state.getCurrentViewport());
    std::vector<glm::dmat4> mapFromPixel;
    std::vector<glm::dvec4> columns[3], places, nearest, farthest;
    const auto add = [](std::vector<glm::dvec4>& to, const MapError& error) {
        to.emplace_back(error.depth, error.texels, error.steepest, 0.0);
    };
    for (std::size_t i = 0; i < lookUps.size(); ++i) {
        const glm::dmat4 matrix = lookUps[i].mapFromScene * sceneFromPixel, back = glm::inverse(matrix);
        mapFromPixel.push_back(matrix);
        for (int axis = 0; axis < 3; ++axis) columns[axis].push_back(back[axis]);
        places.emplace_back(glm::dvec2(picture->tiles[i].corner), picture->size, border / picture->size);
        add(nearest, lookUps[i].errors.nearest);
        add(farthest, lookUps[i].errors.farthest);
    }
    if (coneFromScene) setUniform(state, "coneFromPixel", *coneFromScene * sceneFromPixel);
    setUniform(state, "seen", int(seenUnit));
    setUniform(state, "maps", int(mapUnit));
    setUniform(state, "texel", 1.0 / glm::dvec2(map->size));
    setUniform(state, "depthError", depthError);
    setUniform(state, "mapFromPixel", mapFromPixel);
    setUniform(state, "pixelFromMapX", columns[0]);
    setUniform(state, "pixelFromMapY", columns[1]);
    setUniform(state, "pixelFromMapZ", columns[2]);
    setUniform(state, "place", places);
    setUniform(state, "nearestError", nearest);
    setUniform(state, "farthestError", farthest);
}

} // namespace gnomon
