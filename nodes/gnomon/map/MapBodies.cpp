// SPDX-License-Identifier: MIT
#include <gnomon/map/MapBodies.h>

#include <iterator>

namespace gnomon {
namespace {

constexpr std::size_t mostSearched = 30000; // triangles a picture: ten milliseconds

bool isDrawn(const CullableFaces* faces) { return faces && faces->referenceCount() > 1; }

} // namespace

osg::ref_ptr<const CullableFaces> MapBodies::of(const CasterMesh& mesh, bool moving) {
    Entry& entry = _known[&mesh];
    const bool again = entry.whole || entry.solids;
    if (moving && again && (entry.solids || _searched < mostSearched)) return solidsOf(mesh);
    entry.mesh = &mesh;
    if (!entry.whole) entry.whole = new CullableFaces(mesh, mesh.triangles, false);
    return entry.whole;
}

osg::ref_ptr<const CullableFaces> MapBodies::solidsOf(const CasterMesh& mesh) {
    Entry& entry = _known[&mesh];
    entry.mesh = &mesh;
    if (!entry.solids) {
        entry.solids = new CullableFaces(mesh, mesh.triangles, true);
        _searched += mesh.triangles->size() / 3;
    }
    return entry.solids;
}

/// Pictures hold what is drawn.
void MapBodies::prune() {
    for (auto entry = _known.begin(); entry != _known.end();) {
        const bool drawn = isDrawn(entry->second.whole) || isDrawn(entry->second.solids);
        entry = drawn ? std::next(entry) : _known.erase(entry);
    }
}

void MapBodies::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& entry : _known)
        for (const auto& faces : {entry.second.whole, entry.second.solids})
            if (faces) faces->resizeGLObjectBuffers(maxSize);
}

void MapBodies::releaseGLObjects(osg::State* state) const {
    for (const auto& entry : _known)
        for (const auto& faces : {entry.second.whole, entry.second.solids})
            if (faces) faces->releaseGLObjects(state);
}

} // namespace gnomon
