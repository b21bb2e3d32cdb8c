// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/PixelSets.h>
#include <optional>

namespace gnomon::metrics {

/// Counts of rightly and wrongly shadowed pixels: metrics M1, M2 and M3.
///
/// s is true for a pixel that is drawn shadowed (V < 0.5), t for a pixel that is truly shadowed (T_c is 0).
/// A share is nullopt if it would be of no pixels.
struct Confusion {
    std::size_t shadow = 0;      ///< Pixels with s & t.
    std::size_t falseShadow = 0; ///< FS: pixels with s & !t.
    std::size_t falseLit = 0;    ///< FL: pixels with !s & t.
    std::size_t lit = 0;         ///< Pixels with !s & !t.

    /// Number of pixels counted.
    std::size_t pixels() const { return shadow + falseShadow + falseLit + lit; }
    /// M1: (FS + FL) / all, 0 … 1. Do not use it alone: it is small if the shadow is small.
    std::optional<double> misclassified() const;
    /// A half of M2: FS / !t, 0 … 1.
    std::optional<double> falseShadowShare() const;
    /// The other half of M2: FL / t, 0 … 1.
    std::optional<double> falseLitShare() const;
    /// M2: mean of the two halves, 0 … 1. If the truth is all lit or all shadow, the half that exists.
    std::optional<double> balancedError() const;
    /// M3: |s & t| / |s | t|, 0 … 1. It is 1 if no pixel is shadowed or should be.
    double intersectionOverUnion() const;
};

/// True if a pixel of this visibility counts as shadowed.
constexpr bool isShadowed(double visibility) { return visibility < 0.5; }

/// Counts the pixels of `within`. V must be measured there.
Confusion confusion(const Picture& visibility, const TruthMaps& truth, const Mask& within);

} // namespace gnomon::metrics
