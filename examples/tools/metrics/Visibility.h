// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <metrics/Grid.h>

#include <optional>

namespace gnomon::metrics {

/// Least contrast B - S that visibility() measures. Below it, the rounding of 8-bit colour would decide.
constexpr double leastContrast = 8.0 / 255.0;

/// The visibility V that a renderer's pictures show: the share of the light at each pixel.
struct Visibility {
    Picture value;               ///< V: 0 in full shadow, 1 lit. Never clamped. NaN at unmeasured pixels.
    std::size_t notFinite = 0;   ///< Number of pixels with NaN or infinity in a picture; each is a catastrophe.
    std::size_t lowContrast = 0; ///< Number of pixels that are unmeasured because B - S is below leastContrast.
};

/// Computes V = (A - S) / (B - S) for each pixel, from three pictures of any renderer.
///
/// @param casting     A: linear grey, the technique on.
/// @param notCasting  B: the same without casters in the technique's cast pass. All objects are still drawn.
/// @param shadowed    S: everything in shadow.
///
/// All pictures have one size. Draw white, untextured surfaces in float colour. V is then affine in visibility for any
/// technique.
Visibility visibility(const Picture& casting, const Picture& notCasting, const Picture& shadowed);

/// M6: root mean square error of the visibility V, which is never clamped. nullopt if there is no pixel.
struct IntensityError {
    std::optional<double> all;      ///< On R+.
    std::optional<double> penumbra; ///< On the pixels of R+ with 0.02 < T < 0.98.
};

/// Measures M6, the error of the visibility's value.
///
/// @param visibility  V.
/// @param lit         T_a of a point light or of the sun's disc. Measure both: a wide filter gains on one and loses on
///                    the other.
/// @param facing      R+.
IntensityError intensityError(const Picture& visibility, const Picture& lit, const Mask& facing);

/// Measures M6 after a box filter of 4 x 4 px over both pictures, where all 16 pixels are in R+.
///
/// It is fair to shadows thinner than a pixel. All of their pixels are edge pixels, which Rc leaves out.
IntensityError thinIntensityError(const Picture& visibility, const Picture& lit, const Mask& facing);

/// Root mean square difference of two shaded pictures in linear light, over pixels and channels.
///
/// Measure it on R, back faces included: a wrong visibility must be harmless there.
/// @return nullopt if there is no pixel. Pixels that are not finite are left out.
std::optional<double> shadedError(const Grid<glm::dvec3>& picture, const Grid<glm::dvec3>& truth, const Mask& within);

} // namespace gnomon::metrics
