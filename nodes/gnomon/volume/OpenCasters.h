// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// A mesh of casters, drawable by drawable. Those that are open bound no solid by themselves.
struct DrawnCasters {
    struct Drawable {
        glm::vec3 low, high; ///< bounds.
        std::size_t triangles;
    };
    std::vector<Drawable> closed, open;
    std::shared_ptr<const SilhouetteMesh> openEdges; ///< of the open ones together; null: there are none, or too many.
};

/// The same of all meshes that were asked for lately. Found once a mesh.
///
/// Cost
/// - A pass over the triangles; of open drawables their edges, see SilhouetteMesh.
/// Threads
/// - One at a time.
class OpenCasters {
public:
    /// A new answer is about to be looked for: meshes that were asked for 16 answers ago are let go.
    void startRound();
    /// It holds until the next round.
    const DrawnCasters& of(const CasterMesh& mesh);

private:
    struct Entry {
        osg::ref_ptr<const CasterMesh> mesh; // held, so that its address cannot be taken by another
        DrawnCasters drawn;
        unsigned used = 0; ///< in which round.
    };

    std::unordered_map<const CasterMesh*, Entry> _entries;
    unsigned _round = 0;
};

} // namespace gnomon
