// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Selection.h>
#include <gnomon/casters/Caster.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/Casting.h>

#include <osg/BoundingBox>
#include <osg/Referenced>
#include <osg/Vec3d>
#include <osg/observer_ptr>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

class CasterLayers;
class CasterTable;
class KnownCasters;

/// What casts below a group as one view's levels of detail show it, in one revision: drawable by drawable, and as meshes
/// for those who ask. Immutable. ShadowCasterGroup::casters() has it.
///
/// After a change, unchanged drawables keep their Caster. Use the list to keep something for each drawable, and layers() to
/// treat all alike.
///
/// Cost
/// - 600 bytes a drawable. layers() and meshOf() extract the triangles; those under an LOD are kept.
/// Limits
/// - VertexTraverser lists what is left out.
/// Threads
/// - Any number; one at a time asks for the layers of casters of no group.
class Casters : public osg::Referenced {
public:
    /// What only its own code or state can draw as it is, one for each drawable and path.
    using SelfDrawings = std::vector<osg::ref_ptr<const SelfDrawing>>;
    /// Sums up the pieces.
    Casters(CasterList pieces, std::uint64_t fingerprint, std::uint64_t choice = 0, SelfDrawings drawings = {},
            std::string leftOut = {});

    /// True if there is no triangle.
    bool empty() const { return !bounds.valid(); }
    /// As meshes, made by whoever asks first, from those of the group before. The first call reads the graph as a cull
    /// traversal does.
    const CasterLayers& layers() const { return _hasLayers ? *_layers : madeLayers(); }
    /// True if somebody has asked for them.
    bool hasLayers() const { return _hasLayers; }

    /// Stands for these in a cache, which then keeps no caster. True once no view will ask for them any more.
    using Retired = std::shared_ptr<const std::atomic<bool>>;
    Retired retired() const { return _retired; }
    /// No view will ask for these any more: caches may let them go.
    void retire() const { *_retired = true; }
    bool isRetired() const { return *_retired; }

    const CasterList list;           ///< In traversal order.
    const SelfDrawings selfDrawings; ///< What only its own drawing shows as it is, for maps. Traversal order.
    const std::uint64_t fingerprint; ///< Changes with any piece.
    const std::uint64_t choice;      ///< Stands for the drawables under LODs, wherever they are.
    osg::BoundingBoxd bounds;        ///< Bounds of all triangles, group frame. Invalid without triangles.
    unsigned invalidTriangles = 0;   ///< Sum over the pieces.
    std::string invalidNode;         ///< Name of the first drawable with an invalid triangle.
    unsigned cutouts = 0;        ///< Pieces with triangles that are clear in part: only maps and rays know in which.
    std::string cutoutNode;      ///< Name of the first of them.
    unsigned drawnCutouts = 0;   ///< Of these, those whose clear parts drawing alone tells: not rays.
    std::string drawnCutoutNode; ///< Name of the first of them.
    unsigned screenDoors = 0;    ///< Pieces of Casting::byPixel.
    std::string screenDoorNode;  ///< Name of the first of them.
    std::string leftOut;         ///< See CasterVisitor::leftOut().

    /// Finds the casters below a node. Reads the graph as a cull traversal does.
    /// @param before  an earlier result, whose unchanged pieces are used again; may be null.
    /// @param view    whose levels of detail are taken; null: the finest.
    /// @param known   others that were met before, and gets those that are met now; may be null.
    /// @param rule    what of them casts.
    /// @return        `before` itself if nothing changed.
    ///
    /// Cost
    /// - One visit of the nodes, and an extraction of each new piece.
    static osg::ref_ptr<const Casters> of(osg::Node& root, const Selection& casters,
                                          const osg::ref_ptr<const Casters>& before, const CasterView* view = nullptr,
                                          KnownCasters* known = nullptr, const CastingRule& rule = {});

protected:
    ~Casters() override = default;

private:
    friend class CasterTable; ///< it makes the layers, under its lock.
    const CasterLayers& madeLayers() const;

    mutable osg::observer_ptr<CasterTable> _table;       ///< whose these are; null: none's.
    mutable std::shared_ptr<const CasterLayers> _layers; ///< null until somebody asks for them.
    mutable std::atomic<bool> _hasLayers{false};
    const std::shared_ptr<std::atomic<bool>> _retired = std::make_shared<std::atomic<bool>>(false);
};

/// Casters that views may ask for. Once these are let go, or replaced, they are retired: caches may let them go, too.
class CurrentCasters {
public:
    CurrentCasters() = default;
    CurrentCasters(CurrentCasters&& other) noexcept { _casters.swap(other._casters); }
    CurrentCasters& operator=(CurrentCasters&& other) noexcept {
        _casters.swap(other._casters);
        return *this;
    }
    ~CurrentCasters() { set(nullptr); }

    void set(const osg::ref_ptr<const Casters>& casters) {
        if (_casters && _casters != casters) _casters->retire();
        _casters = casters;
    }
    const osg::ref_ptr<const Casters>& get() const { return _casters; }

private:
    osg::ref_ptr<const Casters> _casters;
};

/// Joins pieces into one mesh. It reads the graph: call it in the traversal that found the pieces.
/// @param origin  the mesh's origin, as CasterMesh takes it.
osg::ref_ptr<CasterMesh> meshOf(const CasterList& pieces, const std::optional<osg::Vec3d>& origin = {});

/// Whether two closed boxes have a point in common.
inline bool touch(const osg::BoundingBoxd& a, const osg::BoundingBoxd& b) { return a.intersects(b); }

/// For each piece the first of those that it is connected with over vertices at exactly one place, group frame: walls and a
/// roof of a house that are drawn apart. Reads the graph as a cull traversal does.
///
/// Cost  sorts the pieces, and those vertices that are within another piece's bounds.
std::vector<std::size_t> weldedCasters(const CasterList& pieces);

} // namespace gnomon
