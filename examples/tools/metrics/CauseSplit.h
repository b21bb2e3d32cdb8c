// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/PixelSets.h>
#include <optional>

namespace gnomon::metrics {

/// Distances that sort errors by cause. For a shadow map, two of its texels may replace either default.
struct CauseLimits {
    double boundary = 2.0; ///< Px. An error nearer than this to a true boundary is attached to it.
    double contact = 0.5;  ///< Metres. A pixel with a smaller t_b is at its blocker's foot.
};

/// M5: the number of wrong pixels by cause. Each cause is named after its remedy.
///
/// FS are the falsely shadowed pixels, FL the falsely lit ones. acne + halo + peterPanning + leak + erosion = FS + FL.
/// A wrong pixel is attached if it is near a true boundary (T_a = 0.5), or if its connected part touches the truth.
/// FS touches a pixel that is truly shadowed at least in part, FL one that is truly lit at least in part. Each pixel
/// has 8 neighbours.
struct CauseSplit {
    std::size_t acne = 0;         ///< FS that is not attached.
    std::size_t halo = 0;         ///< FS that is attached.
    std::size_t peterPanning = 0; ///< FL with t_b below CauseLimits::contact.
    std::size_t leak = 0;         ///< Other FL that is not attached.
    std::size_t erosion = 0;      ///< Other FL that is attached.
    std::size_t overDark = 0;     ///< Pixels of R+ with V < -0.05, darkened twice. Not part of the sum.
    std::size_t overBright = 0;   ///< Pixels of R+ with V > 1.05. Not part of the sum.

    std::optional<double> acneShare;         ///< Acne as a share of the truly lit pixels of Rc.
    std::optional<double> peterPanningShare; ///< As a share of the shadowed pixels of Rc with t_b below the limit.
    std::optional<double> gap;               ///< Metres, see contactGap().
};

/// Measures M5.
///
/// @param visibility  V.
/// @param truth       truth of the same size.
/// @param sets        pixelSets() of both.
/// @param limits      distances that sort errors by cause.
CauseSplit causeSplit(const Picture& visibility, const TruthMaps& truth, const PixelSets& sets,
                      const CauseLimits& limits = {});

} // namespace gnomon::metrics
