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
    osg::ref_ptr<osg::Geometry> all;    ///< everything.
    osg::ref_ptr<osg::Geometry> bodies; ///< all but what is flat, as grounds are: null if that is nothing.
    std::vector<Box> bodyBoxes;         ///< of the drawables, about mesh->origin, the largest first.
    std::vector<Box> flatBoxes;         ///< of those that are flat along an axis of the group.
    glm::dvec3 reach{0.0};              ///< half sides of the bounds.

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~MapCasters() override = default;
};

} // namespace gnomon
