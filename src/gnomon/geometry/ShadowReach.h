// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

/// A box along the axes.
struct AlignedBox {
    glm::dvec3 low, high;
};

/// True if some ray from a point of `surface` to the light meets `caster`. Exact for boxes, where they touch, too.
/// @param light  homogeneous: w = 0 is the direction towards a sun. w is not negative.
bool shadowReaches(const AlignedBox& caster, const AlignedBox& surface, const glm::dvec4& light);

} // namespace gnomon
