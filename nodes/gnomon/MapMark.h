// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/DepthMap.h>
#include <gnomon/MapFit.h>
#include <gnomon/MarkJob.h>
#include <gnomon/SeenDepth.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <osg/StateSet>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace gnomon {

/// What a ShadowMapTechnique's marks share: they belong to it, so that they are released with its other OpenGL objects.
class MapResources : public osg::Referenced {
public:
    MapResources();

    const osg::ref_ptr<osg::StateSet> casterProgram, cutoutProgram, coneProgram;
    SeenDepth seen;
    std::atomic<unsigned> passes{0}; ///< maps drawn so far.

    /// The program for these defines, made at its first use.
    osg::ref_ptr<const osg::StateSet> program(const std::string& defines);
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

protected:
    ~MapResources() override = default;

private:
    OpenThreads::Mutex _mutex;
    std::map<std::string, osg::ref_ptr<osg::StateSet>> _programs;
};

/// From window coordinates x and y, and 1 - depth.
glm::dmat4 clipFromPixel(const osg::Viewport& viewport);

/// One map of a light, as pixels look it up.
struct MapLookUp {
    glm::dmat4 mapFromScene{1.0}; ///< see MapFit; the scene is about the casters' origin.
    MapErrors errors;
};

/// Marks of one light in one view: where the light's maps hold something nearer to it than what the depth buffer says is
/// seen.
class MapMark : public MarkJob {
public:
    osg::ref_ptr<MapResources> resources;
    osg::ref_ptr<DepthMap> map;
    osg::ref_ptr<const MapPicture> picture;
    std::vector<MapLookUp> lookUps;          ///< one a tile of the picture.
    glm::dmat4 clipFromScene{1.0};           ///< as drawn.
    std::optional<glm::dmat4> coneFromScene; ///< of a spot: what is not in its cone gets no marks.
    std::string defines;                     ///< of the fragment shader: how it compares.

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;

protected:
    ~MapMark() override = default;

private:
    void setUniforms(osg::State& state, const glm::dvec4& depthError) const;
};

} // namespace gnomon
