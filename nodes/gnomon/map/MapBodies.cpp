// SPDX-License-Identifier: MIT
#include <gnomon/map/MapBodies.h>

#include <iterator>

namespace gnomon {
namespace {

bool isDrawn(const CullableFaces* faces) { return faces && faces->referenceCount() > 1; }

} // namespace

osg::ref_ptr<const CullableFaces> MapBodies::of(const CasterMesh& mesh, bool again) {
    Entry& entry = _known[&mesh];
    entry.mesh = &mesh;
    osg::ref_ptr<const CullableFaces>& faces = again ? entry.solids : entry.whole;
    if (!faces) faces = new CullableFaces(mesh, mesh.triangles, again);
    return faces;
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
