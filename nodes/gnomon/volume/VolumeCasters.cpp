// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/volume/VolumeCasters.h>

#include <iterator>

namespace gnomon {
namespace {

std::shared_ptr<const SilhouetteMesh> edgesOf(const CasterMesh& mesh) {
    if (mesh.empty()) return std::make_shared<const SilhouetteMesh>();
    return std::make_shared<const SilhouetteMesh>(positionsOf(mesh), mesh.vertices->size(), &mesh.triangles->front(),
                                                  mesh.triangles->size());
}

} // namespace

std::vector<VolumeCaster> VolumeCasters::of(const CasterLayers& casters, unsigned round) {
    std::vector<VolumeCaster> all;
    for (const auto& layer : {casters.still, casters.moving})
        for (const PlacedMesh& placed : layer->meshes) {
            Entry& entry = _entries[placed.mesh.get()];
            if (!entry.mesh) entry = {placed.mesh, edgesOf(*placed.mesh), 0};
            entry.used = round;
            all.push_back({entry.edges, placed.sceneFromMesh});
        }
    for (auto entry = _entries.begin(); entry != _entries.end();)
        entry = round - entry->second.used > longUnused ? _entries.erase(entry) : std::next(entry);
    return all;
}

} // namespace gnomon
