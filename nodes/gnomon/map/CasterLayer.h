// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/CullableFaces.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Texture2D>

#include <vector>

namespace gnomon {

/// Casters as a light's map draws them, all in one call. Never changed once made.
struct CasterLayer : public osg::Referenced {
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

    /// Reads the graph as a cull traversal does, see meshOf().
    /// @param origin  group frame; all positions are about it.
    CasterLayer(CasterDrawables::List pieces, const osg::Vec3d& origin);

    const CasterDrawables::List pieces; ///< in the order in which a traversal meets them.
    std::size_t triangles = 0;          ///< of all.
    std::vector<Cutout> cutouts;        ///< what textures cut out.
    std::vector<Box> bodyBoxes;         ///< of the drawables, about the origin, the largest first.
    std::vector<Box> flatBoxes;         ///< of those that are flat along an axis of the group.

    /// All that no texture cuts out, or of it all but what is flat, as grounds are; null if that is nothing. One thread at a
    /// time.
    /// @param again  it has been drawn before, and so may be drawn often: its solids are told apart.
    osg::ref_ptr<const CullableFaces> faces(bool flats, bool again) const;

    /// From a lamp about the origin to the nearest triangle; infinite if there is none. Triangles whose plane holds the lamp,
    /// to 10⁻⁶ of the coordinates, do not count: they cast nothing. Looks at the drawables that may be nearest.
    double clearanceOf(const glm::dvec3& lamp) const;

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~CasterLayer() override = default;

private:
    struct Sorted;
    struct Drawn {
        osg::ref_ptr<osg::DrawElementsUInt> triangles; ///< may be empty; null in a layer without any.
        osg::ref_ptr<const CullableFaces> faces;
        bool knowsSolids = false;
    };
    /// A drawable's part of the mesh's triangles.
    struct Part {
        Box box;
        std::size_t first, end; ///< corners.
    };
    void take(const Sorted& sorted);
    double clearanceOf(const glm::dvec3& lamp, const Part& part) const;

    osg::ref_ptr<const CasterMesh> _mesh; ///< null if there is nothing.
    std::vector<Part> _parts;
    mutable Drawn _all, _bodies;
};

} // namespace gnomon
