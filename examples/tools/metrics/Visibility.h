// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/Grid.h>

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

} // namespace gnomon::metrics
