// SPDX-License-Identifier: MIT
#include <gnomon/MapQuad.h>
#include <gnomon/MarkProgram.h>
#include <gnomon/RawSampler.h>
#include <gnomon/ScreenPass.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace gnomon {
namespace {

constexpr unsigned seenUnit = 0, mapUnit = 1, rawUnit = 2, blocksUnit = 3;
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

std::string MapQuad::draw(osg::RenderInfo& renderInfo, ScreenPass& pass, const Wanted& wanted) const {
    osg::State& state = *renderInfo.getState();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect marked = pixelsInScissor(viewport);
    if (marked.empty()) return "";
    const PixelRect pixels = wholeQuads(marked, viewport);
    const std::string cause = showMap(renderInfo);
    if (!cause.empty()) return cause;
    const SeenDepth::Copy copy = resources->seen.copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    const std::string lack = penumbra ? map->updateBlocks(state, *resources->blocksProgram) : "";
    const bool wide = penumbra && lack.empty();
    state.apply(resources->program(definesOf(pixels, wide)).get());
    if (!hasProgram(state)) return noProgram;
    map->bind(state, mapUnit); // after the program: osg::State takes textures away that are in none of its sets
    setPlaces(state, copy);
    setColumns(state);
    setUniform(state, "nearestError", errors(&MapErrors::nearest));
    setUniform(state, "farthestError", errors(&MapErrors::farthest));
    if (soft) setSpreads(state);
    setUniform(state, "wanted",
               glm::dvec4(wanted.below, wanted.blocked ? 1.0 : 0.0, wanted.factor, fades() ? 1.0 : 0.0));
    setUniform(state, "seenPixels",
               glm::dvec4(pixels.x, pixels.y, pixels.x + pixels.width - 1, pixels.y + pixels.height - 1));
    wide ? drawWide(state, pass) : drawFragments(state, pass);
    state.apply();
    return lack;
}

std::string MapQuad::showMap(osg::RenderInfo& renderInfo) const {
    unsigned drawn = 0;
    const std::string cause = map->show(renderInfo, *picture, drawn);
    resources->passes += drawn;
    return cause;
}

/// Where something is seen.
void MapQuad::drawFragments(osg::State& state, ScreenPass& pass) const {
    pass.testDepth(GL_GREATER);
    drawPolygon(state, outline, 1.0);
    glDisable(GL_DEPTH_TEST);
}

void MapQuad::drawWide(osg::State& state, ScreenPass& pass) const {
    map->bindBlocks(state, blocksUnit);
    map->bind(state, rawUnit);
    const RawSampler raw(state, rawUnit);
    setUniform(state, "blocks", int(blocksUnit));
    setUniform(state, "depths", int(rawUnit));
    drawFragments(state, pass);
}

std::string MapQuad::definesOf(const PixelRect& pixels, bool wide) const {
    std::string text = mapDefines();
    if (coneFromScene) text += "#define CONE\n";
    text += soft ? "#define SOFT\n" : "#define HALVES\n";
    if (smooth) text += "#define SMOOTH\n";
    if (wide) text += "#define PENUMBRA\n";
    if (isOdd(pixels)) text += "#define ODD\n";
    return text;
}

glm::dmat4 MapQuad::sceneFromPixel(const osg::State& state) const {
    return glm::inverse(clipFromScene) * clipFromPixel(*state.getCurrentViewport());
}

void MapQuad::setPlaces(osg::State& state, const SeenDepth::Copy& copy) const {
    std::vector<glm::dmat4> mapFromPixel;
    for (const MapLookUp& lookUp : lookUps) mapFromPixel.push_back(lookUp.mapFromScene * sceneFromPixel(state));
    resources->seen.bind(state, seenUnit);
    setUniform(state, "seen", int(seenUnit));
    setUniform(state, "depthError", copy.error);
    setUniform(state, "mapFromPixel", mapFromPixel);
    setUniform(state, "place", places());
}

void MapQuad::setColumns(osg::State& state) const {
    std::vector<glm::dvec4> columns[3];
    for (const MapLookUp& lookUp : lookUps) {
        const glm::dmat4 pixelFromMap = glm::inverse(lookUp.mapFromScene * sceneFromPixel(state));
        for (int axis = 0; axis < 3; ++axis) columns[axis].push_back(pixelFromMap[axis]);
    }
    if (coneFromScene) setUniform(state, "coneFromPixel", *coneFromScene * sceneFromPixel(state));
    setUniform(state, "maps", int(mapUnit));
    setUniform(state, "texel", 1.0 / glm::dvec2(map->size));
    setUniform(state, "pixelFromMapX", columns[0]);
    setUniform(state, "pixelFromMapY", columns[1]);
    setUniform(state, "pixelFromMapZ", columns[2]);
}

std::string MapQuad::mapDefines() const {
    return defines + (cascades ? "#define CASCADES\n" : "") + "#define MAPS " + std::to_string(lookUps.size()) + "\n";
}

std::vector<glm::dvec4> MapQuad::places() const {
    std::vector<glm::dvec4> result;
    for (const MapPicture::Tile& tile : picture->tiles)
        result.emplace_back(glm::dvec2(tile.corner), picture->size, border / picture->size);
    return result;
}

std::vector<glm::dvec4> MapQuad::errors(MapError MapErrors::*which) const {
    std::vector<glm::dvec4> result;
    for (const MapLookUp& lookUp : lookUps) {
        const MapError& error = lookUp.errors.*which;
        result.emplace_back(error.depth, error.texels, error.steepest, 0.0);
    }
    return result;
}

void MapQuad::setSpreads(osg::State& state) const {
    std::vector<glm::dvec4> discs;
    std::vector<glm::dvec2> penumbras;
    for (const MapLookUp& lookUp : lookUps) {
        discs.emplace_back(lookUp.spread.nearest, lookUp.spread.farthest);
        penumbras.push_back(lookUp.spread.penumbra);
    }
    setUniform(state, "discs", discs);
    setUniform(state, "penumbra", penumbras);
}

} // namespace gnomon
