// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/MapFit.h>
#include <gnomon/mapfit/SpotCone.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace gnomon {

glm::dmat4 coneFromScene(const glm::dvec3& apex, const SpotCone& cone) {
    const glm::dmat4 lamp = lampFrame(apex, cone.axis, 1.0).lightFromScene;
    const double across = std::cos(cone.cutoff), along = std::sin(cone.cutoff);
    return glm::transpose(glm::dmat4(across * glm::row(lamp, 0), across * glm::row(lamp, 1), along * glm::row(lamp, 3),
                                     glm::dvec4(0.0, 0.0, 0.0, 1.0)));
}

} // namespace gnomon
