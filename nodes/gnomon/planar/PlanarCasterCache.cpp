// SPDX-License-Identifier: MIT
#include <gnomon/group/SceneFrame.h>
#include <gnomon/planar/PlanarCasterCache.h>

#include <OpenThreads/ScopedLock>

#include <iterator>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

/// Joined meshes by their triangles, bodies as wholes. What is under the plane may lie in it: that each triangle tells.
osg::ref_ptr<PlanarCasters> PlanarCasterCache::make(const CasterLayers& layers, const glm::dvec4& groupPlane,
                                                    bool under, unsigned frame) {
    std::vector<osg::ref_ptr<PlanarCasters>> before;
    for (const auto& entry : _entries)
        if (entry->isOf(groupPlane, under)) before.push_back(entry);
    const SceneFrame scene(layers.origin);
    std::size_t next = 0;
    return new PlanarCasters(
        layers, groupPlane, under,
        [&](const PlacedMesh& placed, const glm::dvec4& plane) -> osg::ref_ptr<const PlanarParts> {
            const std::size_t place = next++;
            if (placed.isBody && !under) {
                const osg::ref_ptr<const PlanarMesh> whole = wholeOf(*placed.mesh, frame);
                for (const auto& entry : before) {
                    const auto known = entry->plane == plane ? entry->at(place, placed) : nullptr;
                    if (known && known->whole == whole) return known; // it stands still while others move
                }
                return new PlanarParts(placed, plane, scene.point(placed.bounds._min), scene.point(placed.bounds._max),
                                       *whole);
            }
            osg::ref_ptr<const PlanarParts> known;
            for (const auto& entry : before)
                if (!known && entry->plane == plane) known = entry->find(placed);
            if (known && (known->knowsSolids || known->firstFrame == frame)) return known;
            return new PlanarParts(placed, plane, under, known.valid(), frame); // which stands still: the search pays
        });
}

osg::ref_ptr<const PlanarMesh> PlanarCasterCache::wholeOf(const CasterMesh& mesh, unsigned frame) {
    osg::ref_ptr<const PlanarMesh>& known = _wholes[&mesh];
    if (!known || (!known->knowsSolids && known->firstFrame != frame))
        known = new PlanarMesh(mesh, known.valid(), frame);
    return known;
}

osg::ref_ptr<PlanarCasters> PlanarCasterCache::of(const CasterLayers& layers, const glm::dvec4& groupPlane, bool under,
                                                  unsigned frame, std::size_t most) {
    Lock lock(_mutex);
    osg::ref_ptr<PlanarCasters>* entry =
        _entries.find([&](const auto& known) { return known->madeFrom(layers, groupPlane, under); });
    if (entry && (*entry)->seeksSolids(frame)) *entry = make(layers, groupPlane, under, frame);
    if (!entry) {
        const osg::ref_ptr<PlanarCasters> made = make(layers, groupPlane, under, frame);
        _entries.dropIf([](const auto& known) { return known->isRetired(); });
        entry = &_entries.add(made);
    }
    const osg::ref_ptr<PlanarCasters> casters = *entry;
    _entries.dropOldestBeyond(most);
    for (auto whole = _wholes.begin(); whole != _wholes.end();)
        whole = whole->second->referenceCount() == 1 ? _wholes.erase(whole) : std::next(whole);
    return casters;
}

void PlanarCasterCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    for (const auto& casters : _entries) casters->resizeGLObjectBuffers(maxSize);
}

void PlanarCasterCache::releaseGLObjects(osg::State* state) const {
    Lock lock(_mutex);
    for (const auto& casters : _entries) casters->releaseGLObjects(state);
}

} // namespace gnomon
