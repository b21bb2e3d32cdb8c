// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>
#include <gnomon/onterrain/PartShadow.h>
#include <gnomon/overlay/ShadowDecals.h>
#include <gnomon/overlay/ShadowPrisms.h>
#include <gnomon/terrain/TileUpdates.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double sameLight = 1e-12; // of its length: what turning a view takes off it in double
// Of what a tile may be off: so that those which fall due together are spread over frames.
constexpr double worthFinding = 0.75;
constexpr std::size_t atOnce = 8;     // tiles, between looks at the clock
constexpr std::size_t mostSpare = 64; // as many as are found anew in a frame while the sun moves on

bool isSun(const glm::dvec4& light) { return light.w == 0.0 && light.z > 0.0; }
bool isBelow(const glm::dvec4& light) { return light.w == 0.0 && !(light.z > 0.0); }

void add(PackedShadows& found, const TerrainShadow& shadow) {
    for (const glm::dvec3& corner : shadow.triangles) {
        found.indices.push_back(unsigned(found.corners.size()) -
                                (found.cornerEnds.empty() ? 0 : found.cornerEnds.back()));
        found.corners.emplace_back(corner - found.origin);
    }
    found.cornerEnds.push_back(unsigned(found.corners.size()));
    found.indexEnds.push_back(unsigned(found.indices.size()));
    found.outcomes.push_back(shadow.outcome);
}

PackedShadows boxShadows(const Ground& ground, const CasterTiles::Tile& tile, const glm::dvec4& light,
                         const glm::dvec3& origin) {
    PackedShadows found;
    found.origin = origin;
    for (const BoxCaster& caster : tile.boxes) add(found, boxShadowOf(ground, caster, light));
    return found;
}

void measure(TileShadows& shadows) {
    shadows.low = glm::dvec2(infinite);
    shadows.high = glm::dvec2(-infinite);
    shadows.widest = 0.0;
    shadows.outcomes = {};
    for (std::size_t i = 0; i < shadows.found.size(); ++i) {
        const PackedShadow shadow = shadows.found[i];
        shadows.outcomes.add(shadow.outcome);
        glm::dvec3 low(infinite), high(-infinite);
        for (std::size_t k = 0; k < shadow.cornerCount; ++k)
            low = glm::min(low, glm::dvec3(shadow.corners[k])), high = glm::max(high, glm::dvec3(shadow.corners[k]));
        if (shadow.cornerCount > 0) shadows.widest = std::max(shadows.widest, glm::length(high - low));
        shadows.low = glm::min(shadows.low, glm::dvec2(low));
        shadows.high = glm::max(shadows.high, glm::dvec2(high));
    }
}

/// Decals lie on the ground that is drawn; of the rest, which may stand for it, no more is known than where it is in plan.
double slopeUnder(const HeightPyramid& ground, const TileMesh& decals, const glm::dvec3& origin) {
    if (decals.triangles() == 0) return 0.0;
    const auto cellOf = [&](const glm::dvec3& place) {
        return ground.field().cellOf(origin.x + place.x, origin.y + place.y);
    };
    const glm::dvec2 a = cellOf(decals.low), b = cellOf(decals.high);
    const auto cells = ground.cells(glm::min(a, b), glm::max(a, b));
    return cells ? ground.steepest(*cells) : 0.0;
}

void setMeshes(const TileGround& ground, TileShadows& shadows) {
    thread_local ShadowDecals decals; // memory that is used again
    thread_local ShadowPrisms prisms;
    if (ground.drawn) {
        shadowDecals(*ground.drawn, shadows.found, decals);
        shadows.decals->set(decals);
        shadows.slope = slopeUnder(*ground.drawn, *shadows.decals, shadows.found.origin);
    } else
        shadows.decals->set(ShadowDecals());
    shadowPrisms(ground.found, shadows.found, ground.margin, ground.drawn, prisms);
    shadows.prisms->set(prisms);
}

osg::ref_ptr<TileShadows> drawable() {
    osg::ref_ptr<TileShadows> result = new TileShadows;
    result->decals = new TileMesh;
    result->prisms = new TileMesh;
    return result;
}

bool isFine(const TileBitmap& bitmap, int level) {
    return bitmap.level() <= level && bitmap.level() >= level - TileVisibility::finerLevels;
}

double lowestOf(const Ground& ground) {
    const auto range = ground.range(glm::dvec2(-infinite), glm::dvec2(infinite));
    return range ? range->low : infinite;
}

} // namespace

void findShadows(const TileGround& ground, const CasterTiles::Tile& tile, const glm::dvec4& light,
                 const TerrainSettings& settings, const glm::dvec3& origin, TileShadows& into) {
    into.light = light;
    if (settings.asBoxes)
        into.found = boxShadows(ground.found, tile, light, origin);
    else
        packedShadows(ground.found, tile.parts, light, settings.method, settings.error, origin, into.found);
    measure(into);
    if (into.prisms) setMeshes(ground, into);
}

/// What is to be found anew.
struct TileUpdates::Requests {
    struct Late {
        std::size_t tile;
        double off; ///< of what it may be.
        bool operator<(const Late& other) const { return off > other.off; }
    };
    std::vector<std::size_t> due; ///< now.
    std::vector<Late> late;       ///< as far as there is time.
    bool letGo = false;           ///< some tile's shadows are.
};

TileUpdates::TileUpdates() : _none(drawable()) {}

void TileUpdates::groundChanged() {
    _states.clear();
    _lowest = std::nullopt;
    _groundShadowsItself = std::nullopt;
    _turn.groundChanged();
}

bool TileUpdates::isSame(const glm::dvec4& light) const {
    return light.w == _light.w && glm::length(light - _light) <= sameLight * glm::length(light);
}

void TileUpdates::update(const CasterTiles& town, const TileGround& ground, const glm::dvec4& light,
                         const TerrainSettings& settings, const TileVisibility& view, double seconds) {
    const Clock::time_point start = Clock::now();
    const bool still = isSame(light);
    if (!still) _light = light;
    if (!still || !_groundShadowsItself)
        _groundShadowsItself = !isLightBelow(ground.found, light) && _turn.isTurnedAway(ground.found, light);
    if (!(settings == _settings)) _states.clear();
    _settings = settings;
    const std::vector<CasterTiles::Tile>& tiles = town.tiles();
    _shadows.resize(tiles.size(), _none);
    _states.resize(tiles.size(), 0);
    _bitmaps.resize(tiles.size());
    _followed.resize(tiles.size());
    _finest.resize(tiles.size());
    if (!_lowest) _lowest = lowestOf(ground.found);
    Requests wanted = requestsIn(view, town, ground, still);
    if (wanted.due.empty() && wanted.late.empty() && !wanted.letGo) return;
    find(town, ground, wanted.due);
    std::sort(wanted.late.begin(), wanted.late.end());
    const auto isTime = [&] { return std::chrono::duration<double>(Clock::now() - start).count() < seconds; };
    for (auto next = wanted.late.begin(); next != wanted.late.end() && isTime();) {
        std::vector<std::size_t> some;
        for (; next != wanted.late.end() && some.size() < atOnce; ++next) some.push_back(next->tile);
        find(town, ground, some);
    }
    countOutcomes(town);
}

/// A tile that is to be drawn by a bitmap.
struct TileUpdates::Far {
    std::size_t tile;
    int level; ///< of the bitmap.
    bool operator<(const Far& other) const { return level > other.level; }
};

/// The farthest, until few enough triangles are left. What is near would take too many texels.
std::vector<TileUpdates::Far> TileUpdates::farIn(const TileVisibility& view) const {
    std::vector<Far> far;
    std::size_t left = 0;
    for (std::size_t i = 0; i < _shadows.size(); ++i) {
        const auto level = view.bitmapLevel(*_shadows[i]);
        if (level) far.push_back({i, *level});
        if (level || view.seen(*_shadows[i]->decals, *_shadows[i])) left += _shadows[i]->decals->triangles();
    }
    std::stable_sort(far.begin(), far.end());
    std::size_t count = 0;
    for (; count < far.size() && left > view.options().mostDecals; ++count)
        left -= _shadows[far[count].tile]->decals->triangles();
    far.resize(count);
    return far;
}

/// As fine as any view of late wants it: views of one group take turns, and what is finer than need be is right. But for
/// shadows that have become too large for that.
int TileUpdates::levelFor(const Far& one) {
    constexpr unsigned lately = 64; // calls
    FinestRequest& finest = _finest[one.tile];
    const bool isPast =
        _calls - finest.call > lately || !TileVisibility::isBitmapSmall(*_shadows[one.tile], finest.level);
    if (one.level <= finest.level || isPast) finest = {one.level, _calls};
    return finest.level;
}

TileUpdates::Bitmaps TileUpdates::bitmapsIn(const TileVisibility& view, const TileGround& ground) {
    Bitmaps result(_shadows.size());
    if (!ground.drawn || !view.options().filter) return result;
    std::vector<Far> far = farIn(view);
    ++_calls;
    for (Far& one : far) one.level = levelFor(one);
    tbb::parallel_for(std::size_t{0}, far.size(), [&](std::size_t i) {
        const auto [tile, level] = far[i];
        osg::ref_ptr<TileBitmap>& known = _bitmaps[tile];
        if (known && isFine(*known, level)) return;
        thread_local ShadowBitmap bitmap; // memory that is used again
        shadowBitmap(*ground.drawn, _shadows[tile]->found, TileVisibility::bitmapTexel(level), bitmap);
        known = new TileBitmap(bitmap, level, _sheets);
    });
    for (const Far& one : far)
        if (_bitmaps[one.tile]->triangles() < _shadows[one.tile]->decals->triangles())
            result[one.tile] = _bitmaps[one.tile];
    return result;
}

TileUpdates::Requests TileUpdates::requestsIn(const TileVisibility& view, const CasterTiles& town,
                                              const TileGround& ground, bool still) {
    Requests wanted;
    std::vector<Off> offs(town.tiles().size());
    tbb::parallel_for(std::size_t{0}, offs.size(), [&](std::size_t i) { offs[i] = offIn(view, i, town, ground); });
    for (std::size_t i = 0; i < offs.size(); ++i) {
        const auto [off, mayBe] = offs[i];
        if (off == 0.0) continue;
        if (!(off <= mayBe))
            wanted.due.push_back(i);
        else if (mayBe < infinite && (still || off > worthFinding * mayBe))
            wanted.late.push_back({i, off / mayBe});
        else if (!(off < infinite) && _shadows[i] != _none) {
            letGo(i);
            wanted.letGo = true;
        }
    }
    return wanted;
}

void TileUpdates::letGo(std::size_t tile) {
    _shadows[tile] = _none;
    _bitmaps[tile] = nullptr;
    _followed[tile].clear();
    _states[tile] = 0;
}

/// How far in plan an edge of a tile's shadows may be off; infinite if not known.
double TileUpdates::offBy(std::size_t tile, const CasterTiles& town) const {
    if (_states[tile] != town.tiles()[tile].revision) return infinite;
    const TileShadows& shadows = *_shadows[tile];
    if (shadows.light == _light || (isBelow(shadows.light) && isBelow(_light))) return 0.0;
    if (_settings.asBoxes) return infinite;
    return movedAtMost(shadows.found, shadows.light, _light);
}

/// Where that is too much, by looking at those of its shadows of which too little is known.
TileUpdates::Off TileUpdates::offIn(const TileVisibility& view, std::size_t tile, const CasterTiles& town,
                                    const TileGround& ground) {
    Off off{offBy(tile, town), infinite};
    if (off.by == 0.0) return off;
    off.mayBe = mayBeOff(tile, off.by, town, ground, view);
    const TileShadows& shadows = *_shadows[tile];
    const bool canFollow = !_settings.asBoxes && isSun(shadows.light) && isSun(_light) &&
                           glm::length(wayOf(_light) - wayOf(shadows.light)) <= ShadowRates::mostTurned;
    const bool isSame = _states[tile] == town.tiles()[tile].revision;
    if (off.by <= worthFinding * off.mayBe || !isSame || !canFollow) return off;
    const PackedParts& parts = town.tiles()[tile].parts;
    ShadowDrift& followed = _followed[tile];
    if (followed.empty()) followed.begin(ground.found, parts, shadows.found, shadows.light);
    // Where only what casts them is seen, all that is not known.
    const double seen =
        std::min(std::max(_settings.error, view.mayBeOff(shadows, 0.0)), std::numeric_limits<double>::max());
    off.by = std::min(off.by, followed.look(ground.found, parts, shadows.found, _light, _settings.method,
                                            _settings.error, worthFinding * seen, seen));
    off.mayBe = mayBeOff(tile, off.by, town, ground, view);
    return off;
}

/// By how much they may be; infinite if nothing of them can be seen.
double TileUpdates::mayBeOff(std::size_t tile, double off, const CasterTiles& town, const TileGround& ground,
                             const TileVisibility& view) const {
    if (off < infinite) return std::max(_settings.error, view.mayBeOff(*_shadows[tile], off));
    const CasterTiles::Tile& casters = town.tiles()[tile];
    const glm::dvec3& origin = town.origin();
    const bool isSeen = _settings.asBoxes || view.maySeeShadowsOf(casters.low - origin, casters.high - origin, _light,
                                                                  *_lowest - origin.z, ground.margin);
    return isSeen ? 0.0 : infinite;
}

/// None that a frame still to be drawn holds.
osg::ref_ptr<TileShadows> TileUpdates::unused() {
    for (std::size_t i = 0; i < _spare.size(); ++i)
        if (_spare[i]->referenceCount() == 1) {
            const osg::ref_ptr<TileShadows> result = _spare[i];
            _spare.erase(_spare.begin() + std::ptrdiff_t(i));
            return result;
        }
    return drawable();
}

void TileUpdates::find(const CasterTiles& town, const TileGround& ground, const std::vector<std::size_t>& tiles) {
    std::vector<osg::ref_ptr<TileShadows>> into(tiles.size());
    for (osg::ref_ptr<TileShadows>& shadows : into) shadows = unused();
    ProgressLine progress("gnomon: finding shadows on terrain");
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
        findShadows(ground, town.tiles()[tiles[i]], _light, _settings, town.origin(), *into[i]);
        _followed[tiles[i]].clear();
        progress.show(double(++done) / double(tiles.size()));
    });
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const osg::ref_ptr<TileShadows> old = const_cast<TileShadows*>(_shadows[tiles[i]].get());
        _shadows[tiles[i]] = into[i];
        _bitmaps[tiles[i]] = nullptr;
        _states[tiles[i]] = town.tiles()[tiles[i]].revision;
        if (old != _none.get() && _spare.size() < mostSpare) _spare.push_back(old);
    }
    _found += static_cast<unsigned>(tiles.size());
}

void TileUpdates::countOutcomes(const CasterTiles& town) {
    OutcomeCounts all;
    for (std::size_t i = 0; i < town.tiles().size(); ++i) all.add(_shadows[i]->outcomes);
    _causes = all.causes();
}

/// Of all that are drawn or may be again.
template <typename Act>
void TileUpdates::eachMesh(const Act& act) const {
    const auto both = [&](const TileShadows& shadows) { act(*shadows.decals), act(*shadows.prisms); };
    for (const auto& shadows : _shadows) both(*shadows);
    for (const auto& shadows : _spare) both(*shadows);
}

void TileUpdates::resizeGLObjectBuffers(unsigned maxSize) {
    eachMesh([&](TileMesh& mesh) { mesh.resizeGLObjectBuffers(maxSize); });
    for (const auto& bitmap : _bitmaps)
        if (bitmap) bitmap->resizeGLObjectBuffers(maxSize);
    _sheets.resizeGLObjectBuffers(maxSize);
}

void TileUpdates::releaseGLObjects(osg::State* state) const {
    eachMesh([&](const TileMesh& mesh) { mesh.releaseGLObjects(state); });
    for (const auto& bitmap : _bitmaps)
        if (bitmap) bitmap->releaseGLObjects(state);
    _sheets.releaseGLObjects(state);
}

} // namespace gnomon
