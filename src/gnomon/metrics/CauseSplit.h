// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/PixelSets.h>
#include <optional>

namespace gnomon::metrics {

/// What counts as near. With a shadow map two of its texels may take the place of either default.
struct CauseLimits {
    double boundary = 2.0; ///< px, farther from a true boundary nothing is attached to it by its place alone.
    double contact = 0.5;  ///< metres, t_b below which a pixel is at its blocker's foot.
};

/// M5: the wrong pixels by cause; the five names of the fix. acne + halo + peterPanning + leak + erosion is FS + FL.
///
/// A wrong pixel is attached if it is near a true boundary (T_a = 0.5) or its connected part of FS or FL touches, with
/// one of 8 neighbours, a pixel that is truly not wholly what it should be: partly shadowed for FS, partly lit for FL.
struct CauseSplit {
    std::size_t acne = 0;         ///< FS, not attached
    std::size_t halo = 0;         ///< FS, attached
    std::size_t peterPanning = 0; ///< FL with t_b below the contact's limit
    std::size_t leak = 0;         ///< FL from there on, not attached
    std::size_t erosion = 0;      ///< the rest of FL
    std::size_t overDark = 0;     ///< of R+, V < -0.05: darkened twice. Not among the five.
    std::size_t overBright = 0;   ///< of R+, V > 1.05. Not among the five.

    std::optional<double> acneShare;         ///< of all pixels of Rc that are truly lit
    std::optional<double> peterPanningShare; ///< of all pixels of Rc at contact: truly shadowed, t_b below the limit
    std::optional<double> gap;               ///< metres, see contactGap()
};

CauseSplit causeSplit(const Picture& visibility, const TruthMaps& truth, const PixelSets& sets,
                      const CauseLimits& limits = {});

} // namespace gnomon::metrics
