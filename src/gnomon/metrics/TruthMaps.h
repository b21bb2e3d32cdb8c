// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <gnomon/metrics/Grid.h>

namespace gnomon::metrics {

/// What is true at each pixel of one view of one light. All grids have one size; those called optional may be empty.
struct TruthMaps {
    Picture lit;                  ///< T_a: share, 0 to 1, of a pixel's rays (16 in a 4 x 4 grid) that reach the light.
    Mask litCentre;               ///< T_c: whether the ray from the pixel's centre does.
    Picture blockerDistance;      ///< t_b: metres along the centre ray to what blocks it; anything where T_c is lit.
    Grid<int> receiver;           ///< id of the surface at the pixel's centre; 0 is none (background).
    Picture facing;               ///< N_g.L, -1 to 1: cosine between geometric normal and the way to the light.
    Grid<int> drawn;              ///< optional: the same id as the renderer drew it.
    Picture litByDisc;            ///< optional: T_a of the sun's disc, 0.533 degrees across.
    Grid<int> blocker;            ///< optional: id of what blocks the centre ray; 0 is nothing.
    Picture edgeLength;           ///< optional: metres, longest edge of the receiver's triangle.
    Grid<glm::dvec3> position;    ///< optional: metres, point of the surface at the pixel's centre.
    glm::dvec3 towardsLight{0.0}; ///< optional, any length: the way to the light; zero is unknown.
    glm::dvec3 up{0.0, 0.0, 1.0}; ///< unit.
};

} // namespace gnomon::metrics
