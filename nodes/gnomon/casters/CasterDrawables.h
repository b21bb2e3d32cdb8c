// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Selection.h>
#include <gnomon/casters/AlphaTest.h>

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

class CasterMesh;

/// A drawable that casts, at one place in the graph, in one revision. A piece never changes.
///
/// A drawable with several parents is one piece for each path to it.
struct CasterDrawable : public osg::Referenced {
    std::uint64_t fingerprint = 0;              ///< Changes with all that CasterExtraction reads of it.
    osg::ref_ptr<const osg::Drawable> drawable; ///< The drawable itself.
    osg::Matrixd groupFromLocal;                ///< Transform from the drawable's frame to the group's.
    std::optional<AlphaTest> test;              ///< Its alpha test; nullopt if it has none.
    osg::BoundingBoxd bounds;                   ///< Bounds of its triangles, group frame. Invalid without triangles.
    std::size_t triangles = 0;                  ///< Number of its triangles.
    unsigned invalidTriangles = 0;              ///< Triangles left out; see CasterExtraction::getInvalidTriangles().
    std::string invalidNode;                    ///< See CasterExtraction::getInvalidNode().
    unsigned unknownTests = 0;                  ///< See CasterExtraction::getUnknownTests().
    std::string unknownNode;                    ///< See CasterExtraction::getUnknownNode().
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< See CasterExtraction::getSources().

protected:
    ~CasterDrawable() override = default;
};

/// The casters of a group, drawable by drawable, in one revision. ShadowCasterGroup::drawables() makes it.
///
/// Use it in a technique that keeps something for each drawable. After a change, unchanged drawables keep their pieces.
/// Use CasterMesh to treat all casters alike.
///
/// Cost
/// - 600 bytes a drawable. Triangles are not kept; meshOf() extracts them.
/// Limits
/// - VertexTraverser lists what is left out.
/// Threads
/// - Any number. The pieces never change.
class CasterDrawables : public osg::Referenced {
public:
    /// Pieces, one for each drawable and path.
    using List = std::vector<osg::ref_ptr<const CasterDrawable>>;
    /// Sums up the pieces.
    CasterDrawables(List pieces, std::uint64_t fingerprint);

    /// True if there is no triangle.
    bool empty() const { return !bounds.valid(); }

    const List list;                 ///< In traversal order.
    const std::uint64_t fingerprint; ///< Changes with any piece.
    osg::BoundingBoxd bounds;        ///< Bounds of all triangles, group frame. Invalid without triangles.
    unsigned invalidTriangles = 0;   ///< Sum over the pieces.
    std::string invalidNode;         ///< Name of the first drawable with an invalid triangle.
    unsigned unknownTests = 0;       ///< Sum over the pieces.
    std::string unknownNode;         ///< Name of the first drawable with an unknown alpha test.

    /// Finds the casters below a node. Reads the graph as a cull traversal does.
    /// @param known  an earlier result, whose unchanged pieces are used again; may be null.
    /// @return       `known` itself if nothing changed.
    ///
    /// Cost
    /// - One visit of the nodes, and an extraction of each new piece.
    static osg::ref_ptr<const CasterDrawables> of(osg::Node& root, const Selection& casters,
                                               const osg::ref_ptr<const CasterDrawables>& known);

protected:
    ~CasterDrawables() override = default;
};

/// Joins pieces into one mesh. It reads the graph: call it in the traversal that found the pieces.
/// @param origin  the mesh's origin, as CasterMesh takes it.
osg::ref_ptr<CasterMesh> meshOf(const CasterDrawables::List& pieces,
                                              const std::optional<osg::Vec3d>& origin = {});

} // namespace gnomon
