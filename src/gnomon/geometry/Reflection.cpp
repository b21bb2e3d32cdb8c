// SPDX-License-Identifier: MIT
#include <gnomon/Reflection.h>

#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace gnomon {

glm::dmat4 reflectionMatrix(const glm::dvec4& plane) {
    return glm::dmat4(1.0) - 2.0 * glm::outerProduct(glm::dvec4(glm::dvec3(plane), 0.0), plane);
}

} // namespace gnomon
