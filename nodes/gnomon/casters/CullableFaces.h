// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/ClosedParts.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/RenderInfo>

#include <vector>

namespace gnomon {

osg::ref_ptr<osg::DrawElementsUInt> noTriangles();

/// Of triangles of the mesh's vertices.
ClosedParts closedPartsOf(const CasterMesh& mesh, const osg::DrawElementsUInt& triangles);

/// Triangles of a caster mesh as a light's map draws them. Never changed once made.
///
/// Cost  to find solids takes longer than to make the mesh, see closedParts(), and halves the drawing of what is closed.
struct CullableFaces : public osg::Referenced {
    /// They bound solids: of these the faces turned to a light cast all of the shadow. Null if there are none.
    osg::ref_ptr<osg::Geometry> solids;
    osg::ref_ptr<osg::Geometry> others; ///< of these both sides cast. Null if there are none.
    const bool smooth;                  ///< their vertices have offsets: see CasterMesh.

    /// @param triangles   of the mesh's vertices.
    /// @param findSolids  else all are others.
    CullableFaces(const CasterMesh& mesh, osg::DrawElementsUInt* triangles, bool findSolids);

    /// True if a light is in no solid, so that their faces turned to it cast all of their shadow. False where a lamp may be in
    /// one, which many drawables may make together. @param light  as lightInScene().
    bool isOutside(const glm::dvec4& light) const;
    /// Needs back faces to be those that are culled.
    /// @param clipFromScene  to the light's clip space, from the group's axes about the mesh's origin.
    /// @param outside        see isOutside().
    void draw(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromScene, bool outside) const;

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~CullableFaces() override = default;

private:
    std::vector<osg::BoundingBox> _solidBoxes; ///< of their parts.
};

} // namespace gnomon
