// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/TruthMaps.h>
#include <optional>

namespace gnomon::metrics {

/// How many pixels are shadowed (V < 0.5) and should be (T_c in shadow). A share of no pixels at all is nullopt.
struct Confusion {
    std::size_t shadow = 0;      ///< s & t
    std::size_t falseShadow = 0; ///< FS = s & !t
    std::size_t falseLit = 0;    ///< FL = !s & t
    std::size_t lit = 0;         ///< !s & !t

    std::size_t pixels() const { return shadow + falseShadow + falseLit + lit; }
    /// M1: (FS + FL) / all, 0 to 1. Scales with the shadow's share of the picture: never alone.
    std::optional<double> misclassified() const;
    /// FS / !t and FL / t, 0 to 1: the halves of M2.
    std::optional<double> falseShadowShare() const, falseLitShare() const;
    /// M2: mean of the two halves, 0 to 1; of the one that there is, where the truth is all lit or all shadow.
    std::optional<double> balancedError() const;
    /// M3: |s & t| / |s | t|, 0 to 1. 1 if nothing is shadowed nor should be; 0 if only one of both.
    double intersectionOverUnion() const;
};

/// Whether a pixel of this visibility counts as shadowed.
constexpr bool isShadowed(double visibility) { return visibility < 0.5; }

/// Counts the pixels of `within`, where V is measured.
Confusion confusion(const Picture& visibility, const TruthMaps& truth, const Mask& within);

} // namespace gnomon::metrics
