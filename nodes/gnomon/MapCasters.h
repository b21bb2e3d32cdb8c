// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMesh.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Texture2D>

#include <functional>
#include <vector>

namespace gnomon {

/// The casters of one revision as a light's map draws them, all in one call. Never changed once made.
struct MapCasters : public osg::Referenced {
    struct Box {
        glm::dvec3 low, high;
    };

    /// Those that one texture cuts out by one test, drawn in one call; see AlphaTest.
    struct Cutout {
        osg::ref_ptr<osg::Geometry> geometry; ///< positions, and coordinates of the texture: s, t and q.
        osg::ref_ptr<osg::Texture2D> texture;
        int passing = 0;
        float reference = 0.0f;
        bool flat = false;
    };

    explicit MapCasters(const CasterMesh& mesh);

    const osg::ref_ptr<const CasterMesh> mesh;
    osg::ref_ptr<osg::Geometry> all;    ///< everything that is solid; null if that is nothing.
    osg::ref_ptr<osg::Geometry> bodies; ///< of it all but what is flat, as grounds are: null if that is nothing.
    std::vector<Cutout> cutouts;        ///< everything that is not solid.
    std::vector<Box> bodyBoxes;         ///< of the drawables, about mesh->origin, the largest first.
    std::vector<Box> flatBoxes;         ///< of those that are flat along an axis of the group.
    glm::dvec3 reach{0.0};              ///< half sides of the bounds.

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~MapCasters() override = default;

private:
    struct Sorted;
    void take(const Sorted& sorted);
    void forEachGeometry(const std::function<void(osg::Geometry&)>& call) const;
};

} // namespace gnomon
