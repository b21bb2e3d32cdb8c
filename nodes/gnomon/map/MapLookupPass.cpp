// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/geometry/DrawnError.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/MapLookupPass.h>
#include <gnomon_shaders.h>

#include <OpenThreads/ScopedLock>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned seenUnit = 0, mapUnit = 1, rawUnit = 2, blocksUnit = 3;
constexpr GLenum maxVaryingComponents = 0x8B4B; // GL_MAX_VARYING_COMPONENTS
constexpr std::size_t placing = 4;              // vectors a map, by which a pixel finds its map
constexpr double border = 2.0;                  // texels at a tile's sides that a comparison may reach over

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

glm::dvec4 placeOf(const MapPicture::Tile& tile, int texels) {
    return {glm::dvec2(tile.corner), texels, border / texels};
}

glm::dvec4 errorOf(const MapError& error, double last) { return {error.depth, error.texels, error.steepest, last}; }

void addColumns(const glm::dmat4& matrix, int count, std::vector<glm::dvec4>& columns) {
    for (int i = 0; i < count; ++i) columns.push_back(matrix[i]);
}

bool isOdd(const PixelRect& p) { return ((p.x | p.y | (p.x + p.width) | (p.y + p.height)) & 1) != 0; }

/// How the shaders compare, by ShadowMapOptions::Filter.
constexpr const char* comparing[] = {"#define NEAREST\n", "#define BILINEAR\n",
                                     "#define BICUBIC\n#define SAMPLES 4.0\n",
                                     "#define BICUBIC\n#define FINE\n#define SAMPLES 16.0\n"};

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
    quad.map->bind(state, 0);
    const UncomparedSampler raw(state, 0);
    setUniform(state, "depths", 0);
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

MapPrograms::MapPrograms()
    : casterProgram(shaderProgram()), // for a clip distance costs a third more a vertex on llvmpipe
      casterByLampProgram(shaderProgram("#define NEAREST\n")),
      cutoutProgram(shaderProgram("#define NEAREST\n#define CUTOUT\n")),
      blocksProgram(quadProgram("gnomon blocks", "", shaders::blocks_frag)),
      coneProgram(quadProgram("gnomon cone", "#define CONE\n#define SURROUND\n", shaders::cone_frag)) {}

osg::ref_ptr<const osg::StateSet> MapPrograms::program(const std::string& defines, bool debugView) {
    Lock lock(_mutex);
    osg::ref_ptr<osg::StateSet>& set = _programs[{debugView, defines}];
    if (set) return set;
    const std::string looksUp = std::string(shaders::cone_frag) + shaders::map_filter_frag + shaders::map_frag;
    set = quadProgram("gnomon map", defines,
                      (shaders::map_place_frag + (debugView ? shaders::map_view_frag : looksUp)).c_str());
    return set;
}

std::vector<osg::ref_ptr<osg::StateSet>> MapPrograms::all() {
    Lock lock(_mutex);
    std::vector<osg::ref_ptr<osg::StateSet>> sets{casterProgram, casterByLampProgram, cutoutProgram, blocksProgram,
                                                  coneProgram};
    for (const auto& [what, set] : _programs) sets.push_back(set);
    return sets;
}

void MapPrograms::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& set : all()) set->resizeGLObjectBuffers(maxSize);
}

void MapPrograms::release(osg::State* state) {
    for (const auto& set : all()) set->releaseGLObjects(state);
    seen.release(state);
}

std::string MapLookupPass::draw(ScreenPass& pass, const Wanted& wanted) const {
    osg::State& state = pass.state();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect marked = pixelsInScissor(viewport);
    if (marked.empty()) return "";
    const PixelRect pixels = wholeQuads(marked, viewport);
    const std::string cause = showMap(pass.renderInfo());
    if (!cause.empty()) return cause;
    FrameDepthCopy::Copy copy = resources->seen.copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    copy.error.x *= 1.0 + pushedBack.y;
    copy.error.y += pushedBack.x;
    const std::string lack = penumbra ? map->updateBlocks(state, *resources->blocksProgram) : "";
    const bool wide = penumbra && lack.empty();
    const std::string interlaced = pass.isInterlaced() ? "#define INTERLACED\n" : "";
    state.apply(resources->program(definesOf(pixels, wide) + interlaced).get());
    if (!hasProgram(state)) return noProgram;
    map->bind(state, mapUnit); // after the program: osg::State takes textures away that are in none of its sets
    setUniform(state, "maps", int(mapUnit));
    if (soft) setUniform(state, "mapCount", int(lookUps.size()));
    setConstants(state, copy, wanted, pixels);
    wide ? drawWide(state, pass) : drawFragments(state, pass);
    state.apply();
    return lack;
}

std::string MapLookupPass::showMap(osg::RenderInfo& renderInfo) const {
    unsigned drawn = 0;
    const std::string cause = map->show(renderInfo, *picture, drawn);
    resources->passes += drawn;
    return cause;
}

/// Where something is seen, and is wanted.
void MapLookupPass::drawFragments(osg::State& state, ScreenPass& pass) const {
    pass.testDepth(GL_GREATER);
    pass.testAlpha();
    drawPolygon(state, outline, 1.0);
    glDisable(GL_ALPHA_TEST);
    glDisable(GL_DEPTH_TEST);
}

void MapLookupPass::drawWide(osg::State& state, ScreenPass& pass) const {
    map->bindBlocks(state, blocksUnit);
    map->bind(state, rawUnit);
    const UncomparedSampler raw(state, rawUnit);
    setUniform(state, "blocks", int(blocksUnit));
    setUniform(state, "depths", int(rawUnit));
    drawFragments(state, pass);
}

std::string MapLookupPass::definesOf(const PixelRect& pixels, bool wide) const {
    std::string text = mapDefines();
    text += soft ? "#define SOFT\n" : smooth ? "#define SMOOTH\n" : "#define HALVES\n";
    if (wide) text += "#define PENUMBRA\n";
    if (isOdd(pixels)) text += "#define ODD\n";
    return text;
}

std::string MapLookupPass::mapDefines() const {
    const std::size_t all = sharedConstants() + (placing + constantsOfMap()) * lookUps.size();
    const auto define = [](const char* name, std::size_t value) {
        return "#define " + (name + (" " + std::to_string(value))) + "\n";
    };
    return comparing[filter] + std::string(cascades ? "#define CASCADES\n" : "") +
           (coneFromScene ? "#define CONE\n" : "") + define("MAPS", lookUps.size()) +
           define("SHARED", sharedConstants()) + define("PLACING", placing) + define("FLATS", flatConstants(all)) +
           define("EACH", constantsOfMap()) + define("CONSTANTS", all);
}

std::vector<glm::dvec4> MapLookupPass::places() const {
    std::vector<glm::dvec4> result;
    for (const MapPicture::Tile& tile : picture->tiles) result.push_back(placeOf(tile, picture->size));
    return result;
}

std::vector<glm::dvec4> MapLookupPass::errors(MapError MapErrors::*which) const {
    std::vector<glm::dvec4> result;
    for (const MapLookUp& lookUp : lookUps) result.push_back(errorOf(lookUp.errors.*which, 0.0));
    return result;
}

std::size_t MapLookupPass::sharedConstants() const { return coneFromScene ? 9 : 5; }

std::size_t MapLookupPass::constantsOfMap() const { return soft ? 7 : 6; }

/// How many of all the vertices hand on: as many whole parts as OpenGL takes. Soft edges index them, if there are many maps.
std::size_t MapLookupPass::flatConstants(std::size_t all) const {
    const std::size_t most = static_cast<std::size_t>(glInteger(maxVaryingComponents)) / 4;
    const std::size_t searched = sharedConstants() + placing * lookUps.size();
    if (all <= most) return all;
    if (searched <= most && !soft) return searched;
    return sharedConstants() <= most ? sharedConstants() : 0;
}

void MapLookupPass::setConstants(osg::State& state, const FrameDepthCopy::Copy& copy, const Wanted& wanted,
                                 const PixelRect& pixels) const {
    const glm::dmat4 sceneFromPixel = glm::inverse(clipFromScene) * clipFromPixel(*state.getCurrentViewport());
    std::vector<glm::dvec4> constants{copy.error,
                                      glm::dvec4(1.0 / glm::dvec2(map->size), copy.rows),
                                      {wanted.below, wanted.blocked ? 1.0 : 0.0, wanted.factor, fades() ? 1.0 : 0.0},
                                      {pixels.x, pixels.y, pixels.x + pixels.width - 1, pixels.y + pixels.height - 1},
                                      drawnErrorOf(state, sceneFromPixel)};
    if (coneFromScene) addColumns(*coneFromScene * sceneFromPixel, 4, constants);
    std::vector<glm::dmat4> mapFromPixel;
    for (const MapLookUp& lookUp : lookUps) mapFromPixel.push_back(lookUp.mapFromScene * sceneFromPixel);
    for (const glm::dmat4& matrix : mapFromPixel) addColumns(matrix, 4, constants);
    for (std::size_t i = 0; i < lookUps.size(); ++i) addMap(i, mapFromPixel[i], constants);
    state.applyTextureAttribute(seenUnit, copy.texture);
    setUniform(state, "seen", int(seenUnit));
    setUniform(state, "constants", constants);
}

/// 1 / w is that row of the matrix times a pixel's place: of most projections it depends on e alone.
glm::dvec4 MapLookupPass::drawnErrorOf(const osg::State& state, const glm::dmat4& sceneFromPixel) const {
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const DrawnError off =
        drawnError(clipFromScene, toGlm(state.getProjectionMatrix()), viewport.width(), rounding, 0.0);
    const glm::dvec4 row = off.depth * glm::row(sceneFromPixel, 3);
    const auto most = [](double change, double start, double size) {
        return std::max(change * start, change * (start + size));
    };
    const double beside = most(row.x, viewport.x(), viewport.width()) + most(row.y, viewport.y(), viewport.height());
    return {row.w + beside, row.z, off.depth > 0.0 ? off.pixels / off.depth : 0.0, border / picture->size};
}

void MapLookupPass::addMap(std::size_t i, const glm::dmat4& mapFromPixel, std::vector<glm::dvec4>& constants) const {
    const MapLookUp& lookUp = lookUps[i];
    constants.push_back(placeOf(picture->tiles[i], picture->size));
    addColumns(glm::inverse(mapFromPixel), 3, constants);
    const MapSpread& spread = lookUp.spread;
    constants.push_back(errorOf(lookUp.errors.nearest, spread.penumbra.x));
    constants.push_back(errorOf(lookUp.errors.farthest, spread.penumbra.y));
    if (soft) constants.emplace_back(spread.nearest, spread.farthest);
}

void drawMapView(const MapLookupPass& quad, ShadowMapOptions::View view, ScreenPass& pass, int before) {
    constexpr const char* defines[] = {"", "#define PICTURE\n", "#define TEXELS\n", ""};
    osg::State& state = pass.state();
    if (view == ShadowMapOptions::NOTHING || (view != ShadowMapOptions::MAP && before > 0)) return;
    if (!quad.showMap(pass.renderInfo()).empty()) return; // which marking has said
    FrameDepthCopy::Copy copy;
    if (view != ShadowMapOptions::MAP)
        copy = quad.resources->seen.copy(state, pixelsInScissor(*state.getCurrentViewport()));
    if (!copy.cause.empty()) return; // the same
    state.apply(quad.resources->program(defines[int(view)] + quad.mapDefines(), true).get());
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

std::string MapMark::draw(ScreenPass& pass) const {
    using Want = ScreenPass::Want;
    constexpr double half = 0.5, allOfIt = 511.0 / 512.0, any = 2.0; // less than all is a step of eight bits
    switch (pass.wanted()) {
    case Want::Blocked:
        return quad.draw(pass, {half, false, 1.0});
    case Want::Touched:
        return quad.draw(pass, {allOfIt, false, 1.0});
    case Want::Factor:
        return quad.draw(pass, {quad.fades() ? allOfIt : half, false, pass.factor()});
    default:
        return quad.draw(pass, {any, pass.wanted() == Want::Blocking, 1.0});
    }
}

std::string SpotMark::draw(ScreenPass& pass) const {
    osg::State& state = pass.state();
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

std::string visibilityFunction(ShadowMapOptions::Filter filter) {
    return std::string("#version 130\n") + comparing[filter] +
           "uniform vec2 gnomon_mapTexel;\n#define maps gnomon_map\n#define texel gnomon_mapTexel\n"
           "#define lit gnomon_lit\n" +
           shaders::map_filter_frag + shaders::visibility_glsl;
}

} // namespace gnomon
