// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>

namespace gnomon {

/// How far OpenGL may draw a surface from its place: at w = 1 in clip space, elsewhere divided by w.
struct DrawnError {
    double depth = 0.0;  ///< of 0 … 1.
    double pixels = 0.0; ///< along either axis.
};

/// OpenGL takes vertices to clip space in floats, and cuts polygons there: a clip coordinate is off by steps of a float as
/// large as the vertices' own coordinates and as the polygon. Its matrices are floats, too, and so is their product: of a
/// telescope's, far away and with planes close about what is seen, large terms cancel. Measured with llvmpipe: a tenth of what
/// is allowed here for sides, a third of what is allowed for coordinates, a fifth of what is allowed for matrices.
/// @param projection  as it is drawn.
/// @param width        of the viewport, pixels.
/// @param rounding     of the vertices' own coordinates to floats, scene's unit.
/// @param longestSide  of the polygons.
DrawnError drawnError(const glm::dmat4& clipFromScene, const glm::dmat4& projection, double width, double rounding,
                      double longestSide);

} // namespace gnomon
