// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/geometry/DrawnError.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/MapLookup.h>
#include <gnomon_shaders.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr unsigned seenUnit = 0, mapUnit = 1, rawUnit = 2, blocksUnit = 3;
constexpr GLenum maxVaryingComponents = 0x8B4B; // GL_MAX_VARYING_COMPONENTS
constexpr std::size_t placing = 4;              // vectors a map, by which a pixel finds its map
constexpr double border = 2.0;                  // texels at a tile's sides that a comparison may reach over

/// Whole quads of pixels, which OpenGL shades together, as far as they are in view. What is left of the window or below it is no
/// pixel.
PixelRect wholeQuads(const PixelRect& pixels, const osg::Viewport& viewport) {
    const int endX = std::min((pixels.x + pixels.width + 1) & ~1, int(viewport.x() + viewport.width())),
              endY = std::min((pixels.y + pixels.height + 1) & ~1, int(viewport.y() + viewport.height())),
              x = std::max({pixels.x & ~1, int(viewport.x()), 0}), y = std::max({pixels.y & ~1, int(viewport.y()), 0});
    return {x, y, endX - x, endY - y};
}

glm::dvec4 placeOf(const MapPicture::Tile& tile, int texels) {
    return {glm::dvec2(tile.corner), texels, border / texels};
}

glm::dvec4 errorOf(const MapError& error, double last) { return {error.depth, error.texels, error.steepest, last}; }

bool isOdd(const PixelRect& p) { return ((p.x | p.y | (p.x + p.width) | (p.y + p.height)) & 1) != 0; }

/// How the shaders compare, by ShadowMapOptions::Filter.
constexpr const char* comparing[] = {"", "", "#define BICUBIC\n#define SAMPLES 4.0\n",
                                     "#define BICUBIC\n#define FINE\n#define SAMPLES 16.0\n"};

/// How many vectors of a map's program the vertices hand on: as many as OpenGL takes of those that all maps share, those by which
/// a pixel finds its map, too, or all.
std::size_t flatConstants(std::size_t shared, std::size_t searched, std::size_t all) {
    const std::size_t most = static_cast<std::size_t>(glInteger(maxVaryingComponents)) / 4;
    for (const std::size_t part : {all, searched, shared})
        if (part <= most) return part;
    return 0;
}

} // namespace

std::string MapLookup::draw(ScreenPass& pass) const {
    osg::State& state = pass.state();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect marked = pixelsInScissor(viewport);
    if (marked.empty()) return "";
    const PixelRect pixels = wholeQuads(marked, viewport);
    const std::string cause = showMap(pass.renderInfo());
    if (!cause.empty()) return cause;
    FrameDepthCopy::Copy copy = programs->seen.copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    copy.error.x *= 1.0 + pushedBack.y;
    copy.error.y += pushedBack.x;
    const bool penumbra = picture->tiles.front().spread.penumbra.x > 0.0;
    const std::string lack = penumbra ? map->updateBlocks(state, *programs) : "";
    const bool wide = penumbra && lack.empty();
    const std::string defines = mapDefines() +
                                (isSoft()     ? "#define SOFT\n"
                                 : isSmooth() ? "#define SMOOTH\n"
                                              : "#define HALVES\n") +
                                (wide ? "#define PENUMBRA\n" : "") + (isOdd(pixels) ? "#define ODD\n" : "") +
                                (pass.isInterlaced() ? "#define INTERLACED\n" : "");
    state.apply(programs->program(defines).get());
    if (!hasProgram(state)) return noProgram;
    map->bind(state, mapUnit); // after the program: osg::State takes textures away that are in none of its sets
    setUniform(state, "maps", int(mapUnit));
    if (isSoft()) setUniform(state, "mapCount", int(picture->tiles.size()));
    setConstants(state, copy, wantedBy(pass), pixels);
    std::optional<UncomparedSampler> raw;
    if (wide) {
        map->bindBlocks(state, blocksUnit);
        map->bind(state, rawUnit);
        raw.emplace(state, rawUnit);
        setUniform(state, "blocks", int(blocksUnit));
        setUniform(state, "depths", int(rawUnit));
    }
    pass.testDepth(GL_GREATER); // where something is seen
    pass.testAlpha();           // and is wanted
    drawPolygon(state, outline, 1.0);
    glDisable(GL_ALPHA_TEST);
    glDisable(GL_DEPTH_TEST);
    raw.reset();
    state.apply();
    return lack;
}

/// See map.frag: less than all of the light is a step of eight bits.
glm::dvec4 MapLookup::wantedBy(const ScreenPass& pass) const {
    using Want = ScreenPass::Want;
    constexpr double half = 0.5, allOfIt = 511.0 / 512.0, any = 2.0;
    const bool fades = kind() == Kind::Fades;
    const double below = pass.wanted() == Want::Blocked   ? half
                         : pass.wanted() == Want::Touched ? allOfIt
                         : pass.wanted() == Want::Factor  ? (fades ? allOfIt : half)
                                                          : any;
    return {below, pass.wanted() == Want::Blocking ? 1.0 : 0.0, pass.wanted() == Want::Factor ? pass.factor() : 1.0f,
            fades ? 1.0 : 0.0};
}

/// Of map_place.frag. Soft edges index what a pixel finds its map by, if there are many maps: no varyings can be.
std::string MapLookup::mapDefines() const {
    const auto define = [](const char* name, std::size_t value) {
        return "#define " + (name + (" " + std::to_string(value))) + "\n";
    };
    const std::size_t maps = picture->tiles.size(), shared = coneFromScene ? 9 : 5, each = isSoft() ? 7 : 6;
    const std::size_t searched = shared + placing * maps, all = searched + each * maps;
    return comparing[settings.filter] + std::string(picture->divided ? "#define CASCADES\n" : "") +
           (coneFromScene ? "#define CONE\n" : "") + define("MAPS", maps) + define("SHARED", shared) +
           define("PLACING", placing) + define("FLATS", flatConstants(shared, isSoft() ? shared : searched, all)) +
           define("EACH", each) + define("CONSTANTS", all);
}

/// The maps and the frame's depths, for map_place.frag: as many vectors as mapDefines() says.
void MapLookup::setConstants(osg::State& state, const FrameDepthCopy::Copy& copy, const glm::dvec4& wanted,
                             const PixelRect& pixels) const {
    const glm::dmat4 sceneFromPixel = glm::inverse(clipFromScene) * clipFromPixel(*state.getCurrentViewport());
    std::vector<glm::dvec4> constants{copy.error,
                                      glm::dvec4(1.0 / glm::dvec2(map->size), copy.rows),
                                      wanted,
                                      {pixels.x, pixels.y, pixels.x + pixels.width - 1, pixels.y + pixels.height - 1},
                                      drawnErrorOf(state, sceneFromPixel)};
    const auto add = [&constants](const glm::dmat4& matrix, int columns) {
        for (int i = 0; i < columns; ++i) constants.push_back(matrix[i]);
    };
    if (coneFromScene) add(*coneFromScene * sceneFromPixel, 4);
    for (const MapPicture::Tile& tile : picture->tiles) add(tile.mapFromScene * sceneFromPixel, 4);
    for (const MapPicture::Tile& tile : picture->tiles) {
        constants.push_back(placeOf(tile, picture->size));
        add(glm::inverse(tile.mapFromScene * sceneFromPixel), 3);
        constants.push_back(errorOf(tile.errors.nearest, tile.spread.penumbra.x));
        constants.push_back(errorOf(tile.errors.farthest, tile.spread.penumbra.y));
        if (isSoft()) constants.emplace_back(tile.spread.nearest, tile.spread.farthest);
    }
    state.applyTextureAttribute(seenUnit, copy.texture);
    setUniform(state, "seen", int(seenUnit));
    setUniform(state, "constants", constants);
}

/// 1 / w is that row of the matrix times a pixel's place: of most projections it depends on e alone.
glm::dvec4 MapLookup::drawnErrorOf(const osg::State& state, const glm::dmat4& sceneFromPixel) const {
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

void MapLookup::drawView(ScreenPass& pass, int before) const {
    osg::State& state = pass.state();
    const bool ofMaps = settings.view == ShadowMapOptions::MAP;
    if (!ofMaps && before > 0) return;
    if (!showMap(pass.renderInfo()).empty()) return; // which marking has said
    FrameDepthCopy::Copy copy;
    if (!ofMaps) copy = programs->seen.copy(state, pixelsInScissor(*state.getCurrentViewport()));
    if (!copy.cause.empty()) return; // the same
    const char* view = ofMaps                                      ? "#define PICTURE\n"
                       : settings.view == ShadowMapOptions::TEXELS ? "#define TEXELS\n"
                                                                   : "";
    state.apply(programs->program(view + mapDefines(), true).get());
    if (!hasProgram(state)) return;
    pass.beginBlend();
    if (ofMaps) {
        drawPicture(state, pass, before);
    } else {
        setConstants(state, copy, {}, {});
        pass.drawQuad();
    }
    state.apply();
}

/// A third as high as the view, one light's beside the other's from the lower left corner on.
void MapLookup::drawPicture(osg::State& state, ScreenPass& pass, int before) const {
    if (!UncomparedSampler::isSupported(state)) return;
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const int height = static_cast<int>(viewport.height() / 3.0);
    const int width = static_cast<int>(std::lround(double(height) * map->size.x / map->size.y));
    const int x = static_cast<int>(viewport.x()) + before * width, y = static_cast<int>(viewport.y());
    glScissor(x, y, width, height);
    map->bind(state, 0);
    const UncomparedSampler raw(state, 0);
    setUniform(state, "depths", 0);
    setUniform(state, "frame", glm::dvec4(x, y, width, height));
    pass.drawQuad();
}

namespace {

class SpotMark : public Mark {
public:
    explicit SpotMark(const MapLookup& lookup) : _lookup(&lookup) {}

    std::string draw(ScreenPass& pass) const override {
        osg::State& state = pass.state();
        const osg::Viewport& viewport = *state.getCurrentViewport();
        const PixelRect pixels = pixelsInScissor(viewport);
        if (pixels.empty()) return "";
        const FrameDepthCopy::Copy copy = _lookup->programs->seen.copy(state, pixels);
        if (!copy.cause.empty()) return copy.cause;
        state.apply(_lookup->programs->cone);
        if (!hasProgram(state)) return noProgram;
        state.applyTextureAttribute(seenUnit, copy.texture);
        setUniform(state, "seen", int(seenUnit));
        setUniform(state, "rows", copy.rows);
        setUniform(state, "depthError", copy.error);
        setUniform(state, "coneFromPixel",
                   *_lookup->coneFromScene * glm::inverse(_lookup->clipFromScene) * clipFromPixel(viewport));
        pass.drawQuad();
        state.apply();
        return "";
    }
    bool relightsOnly() const override { return true; }

private:
    const osg::ref_ptr<const MapLookup> _lookup;
};

class ProgramMaps : public ProgramMark {
public:
    ProgramMaps(const MapLookup& lookup, const glm::dmat4& sceneFromEye) : _lookup(&lookup) {
        const std::size_t maps = lookup.picture ? lookup.picture->tiles.size() : 0;
        state = new osg::StateSet;
        state->addUniform(new osg::Uniform("gnomon_map", lookup.settings.programUnit));
        state->addUniform(new osg::Uniform("gnomon_maps", int(maps)));
        if (maps == 0) return;
        state->setTextureAttribute(unsigned(lookup.settings.programUnit), lookup.map->texture());
        const osg::Vec2f size(float(lookup.map->size.x), float(lookup.map->size.y));
        state->addUniform(new osg::Uniform("gnomon_mapTexel", osg::Vec2f(1.0f / size.x(), 1.0f / size.y())));
        osg::Uniform &fromEye = add(osg::Uniform::FLOAT_MAT4, "gnomon_mapFromEye"),
                     &place = add(osg::Uniform::FLOAT_VEC4, "gnomon_mapPlace"),
                     &near = add(osg::Uniform::FLOAT_VEC4, "gnomon_mapNear"),
                     &far = add(osg::Uniform::FLOAT_VEC4, "gnomon_mapFar");
        for (unsigned i = 0; i < maps; ++i) {
            const MapPicture::Tile& tile = lookup.picture->tiles[i];
            fromEye.setElement(i, osg::Matrixf(glm::value_ptr(glm::mat4(tile.mapFromScene * sceneFromEye))));
            place.setElement(i, vec4(placeOf(tile, lookup.picture->size)));
            near.setElement(i, vec4(errorOf(tile.errors.nearest, 0.0)));
            far.setElement(i, vec4(errorOf(tile.errors.farthest, lookup.picture->divided ? 1.0 : 0.0)));
        }
    }

    std::string drawAhead(osg::RenderInfo& renderInfo) const override {
        return _lookup->picture ? _lookup->showMap(renderInfo) : "";
    }

private:
    osg::Uniform& add(osg::Uniform::Type type, const char* name) {
        constexpr unsigned mostMaps = 12; // as visibility.glsl has it
        const osg::ref_ptr<osg::Uniform> uniform = new osg::Uniform(type, name, mostMaps);
        state->addUniform(uniform);
        return *uniform;
    }
    static osg::Vec4f vec4(const glm::dvec4& v) { return {float(v.x), float(v.y), float(v.z), float(v.w)}; }

    const osg::ref_ptr<const MapLookup> _lookup;
};

} // namespace

osg::ref_ptr<Mark> spotMark(const MapLookup& lookup) { return new SpotMark(lookup); }

osg::ref_ptr<Mark> programMaps(const MapLookup& lookup, const glm::dmat4& sceneFromEye) {
    return new ProgramMaps(lookup, sceneFromEye);
}

std::string visibilityFunction(ShadowMapOptions::Filter filter) {
    return std::string("#version 130\n") + comparing[filter] +
           "uniform vec2 gnomon_mapTexel;\n#define maps gnomon_map\n#define texel gnomon_mapTexel\n"
           "#define lit gnomon_lit\n" +
           shaders::map_filter_frag + shaders::visibility_glsl;
}

} // namespace gnomon
