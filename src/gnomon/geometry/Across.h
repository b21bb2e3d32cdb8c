// SPDX-License-Identifier: MIT
#pragma once
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace gnomon {

/// Two unit vectors at right angles to each other and to a direction.
struct Across {
    glm::dvec3 u, v; ///< u × v is the direction.
};

/// @param along  the direction, of unit length. The vectors jump where |z| is 0.7.
inline Across across(const glm::dvec3& along) {
    const glm::dvec3 any = std::abs(along.z) < 0.7 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(any, along));
    return {u, glm::cross(along, u)};
}

} // namespace gnomon
