// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/silhouette/ShadowVolumes.h>

#include <array>
#include <glm/mat4x4.hpp>
#include <optional>

namespace gnomon {

/// The rectangle at which all lines of sight of a view begin.
struct NearPlane {
    /// @param clipFromMesh  can be inverted.
    explicit NearPlane(const glm::dmat4& clipFromMesh);

    std::array<glm::dvec3, 4> corners; ///< in the mesh's frame.
    glm::dvec3 low, high;              ///< their bounds.
};

/// How many volumes of a part hold the near plane, all of it; nullopt if that is not certain, or not the same everywhere.
///
/// Lines of sight that begin outside all volumes, or in a known number of them, enter and leave volumes through their sides
/// alone (z-pass). For others, the volumes must be closed and are counted from behind (z-fail).
///
/// Cost  a look at the part's bounds; for one about the near plane, at its triangles and its outline.
std::optional<int> volumesHolding(const NearPlane& near, const SilhouetteMesh& mesh, const ShadowVolumes& volumes,
                                  std::size_t index);

} // namespace gnomon
