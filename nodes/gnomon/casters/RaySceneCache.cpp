// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>
#include <gnomon/casters/RaySceneCache.h>

#include <OpenThreads/ScopedLock>
#include <tbb/task_arena.h>

#include <vector>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// Isolated: a thread that waits for others must not take up work of the caller's, which might ask for a tree in turn.
std::shared_ptr<const RayScene> build(const CasterMesh& mesh, const std::string& name) {
    ProgressLine progress("gnomon: " + name + " builds a tree of " + std::to_string(mesh.triangles->size() / 3) +
                          " triangles");
    return tbb::this_task_arena::isolate([&] {
        return std::make_shared<const RayScene>(soupOf(mesh), [&progress](double share) { progress.show(share); });
    });
}

struct Found {
    std::shared_ptr<const RayScene> scene;
    bool built;
};

/// Of all meshes.
OpenThreads::Mutex& treeMutex() {
    static OpenThreads::Mutex mutex;
    return mutex;
}

/// The trees that are there.
std::vector<std::shared_ptr<const RayScene>> builtOf(const std::vector<PlacedMesh>& meshes) {
    Lock lock(treeMutex());
    std::vector<std::shared_ptr<const RayScene>> built;
    for (const PlacedMesh& placed : meshes) built.push_back(placed.mesh->tree.lock());
    return built;
}

/// One at a time, for all who ask.
Found findOrBuild(const CasterMesh& mesh, const std::string& name) {
    Lock lock(treeMutex());
    if (std::shared_ptr<const RayScene> scene = mesh.tree.lock()) return {scene, false};
    const std::shared_ptr<const RayScene> scene = build(mesh, name);
    mesh.tree = scene;
    return {scene, true};
}

} // namespace

std::shared_ptr<const RayScene> RaySceneCache::of(const Casters& casters, const std::string& name) {
    Lock lock(_mutex);
    if (const Entry* known = _entries.find([&](const Entry& entry) { return entry.casters == casters.retired(); }))
        return known->scene;
    const std::vector<PlacedMesh> meshes = casters.layers().meshes();
    const auto there = builtOf(meshes); // held, for others may go before more are built
    _entries.dropIf([](const Entry& entry) { return entry.casters->load(); });
    _entries.dropOldestBeyond(most - 1);
    std::vector<PlacedRayScene> parts;
    bool anyBuilt = false;
    for (const PlacedMesh& placed : meshes) {
        const Found found = findOrBuild(*placed.mesh, name);
        anyBuilt = anyBuilt || found.built;
        parts.push_back({found.scene, placed.sceneFromMesh});
    }
    _builds += anyBuilt;
    const bool isOne = parts.size() == 1 && parts.front().outerFromInner == glm::dmat4(1.0);
    return _entries.add({casters.retired(), isOne ? parts.front().scene : std::make_shared<const RayScene>(parts)})
        .scene;
}

unsigned RaySceneCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

} // namespace gnomon
