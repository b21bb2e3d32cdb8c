// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMesh.h>
#include <gnomon/ConvexParts.h>
#include <gnomon/Drape.h>
#include <gnomon/Selection.h>
#include <gnomon/TerrainMark.h>
#include <gnomon/TerrainShadowGeode.h>

#include <OpenThreads/Mutex>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace gnomon {

/// The ground in one revision.
struct TerrainDrawn : public osg::Referenced {
    std::uint64_t revision = 0;
    std::set<const osg::Drawable*> drawables;                 ///< to be told apart from others only.
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< see VertexTraverser::getSources().
    std::shared_ptr<const Ground> ground;

protected:
    ~TerrainDrawn() override = default;
};

/// What casts on which ground, in one revision of both; the frame is the casters'.
struct TerrainScene : public osg::Referenced {
    osg::ref_ptr<const CasterMesh> mesh;
    osg::ref_ptr<const TerrainDrawn> drawn;
    bool asBoxes = false; ///< for BOX: objects, else parts.
    std::vector<ConvexPart> parts;
    std::vector<std::vector<glm::dvec3>> objects; ///< points of each connected part of the casters.

protected:
    ~TerrainScene() override = default;
};

/// Where the terrain is to be looked for, and in which frame it is wanted.
struct TerrainPlace {
    osg::Node& root;
    Selection terrain; ///< under the root; of it nothing casts.
    osg::Matrixd groundFromRoot;

    /// Under the group, or wherever in the graph, in the group's frame.
    static TerrainPlace inFrameOf(const osg::Node& group, const Selection& terrain);
    /// Fingerprint of what is drawn there, see CasterRevision.
    std::uint64_t revision() const;
};

/// How shadows are to be found.
struct TerrainSettings {
    TerrainShadowGeode::Method method;
    double error;
    osg::BoundingBoxd box; ///< BOX alone: of the only object; invalid: found from each.
    bool operator==(const TerrainSettings& other) const {
        return method == other.method && error == other.error && box._min == other.box._min &&
               box._max == other.box._max;
    }
};

/// The shadows of one light on one scene.
struct TerrainShadows : public osg::Referenced {
    osg::ref_ptr<const TerrainScene> scene;
    TerrainSettings settings;
    glm::dvec4 light{0.0};
    std::vector<Drape> shadows;      ///< of each part, or object; empty where there is none.
    std::vector<std::string> causes; ///< why some are missing, or not of the method that was asked for.
    mutable osg::ref_ptr<TerrainPrisms>
        prisms; ///< null until TerrainCache::prismsOf() is asked: marks alone need them.

protected:
    ~TerrainShadows() override = default;
};

/// The shadows that a TerrainShadowGeode was asked for last, so that nothing is found twice.
///
/// Threads any number; one at a time finds new ones.
class TerrainCache {
public:
    osg::ref_ptr<const TerrainShadows> shadows(const CasterMesh& mesh, const TerrainPlace& place,
                                               const glm::dvec4& light, const TerrainSettings& settings);
    osg::ref_ptr<const TerrainPrisms> prismsOf(const TerrainShadows& shadows);
    unsigned builds() const;
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    osg::ref_ptr<const TerrainScene> sceneOf(const CasterMesh& mesh, const TerrainPlace& place, bool asBoxes);
    osg::ref_ptr<const TerrainDrawn> drawnAt(const TerrainPlace& place) const;
    void add(const osg::ref_ptr<const TerrainShadows>& shadows);

    mutable OpenThreads::Mutex _mutex;
    std::vector<osg::ref_ptr<const TerrainShadows>> _known; ///< used last at the end.
    unsigned _builds = 0;
};

} // namespace gnomon
