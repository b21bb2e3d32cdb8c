// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterFaces.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Texture2D>

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
    std::vector<Cutout> cutouts; ///< what textures cut out.
    std::vector<Box> bodyBoxes;  ///< of the drawables, about mesh->origin, the largest first.
    std::vector<Box> flatBoxes;  ///< of those that are flat along an axis of the group.
    glm::dvec3 reach{0.0};       ///< half sides of the bounds.

    /// All that no texture cuts out, or of it all but what is flat, as grounds are; null if that is nothing. What is asked
    /// for again is drawn often: from then on its solids are told apart. One thread at a time.
    osg::ref_ptr<const CasterFaces> faces(bool flats) const;
    /// False if a lamp may be in a solid. @param light  as usableLight().
    bool areOutside(const glm::dvec4& light) const;

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~MapCasters() override = default;

private:
    struct Sorted;
    struct Drawn {
        osg::ref_ptr<osg::DrawElementsUInt> triangles; ///< may be empty.
        osg::ref_ptr<const CasterFaces> faces;
        bool knowsSolids = false;
    };
    void take(const Sorted& sorted);

    mutable Drawn _all, _bodies;
};

} // namespace gnomon
