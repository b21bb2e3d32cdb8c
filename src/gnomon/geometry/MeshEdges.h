// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
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

} // namespace gnomon
