// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/PrimitiveSet>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <string>

namespace gnomon {

class VertexTraverser;

/// What the casters of a group look like in one revision: triangles in the group's frame. Never changes once made, so
/// any thread may read it and a frame still being drawn keeps its own.
class GNOMON_EXPORT CasterMesh : public osg::Referenced {
public:
    explicit CasterMesh(const VertexTraverser& casters);

    bool empty() const { return triangles->empty(); }

    osg::Vec3d origin;                          ///< centre of the bounds, group frame; vertices are relative to it.
    osg::ref_ptr<osg::Vec3Array> vertices;      ///< floats about `origin`.
    osg::ref_ptr<osg::DrawElementsUInt> triangles; ///< three indices a triangle.
    osg::BoundingBoxd bounds;                   ///< of all triangles, group frame; invalid if there is none.
    double rounding = 0.0;                      ///< how far off its float source may put a vertex, group's unit.
    unsigned invalidTriangles = 0;              ///< left out: a vertex that is not finite.
    std::string invalidNode;                    ///< name (or class) of the first drawable that has one.

protected:
    ~CasterMesh() override = default;
};

} // namespace gnomon
