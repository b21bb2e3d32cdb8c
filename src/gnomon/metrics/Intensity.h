// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <gnomon/metrics/Grid.h>
#include <optional>

namespace gnomon::metrics {

/// M6: how wrong the visibility's value is, root mean square, V never clamped. nullopt where there is no pixel.
struct IntensityError {
    std::optional<double> all;      ///< on R+
    std::optional<double> penumbra; ///< on those of R+ with 0.02 < T < 0.98
};

/// @param lit  T_a of a point light or of the sun's disc. Give both: a wide filter wins one and loses the other.
IntensityError intensityError(const Picture& visibility, const Picture& lit, const Mask& facing);

/// The same after a box filter of 4 x 4 px over both, where all 16 pixels are in R+: fair to shadows thinner than a pixel,
/// which are edge pixels all over and in no class.
IntensityError thinIntensityError(const Picture& visibility, const Picture& lit, const Mask& facing);

/// Root mean square difference of two shaded pictures in linear light, over pixels and channels; on R, back faces too:
/// there a wrong visibility must be harmless. nullopt where there is no pixel. Pixels that are not finite are left out.
std::optional<double> shadedError(const Grid<glm::dvec3>& picture, const Grid<glm::dvec3>& truth, const Mask& within);

} // namespace gnomon::metrics
