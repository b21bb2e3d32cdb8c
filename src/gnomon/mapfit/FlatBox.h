// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace gnomon {

/// The axis along which a box is flat, as grounds are: in the scene its shortest side is an eighth of the next, or less.
/// Nullopt for other boxes.
std::optional<int> flatAxis(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox);

} // namespace gnomon
