// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>
#include <gnomon/base/RecentCache.h>
#include <gnomon/casters/Casters.h>

#include <OpenThreads/Mutex>
#include <glm/vec3.hpp>

#include <memory>

namespace gnomon {

/// A mesh as rays take it, in its own frame, while the mesh lives. Where a texture tells what is clear of a caster, rays pass; a
/// scene that is made of it holds the mesh then.
TriangleSoup soupOf(const CasterMesh& mesh);

/// The trees over casters that a node or a query casts rays at: one a mesh, kept while it is used, and shared by all
/// nodes and queries that ask for the same mesh. A revision of several meshes has a tree of two levels over them.
///
/// Threads any number: those who ask for other meshes do not wait while a tree is built.
class RaySceneCache {
public:
    /// @param name  of whom it is, for the line of progress.
    /// @throws std::runtime_error, see RayScene.
    std::shared_ptr<const RayScene> of(const Casters& casters, const std::string& name);
    /// How often a tree over triangles was not there yet.
    unsigned builds() const;

private:
    struct Entry {
        Casters::Retired casters;
        std::shared_ptr<const RayScene> scene;
    };

    std::shared_ptr<const RayScene> find(const Casters& casters);
    void dropOld();

    /// A node under two groups builds neither again, nor do views of different levels of detail.
    static constexpr std::size_t most = 4;

    mutable OpenThreads::Mutex _mutex;
    RecentCache<Entry> _entries;
    unsigned _builds = 0;
};

} // namespace gnomon
