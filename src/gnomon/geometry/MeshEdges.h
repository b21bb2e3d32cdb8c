// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon {

/// For each vertex the first vertex of exactly the same position (-0 and 0 are the same).
/// @param positions  `count` of them, none of them NaN.
std::vector<unsigned> weld(const glm::vec3* positions, std::size_t count);
std::vector<unsigned> weld(const glm::dvec3* positions, std::size_t count);

/// An edge without its direction, and +1 or -1 for it; (lower vertex, higher vertex) in one word.
struct Edge {
    std::uint64_t ends;
    int direction;
};
Edge edge(unsigned from, unsigned to);

/// An edge that is passed more often from its lower vertex to its higher one than back, by `times`; below 0 less often.
struct OpenEdge {
    unsigned low, high;
    int times;
};

/// @param corners  welded vertices, three a triangle.
std::vector<OpenEdge> openEdges(const std::vector<unsigned>& corners);

/// For each point the first that is no farther from it than `reach`; itself, if there is none before it.
///
/// Cost   a look-up in a hash table a point.
std::vector<unsigned> nearlyTheSame(const std::vector<glm::dvec3>& points, double reach);

/// Closes seams whose two sides differ by rounding alone, as sin(0) and sin(2 pi) do.
/// @param ends       those of `vertexCount` vertices, welded, at which open edges end; each once.
/// @return for each vertex the one that stands for it; empty if there is no seam.
std::vector<unsigned> withoutSeams(const std::vector<unsigned>& ends, const glm::vec3* positions,
                                   std::size_t vertexCount);

} // namespace gnomon
