// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>

#include <osg/Geometry>
#include <osg/Vec4d>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace gnomon {

/// The casters that reach above one plane, ready to be drawn flattened: made once a revision and plane, never changed.
/// Triangles in the plane are left out, and those under it unless asked for.
class PlanarCasters : public osg::Referenced {
public:
    /// Triangles that are drawn alike.
    struct Part {
        osg::ref_ptr<osg::Geometry> geometry;
        bool crossing; ///< they cross the plane and must be cut there; else they are wholly above it.
        bool solid;    ///< they bound solids: those turned away from the light need not be drawn.
    };

    /// @param groupPlane  unit normal, group frame.
    /// @param under       keep what lies under the plane, too.
    /// @param findSolids  look for solids (closedParts()): takes longer than all the rest, and halves the drawing.
    PlanarCasters(const CasterMesh& mesh, const glm::dvec4& groupPlane, bool under, bool findSolids);

    bool madeFrom(const CasterMesh& mesh, const glm::dvec4& groupPlane, bool under) const {
        return _mesh == &mesh && _groupPlane == groupPlane && _under == under;
    }
    /// True if no view will ask for these any more.
    bool isRetired() const { return _mesh->isRetired(); }
    bool knowsSolids() const { return _knowsSolids; }
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

    unsigned firstFrame = 0; ///< in which these were made.
    std::vector<Part> parts;
    glm::dvec4 plane;       ///< in the scene about mesh.origin, see SceneFrame.
    glm::dvec3 low, high;   ///< bounds of all parts, in the scene.
    bool crosses = false;   ///< some part crosses the plane.
    double highest = 0.0;   ///< greatest height above the plane.
    double thickness = 0.0; ///< height up to which vertices of what crosses the plane count as lying in it.

protected:
    ~PlanarCasters() override = default;

private:
    osg::ref_ptr<const CasterMesh> _mesh; // kept, so that its address cannot be taken by the next revision
    glm::dvec4 _groupPlane;
    bool _under;
    bool _knowsSolids;
};

} // namespace gnomon
