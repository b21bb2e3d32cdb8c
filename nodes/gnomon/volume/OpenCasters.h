// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/vec3.hpp>
#include <osg/observer_ptr>

#include <cstddef>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// What volumes that were counted came to, beside what bounds and numbers of triangles had made of them.
struct CountedVolumes {
    double sides = 1.0, pixels = 1.0; ///< factors.
    double caps = 0.0;                ///< a triangle.
};

/// A mesh of casters, drawable by drawable. Those that are open bound no solid by themselves.
struct DrawnCasters {
    struct Drawable {
        glm::vec3 low, high; ///< bounds.
        std::size_t triangles;
    };
    std::vector<Drawable> closed, open;
    std::shared_ptr<const SilhouetteMesh> openEdges; ///< of the open ones together; null: there are none, or too many.
    std::optional<CountedVolumes> counted;           ///< of the open ones, for some light and view.

    std::size_t openTriangles() const;
};

/// The same of all meshes that were asked for lately. Found once a mesh.
///
/// Cost
/// - A pass over the triangles; of open drawables their edges, see SilhouetteMesh.
/// Threads
/// - One at a time.
class OpenCasters {
public:
    static constexpr std::size_t mostTriangles = 150000; ///< open ones whose volumes are counted at once: 0.2 s.

    /// A new answer is about to be looked for: meshes that are gone, or were asked for 16 answers ago, are let go.
    void startRound();
    /// It holds until the next round.
    DrawnCasters& of(const CasterMesh& mesh);

private:
    struct Entry {
        osg::observer_ptr<const CasterMesh> mesh; // null if another has its address now
        DrawnCasters drawn;
        unsigned used = 0; ///< in which round.
    };

    std::unordered_map<const CasterMesh*, Entry> _entries;
    unsigned _round = 0;
};

} // namespace gnomon
