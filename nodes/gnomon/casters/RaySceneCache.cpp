// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>
#include <gnomon/casters/RaySceneCache.h>

#include <OpenThreads/ScopedLock>
#include <algorithm>
#include <iterator>
#include <map>
#include <tbb/task_arena.h>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// A tree and the casters that it is of: while the one lives, nothing else can have the other's address.
struct Tree {
    Tree(const CasterMesh& mesh, const RayScene::ProgressLine& progress)
        : casters(&mesh), scene(soupOf(mesh), progress) {}

    osg::ref_ptr<const CasterMesh> casters;
    RayScene scene;
};

/// All that are in use, whoever asked for them first.
struct TreesInUse {
    OpenThreads::Mutex mutex;
    std::map<const CasterMesh*, std::weak_ptr<Tree>> trees;
};

TreesInUse& treesInUse() {
    static TreesInUse all;
    return all;
}

/// Isolated: a thread that waits for others must not take up work of the caller's, which might ask for a tree in turn.
std::shared_ptr<Tree> build(const CasterMesh& mesh, const std::string& name) {
    ProgressLine progress("gnomon: " + name + " builds a tree of " + std::to_string(mesh.triangles->size() / 3) +
                          " triangles");
    return tbb::this_task_arena::isolate(
        [&] { return std::make_shared<Tree>(mesh, [&progress](double share) { progress.show(share); }); });
}

struct Found {
    std::shared_ptr<const RayScene> scene;
    bool built;
};

Found findOrBuild(const CasterMesh& mesh, const std::string& name) {
    TreesInUse& all = treesInUse();
    Lock lock(all.mutex);
    std::shared_ptr<Tree> tree = all.trees[&mesh].lock();
    const bool built = !tree;
    if (built) {
        for (auto entry = all.trees.begin(); entry != all.trees.end();)
            entry = entry->second.expired() ? all.trees.erase(entry) : std::next(entry);
        tree = build(mesh, name);
        all.trees[&mesh] = tree;
    }
    const RayScene* scene = &tree->scene;
    return {std::shared_ptr<const RayScene>(std::move(tree), scene), built};
}

} // namespace

std::shared_ptr<const RayScene> RaySceneCache::of(const CasterMesh& mesh, const std::string& name) {
    Lock lock(_mutex);
    const auto known =
        std::find_if(_entries.begin(), _entries.end(), [&](const Entry& entry) { return entry.mesh == &mesh; });
    if (known != _entries.end()) {
        std::rotate(known, known + 1, _entries.end());
        return _entries.back().scene;
    }
    if (_entries.size() > 1) _entries.erase(_entries.begin()); // before building, for both would be in memory
    const Found found = findOrBuild(mesh, name);
    _entries.push_back({&mesh, found.scene});
    _builds += found.built;
    return _entries.back().scene;
}

unsigned RaySceneCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

} // namespace gnomon
