// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

/// Budget of an AutoShadowTechnique, with its default. Use it to keep a budget apart from a node.
struct GNOMON_EXPORT AutoShadowOptions {
    static constexpr double leastError = 0.01; ///< Range of error, pixels. Nothing drawn by pixels is finer.
    static constexpr double mostError = 100.0; ///< Range of error, pixels.
    static constexpr double usualError = 1.0;  ///< Pixels, if no error is set.

    /// Largest error of the shadow's edge, pixels, 0.01 … 100: 95 % of the edge lies within this distance of the true one.
    /// Default 0: usualError.
    double error = 0.0;

    /// An option that can be used. An error above 0 is clamped to its range. 0, negative numbers and NaN become 0.
    AutoShadowOptions usable() const;
};

} // namespace gnomon
