// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMesh.h>
#include <gnomon/RayScene.h>

#include <OpenThreads/Mutex>

#include <memory>
#include <vector>

namespace gnomon {

/// The trees over casters that a node or a query casts rays at: one a revision, kept while it is used, and one for all
/// nodes and queries that ask for the same casters.
///
/// Threads any number.
class TracedCasters {
public:
    /// @param name  of whom it is, for the line of progress.
    /// @throws std::runtime_error, see RayScene.
    std::shared_ptr<const RayScene> of(const CasterMesh& mesh, const std::string& name);
    /// How often none was there yet.
    unsigned builds() const;

private:
    struct Entry {
        osg::ref_ptr<const CasterMesh> mesh; // held, so that its address cannot be taken by the next revision
        std::shared_ptr<const RayScene> scene;
    };

    mutable OpenThreads::Mutex _mutex;
    std::vector<Entry> _entries; ///< used last at the end; two, so that a node under two groups builds neither again.
    unsigned _builds = 0;
};

} // namespace gnomon
