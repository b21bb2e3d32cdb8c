// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gnomon {

/// What a spot lights: all about a way from where it stands.
struct SpotCone {
    glm::dvec3 axis{0.0, 0.0, -1.0}; ///< unit.
    double cutoff = 0.0;             ///< from the axis to the cone's side, radians, 0 … π/2.

    bool operator==(const SpotCone& other) const { return axis == other.axis && cutoff == other.cutoff; }
};

/// Takes points of the scene (w of 1, or more than 0) to where the cone stands at the origin: within it is what has a z of
/// 0 or more, and x² + y² of z² or less.
glm::dmat4 coneFromScene(const glm::dvec3& apex, const SpotCone& cone);

} // namespace gnomon
