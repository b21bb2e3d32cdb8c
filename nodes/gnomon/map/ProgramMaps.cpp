// SPDX-License-Identifier: MIT
#include <gnomon/map/ProgramMaps.h>

#include <gnomon_shaders.h>

#include <glm/gtc/type_ptr.hpp>

namespace gnomon {
namespace {

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
