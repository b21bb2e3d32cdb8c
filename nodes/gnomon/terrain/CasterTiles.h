// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Casters.h>
#include <gnomon/ground/HullSolids.h>

#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// What BOX takes for objects: what is connected, group frame.
std::vector<BoxCaster> boxCastersOf(const CasterMesh& mesh);

/// What casts on a ground, in tiles of neighbours.
///
/// Drawables that share a corner are one unit, so that walls and a roof drawn apart are one house. A change of the casters
/// is found again for the units that it touches alone.
///
/// Cost  of a change: the units that changed, and a look at the bounds of all pieces.
class CasterTiles {
    static constexpr double infinite = std::numeric_limits<double>::infinity();

public:
    static constexpr std::size_t mostInTile = 256;

    /// Convex parts, or boxes, that stand near one another.
    struct Tile {
        std::uint64_t revision = 0; ///< another with each change, never used twice.
        std::vector<HullPart> parts;
        std::vector<BoxCaster> boxes;
        std::vector<unsigned> units;               ///< whose they are.
        glm::dvec3 low{infinite}, high{-infinite}; ///< bounds of all, group frame.
        std::size_t size() const { return units.size(); }
    };

    /// @param asBoxes  takes boxes, else parts.
    explicit CasterTiles(bool asBoxes) : _asBoxes(asBoxes) {}

    /// @param terrain  drawables that do not cast.
    void take(const Casters& casters, const std::set<const osg::Drawable*>& terrain);
    /// True if these were taken last.
    bool are(const Casters& casters) const { return _casters == &casters; }
    /// True if no view will ask for those taken last any more.
    bool areRetired() const { return !_casters || _casters->isRetired(); }
    const std::vector<Tile>& tiles() const { return _tiles; }
    bool asBoxes() const { return _asBoxes; }
    std::size_t size() const { return _size; } ///< of all tiles.
    /// Near the casters, group frame: shadows are floats about it. Another one only when most tiles are, too.
    const glm::dvec3& origin() const { return _origin; }

private:
    struct Unit {
        CasterList pieces;
        std::vector<unsigned> tiles;
    };
    /// Where a piece is, and how often it is among the casters.
    struct Place {
        unsigned unit;
        int times;
    };
    /// A cut of plan across an axis, or a leaf.
    struct Cut {
        int axis = -1; ///< -1: a leaf.
        double at = 0.0;
        unsigned low = 0, high = 0;  ///< cuts on either side.
        std::vector<unsigned> tiles; ///< of a leaf.
    };
    struct Found; // of a unit, before it is put into tiles

    CasterList changesTo(const Casters& casters, const std::set<const osg::Drawable*>& terrain);
    void dissolve(unsigned unit, CasterList& loose);
    std::vector<CasterList> weld(CasterList loose);
    Found find(CasterList pieces) const;
    void add(Found found);
    bool isOutgrown(std::size_t size) const;
    std::vector<Found> takeAll();
    void cutAnew(const std::vector<Found>& units);
    unsigned cut(std::vector<glm::dvec2>& places, std::size_t from, std::size_t to);
    unsigned tileAt(const glm::dvec2& place);
    unsigned changed(unsigned tile);

    const bool _asBoxes;
    osg::ref_ptr<const Casters> _casters;
    std::set<const osg::Drawable*> _terrain;
    std::unordered_map<const Caster*, Place> _places;
    std::unordered_map<unsigned, Unit> _units;
    std::vector<Tile> _tiles;
    std::vector<Cut> _cuts; ///< the last one is the root.
    std::size_t _size = 0, _sizeWhenCut = 0;
    unsigned _lastUnit = 0;
    std::uint64_t _lastRevision = 0;
    glm::dvec3 _origin{0.0};
    double _reach = 0.0; ///< of the casters about the origin when it was chosen.
};

} // namespace gnomon
