// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/ClosedParts.h>
#include <gnomon/gl/TriangleClusters.h>

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
/// Cost  to find solids takes longer than to make the mesh, see closedParts(), and halves the drawing of what is closed;
/// where it has holes, those faces turned away are drawn, too, that a hole may show to the light.
struct CullableFaces : public osg::Referenced {
    osg::ref_ptr<osg::Geometry>
        solids; ///< they bound solids: of these the faces turned to a light cast all of the shadow.
    osg::ref_ptr<osg::Geometry> holed;  ///< they would, had they no holes.
    osg::ref_ptr<osg::Geometry> others; ///< of these both sides cast. Null, as the former, if there are none.
    const bool smooth;                  ///< their vertices have offsets: see CasterMesh.

    /// @param triangles   of the mesh's vertices.
    /// @param findSolids  else all are others.
    CullableFaces(const CasterMesh& mesh, osg::DrawElementsUInt* triangles, bool findSolids);

    /// Whether a light is in none of them, so that their faces turned to it cast all of their shadow.
    struct Outside {
        bool solids = true, holed = true;
        bool operator==(const Outside& other) const { return solids == other.solids && holed == other.holed; }
    };

    /// False where a lamp may be in one, which many drawables may make together. @param light  as lightInScene().
    Outside outside(const glm::dvec4& light) const;
    /// Needs back faces to be those that are culled.
    /// @param clipFromScene  to the light's clip space, from the group's axes about the mesh's origin.
    void draw(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromScene, const Outside& outside) const;

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~CullableFaces() override = default;

private:
    void drawBehindHoles(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromScene) const;

    std::vector<osg::BoundingBox> _solidBoxes, _holedBoxes; ///< of their parts.
    std::vector<std::vector<glm::dvec3>> _holes;            ///< of each the triangles that fill it.
    osg::ref_ptr<const TriangleClusters> _clusters;         ///< of those that have holes.
};

} // namespace gnomon
