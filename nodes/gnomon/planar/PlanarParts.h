// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/PlacedMesh.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Geometry>
#include <osg/Referenced>

#include <vector>

namespace gnomon {

/// Triangles that are drawn alike, flattened.
struct PlanarPart {
    osg::ref_ptr<osg::Geometry> geometry;
    bool crossing;                 ///< they cross the plane and must be cut there; else they are wholly above it.
    bool solid;                    ///< they bound solids: those turned away from the light need not be drawn.
    glm::dmat4 sceneFromMesh{1.0}; ///< see PlacedMesh.
    bool mirrored = false;         ///< the same.
    double thickness = 0.0;        ///< height up to which vertices of what crosses the plane count as lying in it.
};

/// A mesh as it is drawn wherever it is, in one or two parts. Never changed.
struct PlanarMesh : public osg::Referenced {
    /// @param findSolids  look for solids (closedParts()): takes longer than all the rest, and halves the drawing.
    PlanarMesh(const CasterMesh& mesh, bool findSolids, unsigned frame);

    const osg::ref_ptr<const CasterMesh> mesh;
    const bool knowsSolids;
    const unsigned firstFrame;     ///< in which it was made.
    std::vector<PlanarPart> parts; ///< in the mesh's frame.

protected:
    ~PlanarMesh() override = default;
};

/// What of a mesh is above one plane. Triangles in the plane are left out, and those under it unless asked for. Never
/// changed.
struct PlanarParts : public osg::Referenced {
    /// Each triangle for itself. @param plane  unit normal, scene. @param under  keep what lies under the plane, too.
    PlanarParts(const PlacedMesh& placed, const glm::dvec4& plane, bool under, bool findSolids, unsigned frame);
    /// As a whole, cut by the plane if a triangle reaches below it or lies in it.
    PlanarParts(const PlacedMesh& placed, const glm::dvec4& plane, const glm::dvec3& low, const glm::dvec3& high,
                const PlanarMesh& whole);

    bool madeFrom(const PlacedMesh& placed) const {
        return mesh == placed.mesh && sceneFromMesh == placed.sceneFromMesh;
    }

    const osg::ref_ptr<const CasterMesh> mesh;
    const glm::dmat4 sceneFromMesh;
    osg::ref_ptr<const PlanarMesh> whole; ///< null if each triangle was looked at.
    bool knowsSolids;
    unsigned firstFrame; ///< in which its triangles were looked at.
    std::vector<PlanarPart> parts;
    glm::dvec3 low, high; ///< bounds of all parts, in the scene.
    double highest = 0.0; ///< greatest height above the plane.

protected:
    ~PlanarParts() override = default;
};

} // namespace gnomon
