// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/RaySceneCache.h>

#include <OpenThreads/ScopedLock>

#include <vector>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// @param wasBuilt  set if it was not there yet.
std::shared_ptr<const RayScene> treeOf(const CasterMesh& mesh, const std::string& name, bool& wasBuilt) {
    return mesh.lent<RayScene>([&] {
        wasBuilt = true;
        ProgressLine progress("gnomon: " + name + " builds a tree of " + std::to_string(mesh.triangles->size() / 3) +
                              " triangles");
        return std::make_shared<const RayScene>(soupOf(mesh), [&progress](double share) { progress.show(share); });
    });
}

} // namespace

std::shared_ptr<const RayScene> RaySceneCache::of(const Casters& casters, const std::string& name) {
    if (const auto known = find(casters)) return known;
    const std::vector<PlacedMesh> meshes = casters.layers().meshes();
    std::vector<std::shared_ptr<const RayScene>> there; // held, for others may go before more are built
    for (const PlacedMesh& placed : meshes) there.push_back(placed.mesh->known<RayScene>());
    dropOld();
    std::vector<PlacedRayScene> parts;
    bool anyBuilt = false;
    for (const PlacedMesh& placed : meshes)
        parts.push_back({treeOf(*placed.mesh, name, anyBuilt), placed.sceneFromMesh});
    const bool isOne = parts.size() == 1 && parts.front().outerFromInner == glm::dmat4(1.0);
    const auto scene = isOne ? parts.front().scene : std::make_shared<const RayScene>(parts);
    dropOld(); // others may have added theirs
    Lock lock(_mutex);
    _builds += anyBuilt;
    return _entries.add({casters.retired(), scene}).scene;
}

std::shared_ptr<const RayScene> RaySceneCache::find(const Casters& casters) {
    Lock lock(_mutex);
    const Entry* known = _entries.find([&](const Entry& entry) { return entry.casters == casters.retired(); });
    return known ? known->scene : nullptr;
}

void RaySceneCache::dropOld() {
    Lock lock(_mutex);
    _entries.dropIf([](const Entry& entry) { return entry.casters->load(); });
    _entries.dropOldestBeyond(most - 1);
}

unsigned RaySceneCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

} // namespace gnomon
