// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Selection.h>
#include <gnomon/casters/CasterDrawable.h>
#include <gnomon/casters/Casting.h>

#include <osg/BoundingBox>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace gnomon {

class CasterBodies;
class CasterMesh;
class LevelPieces;

/// The casters of a group, drawable by drawable, in one revision. ShadowCasterGroup::drawables() makes it.
///
/// Use it in a technique that keeps something for each drawable. After a change, unchanged drawables keep their pieces.
/// Use CasterLayers to treat all casters alike.
///
/// Cost
/// - 600 bytes a drawable. meshOf() extracts the triangles; those under an LOD are kept.
/// Limits
/// - VertexTraverser lists what is left out.
/// Threads
/// - Any number. The pieces never change.
class CasterDrawables : public osg::Referenced {
public:
    /// Pieces, one for each drawable and path.
    using List = std::vector<osg::ref_ptr<const CasterDrawable>>;
    /// What only its own code or state can draw as it is, one for each drawable and path.
    using OwnList = std::vector<osg::ref_ptr<const OwnDrawing>>;
    /// Sums up the pieces.
    CasterDrawables(List pieces, std::uint64_t fingerprint, std::uint64_t choice = 0, OwnList own = {},
                    std::string leftOut = {});

    /// True if there is no triangle.
    bool empty() const { return !bounds.valid(); }
    /// No view will ask for these any more: caches may let them go.
    void retire() const { _retired = true; }
    bool isRetired() const { return _retired; }

    const List list;                 ///< In traversal order.
    const OwnList own;               ///< What only its own drawing shows as it is, for maps. Traversal order.
    const std::uint64_t fingerprint; ///< Changes with any piece.
    const std::uint64_t choice;      ///< Stands for the drawables under LODs, wherever they are.
    osg::BoundingBoxd bounds;        ///< Bounds of all triangles, group frame. Invalid without triangles.
    unsigned invalidTriangles = 0;   ///< Sum over the pieces.
    std::string invalidNode;         ///< Name of the first drawable with an invalid triangle.
    unsigned cutouts = 0;            ///< Pieces with triangles that are clear in part: only maps know in which.
    std::string cutoutNode;          ///< Name of the first of them.
    std::string leftOut;             ///< See CasterVisitor::leftOut().

    /// Finds the casters below a node. Reads the graph as a cull traversal does.
    /// @param known   an earlier result, whose unchanged pieces are used again; may be null.
    /// @param view    whose levels of detail are taken; null: the finest.
    /// @param levels  pieces under LODs that were met before, and gets those that are met now; may be null.
    /// @param bodies  whose vertices tell where a body is; may be null.
    /// @param rule    what of them casts.
    /// @return        `known` itself if nothing changed.
    ///
    /// Cost
    /// - One visit of the nodes, and an extraction of each new piece.
    static osg::ref_ptr<const CasterDrawables> of(osg::Node& root, const Selection& casters,
                                                  const osg::ref_ptr<const CasterDrawables>& known,
                                                  const CasterView* view = nullptr, LevelPieces* levels = nullptr,
                                                  const CasterBodies* bodies = nullptr, const CastingRule& rule = {});

protected:
    ~CasterDrawables() override = default;

private:
    mutable std::atomic<bool> _retired{false};
};

/// The pieces under LODs that were met lately, so that a level that comes back is not extracted again.
///
/// Cost
/// - The triangles of levels that no view has now: as many as three times those that are seen, or a million.
/// Threads
/// - One at a time. The owner locks.
class LevelPieces {
public:
    /// Null if it is not known.
    const CasterDrawable* find(std::uint64_t fingerprint);
    void add(const CasterDrawable& piece);
    /// A visit of the graph begins.
    void startVisit() { ++_visit; }
    /// Drops what is in no graph any more, and what was met longest ago if there is too much.
    void prune();
    void clear() { _known.clear(); }

private:
    struct Known {
        osg::ref_ptr<const CasterDrawable> piece;
        unsigned lastVisit;
    };
    std::unordered_map<std::uint64_t, Known> _known;
    unsigned _visit = 0;
};

/// Joins pieces into one mesh. It reads the graph: call it in the traversal that found the pieces.
/// @param origin  the mesh's origin, as CasterMesh takes it.
osg::ref_ptr<CasterMesh> meshOf(const CasterDrawables::List& pieces, const std::optional<osg::Vec3d>& origin = {});

/// Whether two closed boxes have a point in common.
inline bool touch(const osg::BoundingBoxd& a, const osg::BoundingBoxd& b) { return a.intersects(b); }

/// For each piece the first of those that it is connected with over vertices at exactly one place, group frame: walls and a
/// roof of a house that are drawn apart. Reads the graph as a cull traversal does.
///
/// Cost  sorts the pieces, and those vertices that are within another piece's bounds.
std::vector<std::size_t> weldedDrawables(const CasterDrawables::List& pieces);

} // namespace gnomon
