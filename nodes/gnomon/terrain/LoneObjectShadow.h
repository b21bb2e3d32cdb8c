// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/terrain/CasterParts.h>
#include <gnomon/terrain/GroundRevision.h>
#include <gnomon/terrain/TerrainSettings.h>

#include <string>
#include <vector>

namespace gnomon {

/// What casts on which ground, in one revision of both; the frame is the casters'.
struct LoneObjectShadow : public osg::Referenced {
    osg::ref_ptr<const CasterMesh> mesh;
    osg::ref_ptr<const GroundRevision> drawn;
    bool asBoxes = false;  ///< for BOX: boxes, else parts.
    osg::BoundingBoxd box; ///< as TerrainSettings.
    std::vector<ConvexPart> parts;
    std::vector<BoxCaster> boxes;

protected:
    ~LoneObjectShadow() override = default;
};

/// The shadows of one light on one scene.
struct TerrainShadows : public osg::Referenced {
    osg::ref_ptr<const LoneObjectShadow> scene;
    TerrainSettings settings;
    glm::dvec4 light{0.0};
    std::vector<Drape> shadows;      ///< of each part, or object; empty where there is none.
    std::vector<std::string> causes; ///< why some are missing, or not of the method that was requested.

    /// @param known  may be null. @return `known` itself if it is these.
    static osg::ref_ptr<const TerrainShadows> of(const CasterMesh& mesh, const TerrainPlace& place,
                                                 const glm::dvec4& light, const TerrainSettings& settings,
                                                 const osg::ref_ptr<const TerrainShadows>& known);

protected:
    ~TerrainShadows() override = default;
};

} // namespace gnomon
