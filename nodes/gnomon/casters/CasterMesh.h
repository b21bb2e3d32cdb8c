// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/casters/CasterExtraction.h>

#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/PrimitiveSet>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// What the casters of a group look like in one revision: triangles in the group's frame. Never changes once made, so
/// any thread may read it and a frame still being drawn keeps its own.
///
/// Cost    12 bytes a triangle and 12 for each vertex that a triangle uses.
class GNOMON_EXPORT CasterMesh : public osg::Referenced {
public:
    /// @param about  the origin; the centre of the bounds if none is given.
    explicit CasterMesh(const CasterExtraction& casters, const std::optional<osg::Vec3d>& about = {});

    bool empty() const { return triangles->empty(); }

    osg::Vec3d origin;                     ///< group frame; vertices are relative to it.
    osg::ref_ptr<osg::Vec3Array> vertices; ///< floats about `origin`, all finite; only those that triangles use.
    osg::ref_ptr<osg::DrawElementsUInt> triangles; ///< three indices a triangle; see CasterExtraction::getTriangles().
    osg::BoundingBoxd bounds;                      ///< of all triangles, group frame; invalid if there is none.
    double rounding = 0.0;                         ///< how far off its float source may put a vertex, group's unit.
    std::vector<CasterExtraction::Drawn> drawn;    ///< whose triangles they are; `first` as in `triangles`.
    std::vector<CasterExtraction::Cutout> cutouts; ///< of those; `firstVertex` as in `vertices`.
    unsigned invalidTriangles = 0;                 ///< left out; see CasterExtraction::getInvalidTriangles().
    std::string invalidNode;                       ///< where the first of them is.
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< see CasterExtraction::getSources().

protected:
    ~CasterMesh() override = default;
};

/// Triangles of the mesh's vertices as a drawable, positions only, in the mesh's own buffers.
osg::ref_ptr<osg::Geometry> casterGeometry(const CasterMesh& mesh, osg::DrawElementsUInt* triangles);

} // namespace gnomon
