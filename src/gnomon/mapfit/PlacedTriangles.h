// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace gnomon {

/// A mesh of others, at a place in the scene.
struct PlacedTriangles {
    const glm::vec3* corners;
    std::size_t cornerCount;
    const unsigned* indices; ///< three a triangle.
    std::size_t count;       ///< of the triangles.
    glm::dmat4 sceneFromMesh;
    std::vector<std::size_t> parts; ///< the first triangle of each object, ascending.
};

} // namespace gnomon
