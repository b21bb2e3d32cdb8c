// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMesh.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>

#include <vector>

namespace gnomon {

/// The casters of one revision as a light's map draws them, all in one call. Never changed once made.
struct MapCasters : public osg::Referenced {
    struct Box {
        glm::dvec3 low, high;
    };

    explicit MapCasters(const CasterMesh& mesh);

    const osg::ref_ptr<const CasterMesh> mesh;
    const osg::ref_ptr<osg::Geometry> geometry;
    std::vector<Box> boxes; ///< of the drawables, about mesh->origin, the largest first.
    glm::dvec3 reach{0.0};  ///< half sides of the bounds.

protected:
    ~MapCasters() override = default;
};

} // namespace gnomon
