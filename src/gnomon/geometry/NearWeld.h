// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <vector>

namespace gnomon {

/// For each point the first that is no farther from it than `reach`; itself, if there is none before it.
///
/// Cost   a look-up in a hash table a point.
std::vector<unsigned> nearlyTheSame(const std::vector<glm::dvec3>& points, double reach);

} // namespace gnomon
