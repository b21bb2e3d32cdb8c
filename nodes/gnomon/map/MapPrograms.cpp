// SPDX-License-Identifier: MIT
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/map/MapPrograms.h>

#include <gnomon_shaders.h>

#include <OpenThreads/ScopedLock>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

MapPrograms::MapPrograms()
    : casterProgram(shaderProgram("#define NEAREST\n")),
      cutoutProgram(shaderProgram("#define NEAREST\n#define CUTOUT\n")),
      blocksProgram(quadProgram("gnomon blocks", "", shaders::blocks_frag)),
      coneProgram(quadProgram("gnomon cone", "#define CONE\n#define SURROUND\n", shaders::cone_frag)) {}

osg::ref_ptr<const osg::StateSet> MapPrograms::program(const std::string& defines) {
    return of(_programs, defines, std::string(shaders::cone_frag) + shaders::map_filter_frag + shaders::map_frag);
}

osg::ref_ptr<const osg::StateSet> MapPrograms::viewProgram(const std::string& defines) {
    return of(_viewPrograms, defines, shaders::map_view_frag);
}

osg::ref_ptr<const osg::StateSet> MapPrograms::of(Programs& programs, const std::string& defines,
                                                  const std::string& shader) {
    Lock lock(_mutex);
    osg::ref_ptr<osg::StateSet>& set = programs[defines];
    if (!set) set = quadProgram("gnomon map", defines, (shaders::map_place_frag + shader).c_str());
    return set;
}

std::vector<osg::ref_ptr<osg::StateSet>> MapPrograms::all() {
    Lock lock(_mutex);
    std::vector<osg::ref_ptr<osg::StateSet>> sets{casterProgram, cutoutProgram, blocksProgram, coneProgram};
    for (const Programs* programs : {&_programs, &_viewPrograms})
        for (const auto& [defines, set] : *programs) sets.push_back(set);
    return sets;
}

void MapPrograms::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& set : all()) set->resizeGLObjectBuffers(maxSize);
}

void MapPrograms::release(osg::State* state) {
    for (const auto& set : all()) set->releaseGLObjects(state);
    seen.release(state);
}

} // namespace gnomon
