// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <optional>

namespace gnomon {

/// In clip space the eight corners of a box, and where the volume behind it ends after each of them.
using VolumeHull = std::array<glm::dvec4, 16>;

/// @param end  see nearestEnd(). @param light  w is 0 and the direction has length 1, or w is 1.
VolumeHull volumeHull(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& end, const glm::dvec4& light,
                      const glm::dmat4& clipFromBox);

/// True if the box itself may be seen.
bool isInSight(const VolumeHull& hull);

/// As screenBounds(), which is slower.
std::optional<ScreenRect> boundsOf(const VolumeHull& hull);

} // namespace gnomon
