// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/terrain/TerrainShadowCache.h>

#include <OpenThreads/ScopedLock>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

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

constexpr std::size_t mostTowns = 4; // groups above one node, and views of different levels of detail
// Of a shadow's diameter, beyond the ground under it: a coarser level of detail, or what is pushed back, may lie that far off.
constexpr double marginOfLevels = 0.5;
constexpr double marginOfGround = 0.05; // for what a depth buffer and floats leave of heights, and a sun that turns

/// The eye is over ground without holes: to see some of it from below, a line of sight would have to go through it first.
bool isFromAbove(const ViewFrame& view, const HullGround& ground) {
    const glm::dvec4 eye = eyeIn(toGlm(view.eyeFromGroup * view.projection));
    if (ground.all.holes || !(eye.w >= 0.0)) return false;
    if (eye.w == 0.0) return eye.z > 0.0;
    const glm::dvec3 place = glm::dvec3(eye) / eye.w;
    const auto height = ground.ground.height(place.x, place.y);
    return place.z > height.value_or(ground.all.high);
}

} // namespace

bool TerrainAnswer::holds(const glm::dvec3& place) const {
    return std::any_of(tiles.begin(), tiles.end(), [&](const HullSolids& tile) { return tile.around(place) != 0; });
}

/// That of these casters; else one whose casters are gone, or that was this view's: it takes little to follow. Null if
/// there is none.
TerrainShadowCache::Town* TerrainShadowCache::findTown(const ShadowCasterGroup& group, const Casters& casters,
                                                       const ViewKey& view, bool asBoxes) {
    const auto find = [&](auto isWanted) {
        const auto* known = _towns.find([&](const auto& town) {
            return town->group == &group && town->casters.asBoxes() == asBoxes && isWanted(*town);
        });
        return known ? known->get() : nullptr;
    };
    if (Town* town = find([&](const Town& known) { return known.casters.are(casters); })) return town;
    if (Town* town = find([&](const Town& known) { return known.view == view; })) return town;
    return find([&](const Town& known) { return known.casters.areRetired(); });
}

TerrainShadowCache::Town& TerrainShadowCache::townOf(const Asker& asker, const Casters& casters,
                                                     const Selection& terrain) {
    Town* known = findTown(asker.group, casters, asker.view, asker.asBoxes);
    if (!known) {
        _towns.dropOldestBeyond(mostTowns - 1); // before adding, for all would be in memory
        known = _towns.add(std::make_unique<Town>(asker.group, asker.asBoxes)).get();
    }
    Town& town = *known;
    town.view = asker.view;
    const osg::ref_ptr<const GroundRevision> drawn = groundRevision(asker.group, terrain, town.drawn);
    const double margin = drawn->hasLevels || asker.isLoose ? marginOfLevels : marginOfGround;
    if (drawn != town.drawn || margin != town.ground->margin) {
        for (auto& [number, tiles] : town.lights) tiles.groundChanged();
        town.ground = std::make_unique<HullGround>(*drawn->ground, margin);
    }
    town.drawn = drawn;
    town.casters.take(casters, drawn->drawables);
    return town;
}

TerrainFrame TerrainShadowCache::frame(const ViewFrame& view, const Casters& casters, const Selection& terrain,
                                       const GroundLight& light, bool asBoxes) {
    TerrainFrame frame;
    runLocked(_mutex, [&] {
        const bool isLoose = view.pushedBack.x() > 0.0 || view.pushedBack.y() > 0.0;
        Town& town = townOf({*view.group, view.key, asBoxes, isLoose}, casters, terrain);
        HullTiles& tiles = town.lights[light.number];
        const unsigned before = tiles.found();
        tiles.update(town.casters, *town.ground, light.place, TileView(view, town.casters.origin()));
        _found += tiles.found() - before;
        frame = {tiles.shadows(), {}, town.casters.origin(), isFromAbove(view, *town.ground)};
        if (town.casters.size() > 0)
            frame.causes = tiles.causes();
        else
            frame.causes = {"every caster is part of the receiver, so nothing casts on it. Name the terrain alone with "
                            "setReceiver() (receiver=NAME)."};
    });
    return frame;
}

osg::ref_ptr<const TerrainAnswer> TerrainShadowCache::answer(const ShadowCasterGroup& group, const Casters& casters,
                                                             const Selection& terrain, const glm::dvec4& light,
                                                             bool asBoxes) {
    osg::ref_ptr<TerrainAnswer> answer = new TerrainAnswer;
    runLocked(_mutex, [&] {
        const Town& town = townOf({group, {}, asBoxes, false}, casters, terrain);
        answer->drawn = town.drawn;
        answer->tiles.resize(town.casters.tiles().size());
        tbb::parallel_for(std::size_t{0}, answer->tiles.size(),
                          [&](std::size_t i) { answer->tiles[i] = shadowsOf(i, town.casters, *town.ground, light); });
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
