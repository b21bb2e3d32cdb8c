// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/gl/FrameDepths.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <osg/State>
#include <osg/StateSet>

#include <atomic>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// What a program that looks a light's maps up is for.
struct MapUse {
    ShadowMapOptions options;
    bool shows = false;      ///< draws the debug view; else it marks.
    bool cascades = false;   ///< see MapPicture::divided.
    bool cone = false;       ///< there are no marks outside a spot's cone.
    bool penumbra = false;   ///< blocks tell how far off what blocks the light is, see DepthMap.
    bool odd = false;        ///< its pixels are not all in whole quads.
    bool interlaced = false; ///< see ScreenPass::isInterlaced().
};

/// Vectors that such a program is given, under the names that its shaders have for them: map_place.frag knows where each lies by
/// defines() alone.
class MapConstants {
public:
    /// The next that all maps share.
    void add(const char* name, const glm::dvec4& value);
    /// The same of a matrix, by columns.
    void add(const char* name, const glm::dmat4& value);
    /// Begins the next map.
    void beginMap(const glm::dmat4& mapFromPixel);
    /// The next of that map: all maps have the same names in the same order.
    void addOfMap(const char* name, const glm::dvec4& value);

    std::vector<glm::dvec4> values() const;
    /// @param indexed  a pixel may ask for a map of any number: then what it finds its map by can be no varying.
    std::string defines(bool indexed) const;

private:
    std::string _names; ///< defines.
    std::vector<glm::dvec4> _shared, _placing, _ofMaps;
    std::size_t _maps = 0;
};

/// The programs of a ShadowMapTechnique's maps and marks, and what else these share: it belongs to the technique, and is released
/// with its other OpenGL objects.
class MapPrograms : public osg::Referenced {
public:
    /// Casters, of a sun and of a lamp; those with offsets, of either; those that a texture cuts out; see DepthMap::updateBlocks(); all but a spot's cone.
    const osg::ref_ptr<osg::StateSet> caster, casterByLamp, smoothCaster, cutout, blocks, cone;
    const std::shared_ptr<FrameDepths> seen = FrameDepths::shared();
    std::atomic<unsigned> passes{0}; ///< maps drawn so far.

    MapPrograms();
    /// Made at its first use.
    osg::ref_ptr<const osg::StateSet> program(const MapUse& use, const MapConstants& constants);
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

protected:
    ~MapPrograms() override = default;

private:
    OpenThreads::Mutex _mutex;
    std::map<std::string, osg::ref_ptr<osg::StateSet>> _programs; ///< by their defines.
};

/// The function of ShadowMapTechnique::programFunction().
std::string visibilityFunction(ShadowMapOptions::Filter filter);

} // namespace gnomon
