// SPDX-License-Identifier: MIT
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/map/MapPrograms.h>
#include <gnomon_shaders.h>

#include <OpenThreads/ScopedLock>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr GLenum maxVaryingComponents = 0x8B4B; // GL_MAX_VARYING_COMPONENTS
constexpr std::size_t placing = 4;              // vectors a map, by which a pixel finds its map

/// By ShadowMapOptions::Filter. NEAREST and BILINEAR are one comparison: the texture's own filter tells them apart.
constexpr const char* comparing[] = {"", "", "#define BICUBIC\n#define SAMPLES 4.0\n",
                                     "#define BICUBIC\n#define FINE\n#define SAMPLES 16.0\n"};

/// By ShadowMapOptions::Edges.
constexpr const char* edges[] = {"#define HALVES\n", "#define SMOOTH\n", "#define SOFT\n"};

bool isSoft(const MapUse& use) { return use.options.edges == ShadowMapOptions::SOFT; }

std::string definesOf(const MapUse& use) {
    const auto ifSo = [](bool is, const char* define) { return std::string(is ? define : ""); };
    std::string defines =
        comparing[use.options.filter] + ifSo(use.cascades, "#define CASCADES\n") + ifSo(use.cone, "#define CONE\n");
    if (use.shows)
        return defines + ifSo(use.options.view == ShadowMapOptions::MAP, "#define PICTURE\n") +
               ifSo(use.options.view == ShadowMapOptions::TEXELS, "#define TEXELS\n");
    return defines + edges[use.options.fades() ? use.options.edges : ShadowMapOptions::HARD] +
           ifSo(use.penumbra, "#define PENUMBRA\n") + ifSo(use.odd, "#define ODD\n") +
           ifSo(use.interlaced, "#define INTERLACED\n");
}

/// In this order: each begins with what it knows of those before it.
std::string textOf(const MapUse& use) {
    if (use.shows) return std::string(shaders::map_place_frag) + shaders::map_view_frag;
    return std::string(shaders::map_place_frag) + shaders::cone_frag + shaders::map_filter_frag +
           (isSoft(use) ? shaders::map_soft_frag : "") + shaders::map_lie_frag + shaders::map_frag;
}

std::string define(const std::string& name, const std::string& value) { return "#define " + name + " " + value + "\n"; }

std::string sharedAt(std::size_t place) { return "ofAll(" + std::to_string(place) + ")"; }

/// How many vectors the vertices hand on: as many as OpenGL takes of those that all maps share, those by which a pixel finds its
/// map, too, or all.
std::size_t flatConstants(std::size_t shared, std::size_t searched, std::size_t all) {
    const std::size_t most = static_cast<std::size_t>(glInteger(maxVaryingComponents)) / 4;
    for (const std::size_t part : {all, searched, shared})
        if (part <= most) return part;
    return 0;
}

} // namespace

void MapConstants::add(const char* name, const glm::dvec4& value) {
    _names += define(name, sharedAt(_shared.size()));
    _shared.push_back(value);
}

void MapConstants::add(const char* name, const glm::dmat4& value) {
    const std::size_t first = _shared.size();
    _names += define(name, "mat4(" + sharedAt(first) + ", " + sharedAt(first + 1) + ", " + sharedAt(first + 2) + ", " +
                               sharedAt(first + 3) + ")");
    for (int i = 0; i < 4; ++i) _shared.push_back(value[i]);
}

void MapConstants::beginMap(const glm::dmat4& mapFromPixel) {
    for (int i = 0; i < 4; ++i) _placing.push_back(mapFromPixel[i]);
    ++_maps;
}

void MapConstants::addOfMap(const char* name, const glm::dvec4& value) {
    if (_maps == 1) _names += define(name + std::string("(i)"), "ofMap(i, " + std::to_string(_ofMaps.size()) + ")");
    _ofMaps.push_back(value);
}

std::vector<glm::dvec4> MapConstants::values() const {
    std::vector<glm::dvec4> all = _shared;
    for (const auto* more : {&_placing, &_ofMaps}) all.insert(all.end(), more->begin(), more->end());
    return all;
}

std::string MapConstants::defines(bool indexed) const {
    const std::size_t shared = _shared.size(), searched = shared + _placing.size(), all = searched + _ofMaps.size();
    const auto count = [](const char* name, std::size_t value) { return define(name, std::to_string(value)); };
    return count("MAPS", _maps) + count("SHARED", shared) + count("PLACING", placing) +
           count("EACH", _ofMaps.size() / _maps) + count("CONSTANTS", all) +
           count("FLATS", flatConstants(shared, indexed ? shared : searched, all)) + _names;
}

MapPrograms::MapPrograms()
    : caster(shaderProgram()), // for a clip distance costs a third more a vertex on llvmpipe
      casterByLamp(shaderProgram("#define CLIP_NEAR\n")),
      smoothCaster(shaderProgram("#define CLIP_NEAR\n#define OFFSET\n")),
      cutout(shaderProgram("#define CLIP_NEAR\n#define CUTOUT\n")),
      blocks(quadProgram("gnomon blocks", "", shaders::blocks_frag)),
      cone(quadProgram("gnomon cone", "#define CONE\n#define SURROUND\n", shaders::cone_frag)) {}

/// Soft edges look at one map after the other.
osg::ref_ptr<const osg::StateSet> MapPrograms::program(const MapUse& use, const MapConstants& constants) {
    const std::string defines = definesOf(use) + constants.defines(isSoft(use));
    Lock lock(_mutex);
    osg::ref_ptr<osg::StateSet>& set = _programs[(use.shows ? "view " : "") + defines];
    if (!set) set = quadProgram("gnomon map", defines, textOf(use).c_str());
    return set;
}

void MapPrograms::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& set : {caster, casterByLamp, smoothCaster, cutout, blocks, cone})
        set->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    for (const auto& [defines, set] : _programs) set->resizeGLObjectBuffers(maxSize);
}

void MapPrograms::release(osg::State* state) {
    seen->release(state);
    for (const auto& set : {caster, casterByLamp, smoothCaster, cutout, blocks, cone}) set->releaseGLObjects(state);
    Lock lock(_mutex);
    for (const auto& [defines, set] : _programs) set->releaseGLObjects(state);
}

std::string visibilityFunction(ShadowMapOptions::Filter filter) {
    return std::string("#version 130\n") + comparing[filter] +
           "uniform vec2 gnomon_mapTexel;\n#define maps gnomon_map\n#define texel gnomon_mapTexel\n"
           "#define lit gnomon_lit\n" +
           shaders::map_filter_frag + shaders::visibility_glsl;
}

} // namespace gnomon
