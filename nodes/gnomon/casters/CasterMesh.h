// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterExtraction.h>

#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/PrimitiveSet>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

class RayScene;

/// The casters of a group as one triangle mesh, in one revision. ShadowCasterGroup::casters() makes it.
///
/// Use it in a technique that treats all casters alike. Use CasterDrawables to treat each drawable apart.
///
/// Cost
/// - 12 bytes a triangle, and 12 bytes a vertex that a triangle uses.
/// Limits
/// - VertexTraverser lists what is left out.
/// Threads
/// - Any number. A mesh never changes, and a frame that is still drawn keeps its own.
class CasterMesh : public osg::Referenced {
public:
    /// Copies the extracted triangles.
    /// @param about  the mesh's origin, group frame. Default: in the midst of most corners.
    explicit CasterMesh(const CasterExtraction& casters, const std::optional<osg::Vec3d>& about = {});

    /// True if there is no triangle.
    bool empty() const { return triangles->empty(); }

    osg::Vec3d origin;                             ///< Group frame. The vertices are relative to it.
    osg::ref_ptr<osg::Vec3Array> vertices;         ///< Relative to `origin`. All are finite and used by a triangle.
    osg::ref_ptr<osg::DrawElementsUInt> triangles; ///< Three indices a triangle; see CasterExtraction::getTriangles().
    osg::BoundingBoxd bounds;                      ///< Bounds of the triangles, group frame. Invalid without triangles.
    double rounding = 0.0;                         ///< Largest error of a vertex by its float source, group's unit.
    std::vector<CasterExtraction::Drawn> drawn;    ///< Drawables of the triangles. `first` indexes `triangles`.
    std::vector<CasterExtraction::Cutout> cutouts; ///< Alpha-tested drawables. `firstVertex` indexes `vertices`.
    unsigned invalidTriangles = 0;                 ///< Triangles left out; see CasterExtraction::getInvalidTriangles().
    std::string invalidNode;                       ///< Name of the first drawable with an invalid triangle.
    mutable std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< See CasterExtraction::getSources().

    /// No view will ask for this mesh any more: caches may let it go. Whoever holds it longer holds no source.
    void retire() const {
        _retired = true;
        sources.clear();
    }
    bool isRetired() const { return _retired; }

    /// The tree of rays over this mesh, as long as anyone holds it. RaySceneCache alone uses it, under its lock.
    mutable std::weak_ptr<const RayScene> tree;

protected:
    ~CasterMesh() override = default;

private:
    mutable std::atomic<bool> _retired{false};
};

/// Makes a drawable of some triangles of a mesh. It has positions only, and shares the mesh's buffers.
osg::ref_ptr<osg::Geometry> casterGeometry(const CasterMesh& mesh, osg::DrawElementsUInt* triangles);

} // namespace gnomon
