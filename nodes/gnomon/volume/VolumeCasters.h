// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/mat4x4.hpp>

#include <memory>
#include <vector>

namespace gnomon {

class FrameCasters;

/// A mesh that casts, with its edges, where it stands in the scene.
struct VolumeCaster {
    std::shared_ptr<const SilhouetteMesh> mesh; ///< in its own frame.
    glm::dmat4 sceneFromMesh{1.0};              ///< can be inverted.
};

/// The edges of casters, found once a mesh.
class VolumeCasters {
public:
    /// All that cast.
    std::vector<VolumeCaster> of(const FrameCasters& casters);

private:
    struct Entry {
        osg::ref_ptr<const CasterMesh> mesh; // held, so that its address cannot be taken by the next revision
        std::shared_ptr<const SilhouetteMesh> edges;
    };
    static constexpr std::size_t most = 4; ///< as views of different levels of detail may ask for them.

    RecentCache<Entry> _entries;
};

} // namespace gnomon
