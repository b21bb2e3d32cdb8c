// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/Grid.h>

namespace gnomon::metrics {

/// Least B - S from which a visibility is measured: below it rounding of 8-bit colour would decide.
constexpr double leastContrast = 8.0 / 255.0;

/// The visibility that a renderer shows.
struct Visibility {
    Picture value;               ///< V: 0 in full shadow, 1 lit; never clamped; NaN where it is not measured.
    std::size_t notFinite = 0;   ///< pixels with NaN or infinity in a picture: a catastrophe each.
    std::size_t lowContrast = 0; ///< pixels not measured because B - S is below leastContrast.
};

/// V = (A - S) / (B - S), pixel by pixel.
///
/// @param casting     A: linear grey, the technique on.
/// @param notCasting  B: the same with no caster in its cast pass, all still drawn. Same size.
/// @param shadowed    S: everything in shadow. Same size.
///
/// White, unlit, untextured surfaces in float colour make V affine in visibility for any technique.
Visibility visibility(const Picture& casting, const Picture& notCasting, const Picture& shadowed);

} // namespace gnomon::metrics
