// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/Grid.h>
#include <metrics/PixelSets.h>

#include <optional>

namespace gnomon::metrics {

/// Measures how far shadows have come off their casters: the mean length of the lit gaps at contact, metres.
///
/// The length is along the sun's azimuth on level ground. It is the gaps' horizontal area divided by their breadth
/// across the azimuth. The breadth may be a pixel too large, unless the pixels lie along the azimuth.
///
/// @param peterPanning  the pixels of the gaps.
/// @param truth         truth of the same size, with positions and the direction to the light.
/// @return              nullopt without gaps or positions, or if the light is straight up or unknown.
std::optional<double> contactGap(const Mask& peterPanning, const TruthMaps& truth);

/// The connected parts of a set of pixels. A pixel is connected to its 8 neighbours.
struct Components {
    Grid<int> part; ///< Number of each pixel's part, from 0; -1 outside the set.
    int count = 0;  ///< Number of parts.
};

/// Finds the connected parts of a set.
Components components(const Mask& mask);

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
