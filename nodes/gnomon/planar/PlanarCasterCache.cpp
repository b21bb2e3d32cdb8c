// SPDX-License-Identifier: MIT
#include <gnomon/planar/PlanarCasterCache.h>

#include <OpenThreads/ScopedLock>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

osg::ref_ptr<PlanarCasters> PlanarCasterCache::of(const CasterMesh& mesh, const glm::dvec4& groupPlane, bool under,
                                                  unsigned frame, std::size_t most) {
    Lock lock(_mutex);
    const auto make = [&](bool findSolids) {
        osg::ref_ptr<PlanarCasters> made = new PlanarCasters(mesh, groupPlane, under, findSolids);
        made->firstFrame = frame;
        return made;
    };
    osg::ref_ptr<PlanarCasters>* entry =
        _entries.find([&](const auto& known) { return known->madeFrom(mesh, groupPlane, under); });
    if (!entry) _entries.dropIf([](const auto& known) { return known->isRetired(); });
    if (!entry)
        entry = &_entries.add(make(false));
    else if ((*entry)->firstFrame != frame && !(*entry)->knowsSolids())
        *entry = make(true); // the casters stand still: from now on the search for solids pays
    const osg::ref_ptr<PlanarCasters> casters = *entry;
    _entries.dropOldestBeyond(most);
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
