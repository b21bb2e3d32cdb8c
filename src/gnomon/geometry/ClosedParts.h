// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace gnomon {

/// Which triangles are connected, which bound a solid, and which vertices stand at the same place.
struct ClosedParts {
    /// For each vertex the first vertex of exactly the same position (-0 and 0 are the same).
    std::vector<unsigned> welded;
    /// For each triangle the number of its connected part, over welded vertices: a vertex of the part.
    std::vector<unsigned> part;
    /// For each triangle whether its connected part (over welded vertices) is closed and its faces look outwards: every
    /// edge is passed as often in one direction as in the other, and the enclosed volume is positive.
    std::vector<bool> closed;
};

/// @param positions  `vertexCount` finite positions.
/// @param indices    three a triangle, each below `vertexCount`; `indexCount` of them.
/// @param overSeams  take seams that rounding alone leaves open for closed, as those at the poles of a ball.
///
/// From a point outside, a ray that meets such a part meets as many of its faces from the front as from behind: the
/// faces turned to the light cast all of its shadow, the others can be left out. Cost  sorts the vertices and the edges
/// once: of 3,000,000 triangles 0.25 µs a triangle where they share their corners, 0.7 where each has three of its own.
ClosedParts closedParts(const glm::vec3* positions, std::size_t vertexCount, const unsigned* indices,
                        std::size_t indexCount, bool overSeams = false);

} // namespace gnomon
