// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ViewFrame.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
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

/// What the volumes of all casters behind a light would come to in a view.
struct VolumeForecast {
    double sides = 0.0; ///< of the volumes that can be seen; each two triangles.
    double caps = 0.0;  ///< triangles of open casters, drawn where their backs may be seen, or to close volumes.
    /// That these cover, each for itself. Narrow ones count as wide as OpenGL's rasteriser takes them.
    double pixels = 0.0;
};

/// Of closed casters it is found from their bounds and numbers of triangles alone: no edge is looked at.
///
/// A mesh of n triangles has some n^0.8 edges on its outline, and flat ones fewer (M. McGuire, "Observations on Silhouette
/// Sizes", Journal of Graphics Tools, 2004). So an estimate may be off by a factor of 2 and more.
///
/// An open caster has all its free edges on its outline, be it as small as a leaf. So its volumes are found once, as they are
/// drawn. Later answers take the estimate times what that had made of it. A mesh of more than 150,000 open triangles, and one for
/// which none of these are left in the first answer, are taken for closed.
///
/// @param light  group frame; w is 0 and the direction has length 1, or w is 1.
/// @param known  the open casters of earlier answers.
///
/// Cost  a look at each drawable's bounds; once a mesh, volumes of what is open.
VolumeForecast forecastVolumes(const ViewFrame& view, const CasterLayers& casters, const glm::dvec4& light,
                               OpenCasters& known);

} // namespace gnomon
