// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/volume/VolumeCasters.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace gnomon {
namespace {

/// A bit each; none of what hides all.
std::uint8_t kindOf(Hiding hiding) { return static_cast<std::uint8_t>(hiding); }

/// What its drawables hide, a bit each, for each triangle; empty if that is all the same.
std::vector<std::uint8_t> kindsOf(const CasterMesh& mesh) {
    const auto hidesAll = [](const auto& drawn) { return drawn.hiding == Hiding::Both; };
    std::vector<std::uint8_t> kinds;
    if (std::all_of(mesh.drawn.begin(), mesh.drawn.end(), hidesAll)) return kinds;
    kinds.resize(mesh.triangles->size() / 3);
    for (std::size_t i = 0; i < mesh.drawn.size(); ++i) {
        const std::size_t end = i + 1 < mesh.drawn.size() ? mesh.drawn[i + 1].first : mesh.triangles->size();
        std::fill(kinds.begin() + std::ptrdiff_t(mesh.drawn[i].first / 3), kinds.begin() + std::ptrdiff_t(end / 3),
                  kindOf(mesh.drawn[i].hiding));
    }
    return kinds;
}

std::shared_ptr<const SilhouetteMesh> edgesOf(const CasterMesh& mesh) {
    if (mesh.empty()) return std::make_shared<const SilhouetteMesh>();
    const std::vector<std::uint8_t> kinds = kindsOf(mesh);
    return std::make_shared<const SilhouetteMesh>(positionsOf(mesh), mesh.vertices->size(), &mesh.triangles->front(),
                                                  mesh.triangles->size(), kinds.empty() ? nullptr : kinds.data());
}

} // namespace

bool VolumeCaster::hides(const SilhouetteMesh::Part& part, const glm::dvec3& eye) const {
    const unsigned kinds = part.kinds | kindOf(hiding);
    if (kinds & kindOf(Hiding::Neither)) return false;
    return !(kinds & kindOf(Hiding::Fronts)) || (part.closed && !part.inward && !part.boundsHold(eye));
}

std::vector<VolumeCaster> VolumeCasters::of(const CasterLayers& casters, unsigned round) {
    std::vector<VolumeCaster> all;
    for (const auto& layer : {casters.still, casters.moving})
        for (const PlacedMesh& placed : layer->meshes) {
            Entry& entry = _entries[placed.mesh.get()];
            if (!entry.mesh) entry = {placed.mesh, edgesOf(*placed.mesh), 0};
            entry.used = round;
            all.push_back({entry.edges, placed.sceneFromMesh, placed.hiding});
        }
    for (auto entry = _entries.begin(); entry != _entries.end();)
        entry = round - entry->second.used > longUnused ? _entries.erase(entry) : std::next(entry);
    return all;
}

} // namespace gnomon
