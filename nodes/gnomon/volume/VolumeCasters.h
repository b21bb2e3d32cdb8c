// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/mat4x4.hpp>

#include <memory>
#include <unordered_map>
#include <vector>

namespace gnomon {

struct CasterLayers;

/// A mesh that casts, with its edges, where it stands in the scene.
struct VolumeCaster {
    std::shared_ptr<const SilhouetteMesh> mesh; ///< in its own frame.
    glm::dmat4 sceneFromMesh{1.0};              ///< can be inverted.
    Hiding hiding = Hiding::Both;               ///< of all; parts of what is joined have theirs among their kinds.

    /// True if nothing that is behind a part, as seen from the eye, is seen through it.
    bool hides(const SilhouetteMesh::Part& part, const glm::dvec3& eye) const;
};

/// The edges of casters, found once a mesh, wherever it stands.
class VolumeCasters {
public:
    /// All that cast. Those of casters that were last asked for 64 rounds ago are let go.
    /// @param round  a frame, as views count them; never fewer than before.
    std::vector<VolumeCaster> of(const CasterLayers& casters, unsigned round);

private:
    struct Entry {
        osg::ref_ptr<const CasterMesh> mesh; // held, so that its address cannot be taken by another
        std::shared_ptr<const SilhouetteMesh> edges;
        unsigned used = 0; ///< in which round.
    };
    static constexpr unsigned longUnused = 64; ///< rounds.

    std::unordered_map<const CasterMesh*, Entry> _entries;
};

} // namespace gnomon
