// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace gnomon {

/// For each point the first that is no farther from it than `reach`; itself, if there is none before it.
///
/// Cost   a look-up in a hash table a point.
std::vector<unsigned> nearlyTheSame(const std::vector<glm::dvec3>& points, double reach);

/// Closes seams whose two sides differ by rounding alone, as sin(0) and sin(2 pi) do.
/// @param ends       those of `vertexCount` vertices, welded, at which open edges end; each once.
/// @return for each vertex the one that stands for it; empty if there is no seam.
std::vector<unsigned> withoutSeams(const std::vector<unsigned>& ends, const glm::vec3* positions, std::size_t vertexCount);

} // namespace gnomon
