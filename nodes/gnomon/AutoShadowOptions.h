// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

/// Budget of an AutoShadowTechnique, with its defaults.
///
/// Use it to set both at once, or to keep them apart from a node. A technique's setters change one each.
struct GNOMON_EXPORT AutoShadowOptions {
    static constexpr double leastError = 0.01; ///< Range of error, pixels. Nothing drawn by pixels is finer.
    static constexpr double mostError = 100.0; ///< Range of error, pixels.
    static constexpr double leastTime = 0.01;  ///< Range of time, milliseconds.
    static constexpr double mostTime = 1e4;    ///< Range of time, milliseconds.
    static constexpr double usualError = 1.0;  ///< Pixels, if no error is set. With a time, the first one.

    /// Largest error of the shadow's edge, pixels, 0.01 … 100: 95 % of the edge lies within this distance of the true one.
    /// Default 0: 1 pixel if no time is set, else as small as the time allows.
    double error = 0.0;
    /// Most time that drawing the shadows of a view may take, milliseconds, 0.01 … 10000, by OpenGL's timer queries. The error
    /// is loosened up to 8 pixels where they take longer. Default 0: no limit.
    double time = 0.0;

    /// Options that can be used. Numbers are clamped to their ranges. 0, negative numbers and NaN become 0.
    AutoShadowOptions usable() const;
};

} // namespace gnomon
