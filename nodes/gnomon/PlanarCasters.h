// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMesh.h>

#include <osg/Geometry>
#include <osg/Vec4d>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

/// The casters that reach above one plane, ready to be drawn flattened: made once a revision and plane, never changed.
/// Triangles in or under the plane are left out; those that cross it are kept apart, for only they need clipping there.
class PlanarCasters : public osg::Referenced {
public:
    /// @param groupPlane  unit normal, group frame.
    PlanarCasters(const CasterMesh& mesh, const glm::dvec4& groupPlane);

    bool madeFrom(const CasterMesh& mesh, const glm::dvec4& groupPlane) const {
        return _mesh == &mesh && _groupPlane == groupPlane;
    }
    bool empty() const { return !above && !crossing; }

    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

    osg::ref_ptr<osg::Geometry> above;    ///< triangles wholly above the plane; null if there is none.
    osg::ref_ptr<osg::Geometry> crossing; ///< triangles on both sides of it; null if there is none.
    glm::dvec4 plane;                     ///< in the mesh's own frame: about mesh.origin.
    glm::dvec3 low, high;                 ///< bounds of both, about mesh.origin.
    double highest = 0.0;                 ///< greatest height above the plane.
    double thickness = 0.0;               ///< height up to which a vertex counts as lying in the plane.

protected:
    ~PlanarCasters() override = default;

private:
    osg::ref_ptr<const CasterMesh> _mesh; // kept, so that its address cannot be taken by the next revision
    glm::dvec4 _groupPlane;
};

} // namespace gnomon
