// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>
#include <gnomon/casters/RaySceneCache.h>

#include <OpenThreads/ScopedLock>
#include <tbb/task_arena.h>

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

/// One at a time, for all who ask.
Found findOrBuild(const CasterMesh& mesh, const std::string& name) {
    static OpenThreads::Mutex mutex;
    Lock lock(mutex);
    if (std::shared_ptr<const RayScene> scene = mesh.tree.lock()) return {scene, false};
    const std::shared_ptr<const RayScene> scene = build(mesh, name);
    mesh.tree = scene;
    return {scene, true};
}

} // namespace

std::shared_ptr<const RayScene> RaySceneCache::of(const CasterMesh& mesh, const std::string& name) {
    Lock lock(_mutex);
    if (const Entry* known = _entries.find([&](const Entry& entry) { return entry.mesh == &mesh; }))
        return known->scene;
    _entries.dropIf([](const Entry& entry) { return entry.mesh->isRetired(); });
    _entries.dropOldestBeyond(most - 1); // before building, for all would be in memory
    const Found found = findOrBuild(mesh, name);
    _builds += found.built;
    return _entries.add({&mesh, found.scene}).scene;
}

unsigned RaySceneCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

} // namespace gnomon
