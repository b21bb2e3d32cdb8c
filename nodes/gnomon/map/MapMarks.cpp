// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/geometry/DrawnError.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/MapMarks.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr unsigned seenUnit = 0, mapUnit = 1, rawUnit = 2, blocksUnit = 3;
constexpr double reachedOver = 2.0; // texels at a tile's sides that a comparison may reach over

glm::dvec4 placeOf(const MapPicture::Tile& tile, int texels) {
    return {glm::dvec2(tile.corner), texels, reachedOver / texels};
}

glm::dvec4 errorOf(const MapError& error, double last) { return {error.depth, error.texels, error.steepest, last}; }

void setSeen(osg::State& state, const FrameDepths::Copy& copy, const MapConstants& constants) {
    state.applyTextureAttribute(seenUnit, copy.texture);
    setUniform(state, "seen", int(seenUnit));
    setUniform(state, "constants", constants.values());
}

bool isOdd(const PixelRect& p) { return ((p.x | p.y | (p.x + p.width) | (p.y + p.height)) & 1) != 0; }

class SpotMark : public Mark {
public:
    SpotMark(const osg::ref_ptr<MapPrograms>& programs, const LookupPlaces& places)
        : _programs(programs), _places(places) {
        relightsOnly = true;
    }

    std::string draw(ScreenPass& pass) const override {
        osg::State& state = pass.state();
        const osg::Viewport& viewport = *state.getCurrentViewport();
        const PixelRect pixels = pixelsInScissor(viewport);
        if (pixels.empty()) return "";
        const FrameDepths::Copy copy = _programs->seen->copy(state, pixels);
        if (!copy.cause.empty()) return copy.cause;
        state.apply(_programs->cone);
        if (!hasProgram(state)) return noProgram;
        state.applyTextureAttribute(seenUnit, copy.texture);
        setUniform(state, "seen", int(seenUnit));
        setUniform(state, "rows", copy.rows);
        setUniform(state, "depthError", copy.error);
        setUniform(state, "coneFromPixel",
                   *_places.coneFromScene * glm::inverse(_places.clipFromScene) * clipFromPixel(viewport));
        pass.drawQuad();
        state.apply();
        return "";
    }

private:
    const osg::ref_ptr<MapPrograms> _programs;
    const LookupPlaces _places;
};

class ProgramMaps : public ProgramMark {
public:
    ProgramMaps(int textureUnit, const std::optional<MapsInView>& maps, const glm::dmat4& sceneFromEye) : _maps(maps) {
        state = new osg::StateSet;
        state->addUniform(new osg::Uniform("gnomon_map", textureUnit));
        state->addUniform(new osg::Uniform("gnomon_maps", maps ? int(maps->picture->tiles.size()) : 0));
        if (!maps) return;
        state->setTextureAttribute(unsigned(textureUnit), maps->map->texture());
        const osg::Vec2f size(float(maps->map->size.x), float(maps->map->size.y));
        state->addUniform(new osg::Uniform("gnomon_mapTexel", osg::Vec2f(1.0f / size.x(), 1.0f / size.y())));
        osg::Uniform &fromEye = add(osg::Uniform::FLOAT_MAT4, "gnomon_mapFromEye"),
                     &place = add(osg::Uniform::FLOAT_VEC4, "gnomon_mapPlace"),
                     &near = add(osg::Uniform::FLOAT_VEC4, "gnomon_mapNear"),
                     &far = add(osg::Uniform::FLOAT_VEC4, "gnomon_mapFar");
        const MapPicture& picture = *maps->picture;
        for (unsigned i = 0; i < picture.tiles.size(); ++i) {
            const MapPicture::Tile& tile = picture.tiles[i];
            fromEye.setElement(i, osg::Matrixf(glm::value_ptr(glm::mat4(tile.mapFromScene * sceneFromEye))));
            place.setElement(i, vec4(placeOf(tile, picture.size)));
            near.setElement(i, vec4(errorOf(tile.errors.nearest, 0.0)));
            far.setElement(i, vec4(errorOf(tile.errors.farthest, picture.divided ? 1.0 : 0.0)));
        }
    }

    std::string drawAhead(osg::RenderInfo& renderInfo) const override { return _maps ? _maps->show(renderInfo) : ""; }

private:
    osg::Uniform& add(osg::Uniform::Type type, const char* name) {
        constexpr unsigned mostMaps = 12; // as visibility.glsl has it
        const osg::ref_ptr<osg::Uniform> uniform = new osg::Uniform(type, name, mostMaps);
        state->addUniform(uniform);
        return *uniform;
    }
    static osg::Vec4f vec4(const glm::dvec4& v) { return {float(v.x), float(v.y), float(v.z), float(v.w)}; }

    const std::optional<MapsInView> _maps;
};

} // namespace

MapLookup::MapLookup(const ShadowMapOptions& options, const LookupPlaces& places, const MapsInView& maps)
    : _options(options), _places(places), _maps(maps) {
    screenBounds = maps.bounds;
    canDarken = true;
    hasDebugView = options.view != ShadowMapOptions::NOTHING;
}

std::string MapLookup::draw(ScreenPass& pass) const {
    osg::State& state = pass.state();
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const PixelRect marked = pixelsInScissor(viewport);
    if (marked.empty()) return "";
    const PixelRect pixels = wholeQuads(marked, viewport);
    const std::string cause = _maps.show(pass.renderInfo());
    if (!cause.empty()) return cause;
    FrameDepths::Copy copy = _maps.programs->seen->copy(state, pixels);
    if (!copy.cause.empty()) return copy.cause;
    copy.error.x *= 1.0 + _places.pushedBack.y;
    copy.error.y += _places.pushedBack.x;
    MapUse marking = use(false);
    const bool penumbra = _maps.picture->tiles.front().spread.penumbra.x > 0.0;
    const std::string lack = penumbra ? _maps.map->updateBlocks(state, *_maps.programs) : "";
    marking.penumbra = penumbra && lack.empty();
    marking.odd = isOdd(pixels);
    marking.interlaced = pass.isInterlaced();
    const MapConstants constants = constantsOf(state, copy, wantedOf(pass, _options.fades()), pixels);
    state.apply(_maps.programs->program(marking, constants).get());
    if (!hasProgram(state)) return noProgram;
    _maps.map->bind(state, mapUnit); // after the program: osg::State takes textures away that are in none of its sets
    setUniform(state, "maps", int(mapUnit));
    if (_options.edges == ShadowMapOptions::SOFT) setUniform(state, "mapCount", int(_maps.picture->tiles.size()));
    setSeen(state, copy, constants);
    std::optional<UncomparedSampler> raw;
    if (marking.penumbra) {
        _maps.map->bindBlocks(state, blocksUnit);
        _maps.map->bind(state, rawUnit);
        raw.emplace(state, rawUnit);
        setUniform(state, "blocks", int(blocksUnit));
        setUniform(state, "depths", int(rawUnit));
    }
    pass.testDepth(GL_GREATER); // where something is seen
    glEnable(
        GL_ALPHA_TEST); // and is wanted: `discard` costs on llvmpipe, which skips blocks of which nothing passes, but
    glAlphaFunc(GL_LESS, 1.0f); // no block of a program that discards
    drawPolygon(state, _maps.outline, 1.0);
    glDisable(GL_ALPHA_TEST);
    glDisable(GL_DEPTH_TEST);
    raw.reset();
    state.apply();
    return lack;
}

MapUse MapLookup::use(bool shows) const {
    MapUse use;
    use.options = _options;
    use.shows = shows;
    use.cascades = _maps.picture->divided;
    use.cone = _places.coneFromScene.has_value();
    return use;
}

/// The maps and the frame's depths, under the names of the shaders.
/// @param wanted  see map.frag.
MapConstants MapLookup::constantsOf(const osg::State& state, const FrameDepths::Copy& copy, const glm::dvec4& wanted,
                                    const PixelRect& pixels) const {
    const glm::dmat4 sceneFromPixel = glm::inverse(_places.clipFromScene) * clipFromPixel(*state.getCurrentViewport());
    MapConstants constants;
    constants.add("depthError", copy.error);
    constants.add("texelAndRows", glm::dvec4(1.0 / glm::dvec2(_maps.map->size), copy.rows));
    constants.add("wanted", wanted);
    constants.add("seenPixels",
                  glm::dvec4(pixels.x, pixels.y, pixels.x + pixels.width - 1, pixels.y + pixels.height - 1));
    constants.add("drawnError", drawnErrorOf(state, sceneFromPixel));
    if (_places.coneFromScene) constants.add("coneFromPixel", *_places.coneFromScene * sceneFromPixel);
    for (const MapPicture::Tile& tile : _maps.picture->tiles) {
        const glm::dmat4 mapFromPixel = tile.mapFromScene * sceneFromPixel, pixelFromMap = glm::inverse(mapFromPixel);
        constants.beginMap(mapFromPixel);
        constants.addOfMap("place", placeOf(tile, _maps.picture->size));
        constants.addOfMap("pixelFromMapX", pixelFromMap[0]);
        constants.addOfMap("pixelFromMapY", pixelFromMap[1]);
        constants.addOfMap("pixelFromMapZ", pixelFromMap[2]);
        constants.addOfMap("nearestError", errorOf(tile.errors.nearest, tile.spread.penumbra.x));
        constants.addOfMap("farthestError", errorOf(tile.errors.farthest, tile.spread.penumbra.y));
        if (_options.edges == ShadowMapOptions::SOFT)
            constants.addOfMap("discs", glm::dvec4(tile.spread.nearest, tile.spread.farthest));
    }
    return constants;
}

/// 1 / w is that row of the matrix times a pixel's place: of most projections it depends on e alone.
glm::dvec4 MapLookup::drawnErrorOf(const osg::State& state, const glm::dmat4& sceneFromPixel) const {
    const PixelRect all = pixelsOf(*state.getCurrentViewport());
    const DrawnError off =
        drawnError(_places.clipFromScene, toGlm(state.getProjectionMatrix()), all.width, _places.rounding, 0.0);
    const glm::dvec4 row = off.depth * glm::row(sceneFromPixel, 3);
    const auto most = [](double change, double start, double size) {
        return std::max(change * start, change * (start + size));
    };
    const double beside = most(row.x, all.x, all.width) + most(row.y, all.y, all.height);
    return {row.w + beside, row.z, off.depth > 0.0 ? off.pixels / off.depth : 0.0, reachedOver / _maps.picture->size};
}

void MapLookup::drawDebugView(ScreenPass& pass, int before) const {
    osg::State& state = pass.state();
    const bool ofMaps = _options.view == ShadowMapOptions::MAP;
    if (!ofMaps && before > 0) return;
    if (!_maps.show(pass.renderInfo()).empty()) return; // which marking has said
    FrameDepths::Copy copy;
    if (!ofMaps) copy = _maps.programs->seen->copy(state, pixelsInScissor(*state.getCurrentViewport()));
    if (!copy.cause.empty()) return; // the same
    const MapUse showing = use(true);
    const MapConstants constants = constantsOf(state, copy, {}, {});
    state.apply(_maps.programs->program(showing, constants).get());
    if (!hasProgram(state)) return;
    pass.beginBlend();
    if (ofMaps) {
        drawPicture(state, pass, before);
    } else {
        setSeen(state, copy, constants);
        pass.drawQuad();
    }
    state.apply();
}

/// A third as high as the view, one light's beside the other's from the lower left corner on.
void MapLookup::drawPicture(osg::State& state, ScreenPass& pass, int before) const {
    if (!UncomparedSampler::isSupported(state)) return;
    const PixelRect all = pixelsOf(*state.getCurrentViewport());
    const int height = all.height / 3;
    const int width = static_cast<int>(std::lround(double(height) * _maps.map->size.x / _maps.map->size.y));
    const int x = all.x + before * width, y = all.y;
    glScissor(x, y, width, height);
    _maps.map->bind(state, 0);
    const UncomparedSampler raw(state, 0);
    setUniform(state, "depths", 0);
    setUniform(state, "frame", glm::dvec4(x, y, width, height));
    pass.drawQuad();
}

osg::ref_ptr<Mark> spotMark(const osg::ref_ptr<MapPrograms>& programs, const LookupPlaces& places) {
    return new SpotMark(programs, places);
}

osg::ref_ptr<Mark> programMaps(int textureUnit, const std::optional<MapsInView>& maps, const glm::dmat4& sceneFromEye) {
    return new ProgramMaps(textureUnit, maps, sceneFromEye);
}

} // namespace gnomon
