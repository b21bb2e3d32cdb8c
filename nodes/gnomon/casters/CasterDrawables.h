// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
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

/// A drawable that casts, on one way down to it, in one revision. Never changes once made.
struct GNOMON_EXPORT CasterDrawable : public osg::Referenced {
    std::uint64_t fingerprint = 0; ///< of all that CasterExtraction reads of it; see CasterFingerprint.
    osg::ref_ptr<const osg::Drawable> drawable;
    osg::Matrixd groupFromLocal;
    std::optional<AlphaTest> test; ///< that leaves parts of it; nullopt if there is none.
    osg::BoundingBoxd bounds;      ///< of all its triangles, group frame; invalid if there is none.
    std::size_t triangles = 0;
    unsigned invalidTriangles = 0; ///< left out; see CasterExtraction::getInvalidTriangles().
    std::string invalidNode;       ///< where the first of them is.
    unsigned unknownTests = 0;     ///< see CasterExtraction::getUnknownTests().
    std::string unknownNode;       ///< where the first of them is.
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< see CasterExtraction::getSources().

protected:
    ~CasterDrawable() override = default;
};

/// What casts below a group in one revision, drawable by drawable: of a change, all but what changed are the same pieces.
///
/// Cost    600 bytes a drawable. What it looks like is not kept; see meshOf().
class GNOMON_EXPORT CasterDrawables : public osg::Referenced {
public:
    using List = std::vector<osg::ref_ptr<const CasterDrawable>>;
    CasterDrawables(List pieces, std::uint64_t fingerprint);

    bool empty() const { return !bounds.valid(); }

    const List list;                 ///< in the order in which a traversal meets them.
    const std::uint64_t fingerprint; ///< of all, that of CasterFingerprint.
    osg::BoundingBoxd bounds;        ///< of all triangles, group frame; invalid if there is none.
    unsigned invalidTriangles = 0;   ///< of all.
    std::string invalidNode;         ///< where the first of them is.
    unsigned unknownTests = 0;       ///< of all.
    std::string unknownNode;         ///< where the first of them is.

    /// Those below a node now. Reads the graph as a cull traversal does.
    /// @param known  an earlier answer, whose pieces are used again; may be null.
    /// @return `known` itself if nothing changed.
    ///
    /// Cost  a visit of the nodes; an extraction (CasterExtraction) of each piece that is new.
    static osg::ref_ptr<const CasterDrawables> of(osg::Node& root, const Selection& casters,
                                                  const osg::ref_ptr<const CasterDrawables>& known);

protected:
    ~CasterDrawables() override = default;
};

/// Pieces as one mesh. Reads the graph as a cull traversal does: call it in the traversal that found them.
/// @param origin  of the mesh; see CasterMesh.
GNOMON_EXPORT osg::ref_ptr<CasterMesh> meshOf(const CasterDrawables::List& pieces,
                                              const std::optional<osg::Vec3d>& origin = {});

} // namespace gnomon
