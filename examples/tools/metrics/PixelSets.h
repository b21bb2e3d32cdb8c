// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/TruthMaps.h>

namespace gnomon::metrics {

/// The sets of pixels that metrics look at. No set has pixels whose visibility is unmeasured. Of the pixels turned away, those
/// within 2 px of a shadow's edge on the back of a single sheet are left out, too.
struct PixelSets {
    Mask agreeing;             ///< R: the pixel and its 4 neighbours are one surface, in the truth and as drawn.
    Mask facing;               ///< R+: pixels of R with N_g.L > 0.05.
    Mask certain;              ///< Rc: pixels of R+ whose rays all agree (T_a is 0 or 1). The headline set.
    Mask turnedAway;           ///< Pixels of R with N_g.L <= 0 whose 24 neighbours lie on the same plane, by N_g.L.
    Mask terminator;           ///< Pixels of R with 0 < N_g.L <= 0.05. Reported apart.
    Mask selfShadowed;         ///< Pixels of R+ that their own object blocks within 2 edge lengths. Reported apart.
    double droppedShare = 0.0; ///< Share of surface pixels that R leaves out because of their ids, 0 … 1.

    /// True if the picture may be judged: at most 5 % of the surface pixels are dropped.
    bool sound() const { return droppedShare <= 0.05; }
};

/// Sorts the pixels of a picture into sets.
///
/// Without TruthMaps::drawn, only silhouettes are dropped. Without blocker ids or edge lengths, selfShadowed is empty.
/// A pixel whose N_g.L is NaN is in R alone.
///
/// @param visibility  V, NaN at unmeasured pixels. Same size as the truth.
PixelSets pixelSets(const TruthMaps& truth, const Picture& visibility);

} // namespace gnomon::metrics
