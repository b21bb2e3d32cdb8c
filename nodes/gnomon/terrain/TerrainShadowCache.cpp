// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ground/GroundIntersection.h>
#include <gnomon/terrain/TerrainShadowCache.h>
#include <gnomon/terrain/TileVisibility.h>

#include <OpenThreads/ScopedLock>
#include <glm/matrix.hpp>
#include <osgUtil/RenderLeaf>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// Runs work of TBB under the cache's lock. Isolated: a thread that waits for it must not take up a task of the caller's,
/// which might ask for the lock in turn.
template <typename Work>
void runLocked(OpenThreads::Mutex& mutex, const Work& work) {
    Lock lock(mutex);
    tbb::this_task_arena::isolate(work);
}

constexpr std::size_t mostTowns = 4;   // groups above one node, and views of different levels of detail
constexpr double secondsAFrame = 2e-3; // on what may wait: an eighth of a frame at 60 Hz
// Of a shadow's diameter, beyond the ground under it: a coarser level of detail may lie that far off.
constexpr double marginOfLevels = 0.5;
constexpr double marginOfGround = 0.05; // for what a depth buffer and floats leave of heights

TileGround groundOf(const GroundRevision& drawn) {
    const bool isAsFound = !drawn.hasLevels && !drawn.hasQuads;
    const auto* grid = isAsFound ? dynamic_cast<const HeightPyramid*>(drawn.ground.get()) : nullptr;
    return {*drawn.ground, grid, drawn.hasLevels ? marginOfLevels : marginOfGround};
}

/// The eye is over ground without holes: to see some of it from below, a line of sight would have to go through it first, or a
/// clip plane through the ground, near ones included, would have to open it.
bool isFromAbove(const ViewFrame& view, const TileGround& ground) {
    if (!ground.drawn || !std::isfinite(ground.drawn->steepest())) return false;
    const glm::dmat4 clipFromGroup = toGlm(view.eyeFromGroup * view.projection);
    const glm::dvec4 eye = eyeIn(clipFromGroup);
    if (!(eye.w > 0.0 && glm::determinant(clipFromGroup) < 0.0))
        return false; // a mirrored view's determinant is above 0
    const glm::dvec3 place = glm::dvec3(eye) / eye.w;
    const auto height = ground.drawn->height(place.x, place.y);
    return height && place.z > *height;
}

bool isInside(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::dvec3& p) {
    const double sides[] = {doubleArea(a, b, p), doubleArea(b, c, p), doubleArea(c, a, p)};
    return std::all_of(sides, sides + 3, [](double side) { return side >= 0.0; }) ||
           std::all_of(sides, sides + 3, [](double side) { return side <= 0.0; });
}

bool covers(const PackedShadow& shadow, const glm::dvec3& p) {
    const glm::vec3* corners = shadow.corners;
    for (std::size_t i = 2; shadow.isFan() && i < shadow.cornerCount; ++i)
        if (isInside(corners[0], corners[i - 1], corners[i], p)) return true;
    for (std::size_t i = 0; i + 2 < shadow.indexCount; i += 3)
        if (isInside(corners[shadow.indices[i]], corners[shadow.indices[i + 1]], corners[shadow.indices[i + 2]], p))
            return true;
    return false;
}

bool covers(const TileShadows& tile, const glm::dvec3& p) {
    if (!(tile.low.x <= p.x && p.x <= tile.high.x && tile.low.y <= p.y && p.y <= tile.high.y)) return false;
    for (std::size_t i = 0; i < tile.found.size(); ++i)
        if (covers(tile.found[i], p)) return true;
    return false;
}

} // namespace

bool TerrainAnswer::covers(const glm::dvec2& place) const {
    const glm::dvec3 local(place - glm::dvec2(origin), 0.0);
    return std::any_of(tiles.begin(), tiles.end(), [&](const auto& tile) { return gnomon::covers(*tile, local); });
}

/// That of these casters; else one whose casters are gone, or that was this view's: it takes little to follow. Null if
/// there is none.
TerrainShadowCache::Town* TerrainShadowCache::findTown(const ShadowCasterGroup& group, const CasterDrawables& casters,
                                                       const void* stage, bool asBoxes) {
    const auto find = [&](auto isWanted) {
        const auto* known = _towns.find([&](const auto& town) {
            return town->group == &group && town->casters.asBoxes() == asBoxes && isWanted(*town);
        });
        return known ? known->get() : nullptr;
    };
    if (Town* town = find([&](const Town& known) { return known.casters.are(casters); })) return town;
    if (Town* town = find([&](const Town& known) { return known.stage == stage; })) return town;
    return find([&](const Town& known) { return known.casters.areRetired(); });
}

TerrainShadowCache::Town& TerrainShadowCache::townOf(const ShadowCasterGroup& group, const CasterDrawables& casters,
                                                     const void* stage, const TerrainPlace& place, bool asBoxes) {
    Town* known = findTown(group, casters, stage, asBoxes);
    if (!known) {
        _towns.dropOldestBeyond(mostTowns - 1); // before adding, for all would be in memory
        known = _towns.add(std::unique_ptr<Town>(new Town{&group, stage, nullptr, CasterTiles(asBoxes), {}})).get();
    }
    Town& town = *known;
    town.stage = stage;
    const osg::ref_ptr<const GroundRevision> drawn = place.drawn(town.drawn);
    if (drawn != town.drawn)
        for (auto& [number, tiles] : town.lights) tiles.groundChanged();
    town.drawn = drawn;
    town.casters.take(casters, drawn->drawables);
    return town;
}

TerrainFrame TerrainShadowCache::frame(const ViewFrame& view, const CasterDrawables& casters, const TerrainPlace& place,
                                       int number, const glm::dvec4& light, const TerrainSettings& settings) {
    TerrainFrame frame;
    runLocked(_mutex, [&] {
        Town& town = townOf(*view.group, casters, view.stage, place, settings.asBoxes);
        TileUpdates& tiles = town.lights[number];
        const TileVisibility seen(view, town.casters.origin());
        const TileGround ground = groundOf(*town.drawn);
        const unsigned before = tiles.found();
        tiles.update(town.casters, ground, light, settings, seen, secondsAFrame);
        _found += tiles.found() - before;
        frame = {tiles.shadows(), tiles.bitmapsIn(seen, ground), tiles.causes(), town.casters.origin(),
                 isFromAbove(view, ground)};
        addLimits(view, town, tiles, frame.causes);
    });
    return frame;
}

/// What is not drawn or lies elsewhere although all shadows are found. Casters count wherever they are: what the terrain
/// throws on itself may be in view where their shadows are not.
void TerrainShadowCache::addLimits(const ViewFrame& view, const Town& town, const TileUpdates& tiles,
                                   std::vector<std::string>& causes) {
    const auto holdsAny = [](const CasterTiles::Tile& tile) { return tile.size() > 0; };
    if (std::none_of(town.casters.tiles().begin(), town.casters.tiles().end(), holdsAny)) return;
    if (tiles.groundShadowsItself())
        causes.push_back(
            "the terrain is turned away from the light in places, and what it throws on itself is not drawn. Use "
            "map, volume or traced, or raise the light.");
    const auto isCoarse = [&](const osgUtil::RenderLeaf* leaf) {
        return town.drawn->coarse.count(leaf->getDrawable()) > 0;
    };
    if (!town.drawn->coarse.empty() && std::any_of(view.seen.begin(), view.seen.end(), isCoarse))
        causes.push_back(
            "a coarser level of detail of the terrain is drawn than its shadows are found on, so they may lie "
            "beside their places. Switch levels farther away, or use map, volume or traced.");
}

osg::ref_ptr<const TerrainAnswer> TerrainShadowCache::answer(const ShadowCasterGroup& group,
                                                             const CasterDrawables& casters, const TerrainPlace& place,
                                                             const glm::dvec4& light, const TerrainSettings& settings) {
    osg::ref_ptr<TerrainAnswer> answer = new TerrainAnswer;
    runLocked(_mutex, [&] {
        const Town& town = townOf(group, casters, nullptr, place, settings.asBoxes);
        answer->drawn = town.drawn;
        answer->origin = town.casters.origin();
        const auto& tiles = town.casters.tiles();
        answer->tiles.resize(tiles.size());
        tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
            const osg::ref_ptr<TileShadows> shadows = new TileShadows;
            findShadows(groundOf(*town.drawn), tiles[i], light, settings, answer->origin, *shadows);
            answer->tiles[i] = shadows;
        });
    });
    return answer;
}

unsigned TerrainShadowCache::found() const {
    Lock lock(_mutex);
    return _found;
}

void TerrainShadowCache::letGo() {
    Lock lock(_mutex);
    _towns.dropIf([](const auto& town) { return town->casters.areRetired(); });
}

void TerrainShadowCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    for (const auto& town : _towns)
        for (auto& [number, tiles] : town->lights) tiles.resizeGLObjectBuffers(maxSize);
}

void TerrainShadowCache::releaseGLObjects(osg::State* state) const {
    Lock lock(_mutex);
    for (const auto& town : _towns)
        for (const auto& [number, tiles] : town->lights) tiles.releaseGLObjects(state);
}

} // namespace gnomon
