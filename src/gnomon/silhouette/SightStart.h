// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/silhouette/ShadowVolumes.h>

#include <glm/mat4x4.hpp>
#include <optional>

namespace gnomon {

/// Where the lines of sight of a view begin, and what is cut off before its near plane.
struct SightStart {
    /// @param clipFromMesh  can be inverted.
    /// @param low,high      bounds of the mesh: the eye of an orthographic view is taken to be far beyond them.
    SightStart(const glm::dmat4& clipFromMesh, const glm::dvec3& low, const glm::dvec3& high);

    glm::dvec4 towardsEye;           ///< homogeneous, see eyeIn().
    glm::dvec3 eye;                  ///< in the mesh's frame.
    std::vector<glm::dvec3> cutAway; ///< corners of what is before the near plane.
};

/// How many volumes of a part the eye is in; nullopt if that is not certain, or does not suffice.
///
/// Lines of sight that begin outside all volumes, or in a known number of them, enter and leave volumes through their sides
/// alone (z-pass, with depths clamped at the near plane). That holds if no caster is cut away before the near plane, and no
/// end is seen from below. Else the volumes must be closed, and are counted from behind (z-fail).
///
/// @param mayBeCut  something of the part's bounds is before the near plane.
///
/// Cost  a look at the part's bounds; of one between the light and the eye, or about the near plane, at its triangles.
std::optional<int> volumesHolding(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes,
                                  std::size_t index, bool mayBeCut);

/// Whether a surface of a part that casts can be seen from behind: the eye is on one side of it, the light on the other.
/// Never of a closed part, unless the eye or a lamp may be inside.
/// @param mayBeCut  see volumesHolding().
bool mayShowBack(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index,
                 bool mayBeCut);

} // namespace gnomon
