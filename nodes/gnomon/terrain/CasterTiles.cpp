// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ProgressLine.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/terrain/CasterTiles.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <string>
#include <tuple>

namespace gnomon {
namespace {

constexpr std::size_t fewEnough = 64; // pieces: others' bounds are compared with each one's, of more with all at once

/// Of pieces some of which are new.
class TouchesAny {
public:
    explicit TouchesAny(const CasterList& pieces) {
        for (const auto& piece : pieces) {
            if (pieces.size() <= fewEnough) _boxes.push_back(piece->bounds);
            _all.expandBy(piece->bounds);
        }
    }
    bool operator()(const osg::BoundingBoxd& box) const {
        if (!touch(box, _all)) return false;
        return _boxes.empty() ||
               std::any_of(_boxes.begin(), _boxes.end(), [&](const auto& other) { return touch(box, other); });
    }

private:
    std::vector<osg::BoundingBoxd> _boxes;
    osg::BoundingBoxd _all;
};

void measure(CasterTiles::Tile& tile) {
    const CasterTiles::Tile none;
    tile.low = none.low;
    tile.high = none.high;
    const auto take = [&](const glm::dvec3& point) {
        tile.low = glm::min(tile.low, point);
        tile.high = glm::max(tile.high, point);
    };
    for (const BoxCaster& box : tile.boxes) take(box.low), take(box.high);
    for (const HullPart& part : tile.parts)
        for (const glm::vec3& corner : part.corners) take(part.anchor + glm::dvec3(corner));
}

/// The last one takes the place of the one that goes.
template <typename List>
void removeAt(List& list, std::size_t at) {
    if (at + 1 < list.size()) list[at] = std::move(list.back());
    list.pop_back();
}

} // namespace

std::vector<BoxCaster> boxCastersOf(const CasterMesh& mesh) {
    std::vector<BoxCaster> boxes;
    if (mesh.triangles->empty()) return boxes;
    for (auto& points :
         connectedPoints(positionsOf(mesh), mesh.vertices->size(), &mesh.triangles->front(), mesh.triangles->size())) {
        for (glm::dvec3& point : points) point += toGlm(mesh.origin);
        boxes.push_back(boxCaster(points));
    }
    return boxes;
}

/// Of one unit, or of all.
struct CasterTiles::Found {
    CasterList pieces;
    std::vector<HullPart> parts;
    std::vector<BoxCaster> boxes;

    std::size_t size() const { return parts.size() + boxes.size(); }
    glm::dvec2 place(std::size_t i) const { return boxes.empty() ? glm::dvec2(parts[i].anchor) : boxes[i].vertices[0]; }
};

void CasterTiles::take(const Casters& casters, const std::set<const osg::Drawable*>& terrain) {
    if (_casters == &casters && _terrain == terrain) return;
    const std::uint64_t before = _lastRevision;
    CasterList loose = changesTo(casters, terrain);
    _casters = &casters;
    _terrain = terrain;
    std::vector<CasterList> units = weld(std::move(loose));
    std::vector<Found> found(units.size());
    ProgressLine progress("gnomon: finding the parts of " + std::to_string(units.size()) + " casters");
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, units.size(), [&](std::size_t i) {
        found[i] = find(std::move(units[i]));
        progress.show(double(++done) / double(units.size()));
    });
    std::size_t size = _size;
    for (const Found& unit : found) size += unit.size();
    if (isOutgrown(size)) {
        std::vector<Found> all = takeAll();
        std::move(found.begin(), found.end(), std::back_inserter(all));
        found = std::move(all);
        cutAnew(found);
    }
    for (Found& unit : found) add(std::move(unit));
    tbb::parallel_for_each(_tiles, [before](Tile& tile) {
        if (tile.revision > before) measure(tile);
    });
}

/// Takes out what is gone. @return what is new, or has lost what it was connected with.
CasterList CasterTiles::changesTo(const Casters& casters, const std::set<const osg::Drawable*>& terrain) {
    const auto& now = casters.list;
    const CasterList none, &before = _casters ? _casters->list : none;
    auto from = now.begin(), to = now.end();
    auto fromBefore = before.begin(), toBefore = before.end();
    if (terrain == _terrain) {
        std::tie(from, fromBefore) = std::mismatch(from, to, fromBefore, toBefore);
        while (to != from && toBefore != fromBefore && *(to - 1) == *(toBefore - 1)) --to, --toBefore;
    }
    for (auto piece = fromBefore; piece != toBefore; ++piece)
        if (const auto place = _places.find(piece->get()); place != _places.end()) --place->second.times;
    CasterList loose;
    for (auto piece = from; piece != to; ++piece) {
        if (!(*piece)->bounds.valid() || terrain.count((*piece)->drawable.get())) continue;
        const auto [place, isNew] = _places.try_emplace(piece->get(), Place{0, 0});
        ++place->second.times;
        if (isNew) loose.push_back(*piece);
    }
    for (auto piece = fromBefore; piece != toBefore; ++piece) {
        const auto place = _places.find(piece->get());
        if (place != _places.end() && place->second.times <= 0) dissolve(place->second.unit, loose);
    }
    return loose;
}

/// Its pieces that are still there become loose.
void CasterTiles::dissolve(unsigned unit, CasterList& loose) {
    const Unit gone = std::move(_units[unit]);
    _units.erase(unit);
    for (const unsigned index : gone.tiles) {
        Tile& tile = _tiles[changed(index)];
        for (std::size_t i = tile.size(); i-- > 0;) {
            if (tile.units[i] != unit) continue;
            _asBoxes ? removeAt(tile.boxes, i) : removeAt(tile.parts, i);
            removeAt(tile.units, i);
            --_size;
        }
    }
    for (const auto& piece : gone.pieces) {
        const auto place = _places.find(piece.get());
        if (place->second.times > 0) {
            place->second.unit = 0;
            loose.push_back(piece);
        } else
            _places.erase(place);
    }
}

/// Units of all that is loose; what is connected with it is taken out of its own.
std::vector<CasterList> CasterTiles::weld(CasterList loose) {
    if (loose.empty()) return {};
    const TouchesAny touchesLoose(loose);
    CasterList all = loose;
    for (const auto& piece : _casters->list) {
        if (!piece->bounds.valid() || !touchesLoose(piece->bounds)) continue;
        const auto place = _places.find(piece.get());
        if (place != _places.end() && place->second.unit != 0) all.push_back(piece);
    }
    const std::vector<std::size_t> first = weldedCasters(all);
    std::map<std::size_t, CasterList> units;
    for (std::size_t i = 0; i < loose.size(); ++i) units[first[i]].push_back(all[i]);
    for (std::size_t i = loose.size(); i < all.size(); ++i) {
        const auto unit = units.find(first[i]);
        const unsigned former = _places[all[i].get()].unit;
        if (unit != units.end() && former != 0) dissolve(former, unit->second);
    }
    std::vector<CasterList> result;
    for (auto& [root, unit] : units) result.push_back(std::move(unit));
    return result;
}

CasterTiles::Found CasterTiles::find(CasterList pieces) const {
    Found found;
    const osg::ref_ptr<const CasterMesh> mesh = meshOf(pieces);
    const osg::DrawElementsUInt& triangles = *mesh->triangles;
    if (_asBoxes)
        found.boxes = boxCastersOf(*mesh);
    else
        for (const ConvexPart& part :
             convexParts(positionsOf(*mesh), mesh->vertices->size(), &triangles.front(), triangles.size())) {
            found.parts.emplace_back(part);
            found.parts.back().anchor += toGlm(mesh->origin);
        }
    found.pieces = std::move(pieces);
    return found;
}

void CasterTiles::add(Found found) {
    Unit& unit = _units[++_lastUnit];
    for (std::size_t i = 0; i < found.size(); ++i) {
        Tile& tile = _tiles[changed(tileAt(found.place(i)))];
        if (_asBoxes)
            tile.boxes.push_back(found.boxes[i]);
        else
            tile.parts.push_back(std::move(found.parts[i]));
        tile.units.push_back(_lastUnit);
        const auto index = static_cast<unsigned>(&tile - _tiles.data());
        if (std::find(unit.tiles.begin(), unit.tiles.end(), index) == unit.tiles.end()) unit.tiles.push_back(index);
    }
    _size += found.size();
    for (const auto& piece : found.pieces) _places[piece.get()].unit = _lastUnit;
    unit.pieces = std::move(found.pieces);
}

/// Whether tiles would be too full, too empty, or too far from the origin for floats.
bool CasterTiles::isOutgrown(std::size_t size) const {
    constexpr double mostReaches = 4.0; // two bits of a float
    if (_cuts.empty() || size > std::max(2 * _sizeWhenCut, mostInTile) || 4 * size + mostInTile < _sizeWhenCut)
        return true;
    if (_casters->empty()) return false;
    const osg::BoundingBoxd& bounds = _casters->bounds;
    return glm::length(toGlm(bounds.center()) - _origin) + bounds.radius() > mostReaches * _reach;
}

std::vector<CasterTiles::Found> CasterTiles::takeAll() {
    std::map<unsigned, Found> units;
    for (auto& [number, unit] : _units) units[number].pieces = std::move(unit.pieces);
    for (Tile& tile : _tiles)
        for (std::size_t i = 0; i < tile.size(); ++i) {
            Found& unit = units[tile.units[i]];
            if (_asBoxes)
                unit.boxes.push_back(tile.boxes[i]);
            else
                unit.parts.push_back(std::move(tile.parts[i]));
        }
    _units.clear();
    _tiles.clear();
    _size = 0;
    std::vector<Found> result;
    for (auto& [number, unit] : units) result.push_back(std::move(unit));
    return result;
}

void CasterTiles::cutAnew(const std::vector<Found>& units) {
    std::vector<glm::dvec2> places;
    for (const Found& unit : units)
        for (std::size_t i = 0; i < unit.size(); ++i) places.push_back(unit.place(i));
    _cuts.clear();
    cut(places, 0, places.size());
    _sizeWhenCut = places.size();
    _reach = _casters->empty() ? 0.0 : _casters->bounds.radius();
    _origin = _casters->empty() ? glm::dvec3(0.0) : toGlm(_casters->bounds.center());
}

/// @return its place among the cuts, of which it is the last.
unsigned CasterTiles::cut(std::vector<glm::dvec2>& places, std::size_t from, std::size_t to) {
    Cut result;
    if (to - from <= mostInTile * 3 / 4) { // some room for others
        _tiles.emplace_back();
        result.tiles = {changed(static_cast<unsigned>(_tiles.size() - 1))};
    } else {
        const auto begin = places.begin() + std::ptrdiff_t(from), end = places.begin() + std::ptrdiff_t(to);
        glm::dvec2 low = *begin, high = *begin;
        for (auto place = begin; place != end; ++place) low = glm::min(low, *place), high = glm::max(high, *place);
        const int axis = high.x - low.x >= high.y - low.y ? 0 : 1;
        const std::size_t middle = from + (to - from) / 2;
        std::nth_element(begin, places.begin() + std::ptrdiff_t(middle), end,
                         [axis](const glm::dvec2& a, const glm::dvec2& b) { return a[axis] < b[axis]; });
        result.axis = axis;
        result.at = places[middle][axis];
        result.low = cut(places, from, middle);
        result.high = cut(places, middle, to);
    }
    _cuts.push_back(std::move(result));
    return static_cast<unsigned>(_cuts.size() - 1);
}

/// One with room, about there.
unsigned CasterTiles::tileAt(const glm::dvec2& place) {
    unsigned at = static_cast<unsigned>(_cuts.size() - 1);
    while (_cuts[at].axis >= 0) at = place[_cuts[at].axis] < _cuts[at].at ? _cuts[at].low : _cuts[at].high;
    std::vector<unsigned>& tiles = _cuts[at].tiles;
    if (_tiles[tiles.back()].size() >= mostInTile) {
        tiles.push_back(static_cast<unsigned>(_tiles.size()));
        _tiles.emplace_back();
    }
    return tiles.back();
}

/// @return the tile.
unsigned CasterTiles::changed(unsigned tile) {
    _tiles[tile].revision = ++_lastRevision;
    return tile;
}

} // namespace gnomon
