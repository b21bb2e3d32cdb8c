// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/TruthMaps.h>

namespace gnomon::metrics {

/// Which pixels a metric looks at. All but droppedShare leave out pixels whose visibility is not measured.
struct PixelSets {
    Mask agreeing;     ///< R: the id is drawn as it is true, here and in the 4 neighbours, and theirs is the same.
    Mask facing;       ///< R+: of R, N_g.L > 0.05.
    Mask certain;      ///< Rc: of R+, all rays agree (T_a is 0 or 1). The headline set.
    Mask terminator;   ///< of R, 0 < N_g.L <= 0.05: reported apart.
    Mask selfShadowed; ///< of R+, blocked by its own object within 2 edge lengths: smooth shading's artefact.
    double droppedShare = 0.0; ///< share of the surface's pixels that R leaves out for their ids, 0 to 1.

    /// Whether the scene may be judged: at most 5 % dropped.
    bool sound() const { return droppedShare <= 0.05; }
};

/// @param visibility  V, NaN where not measured. Same size as the truth.
/// A truth without drawn ids counts as drawn truly: silhouettes alone are dropped then. Without blocker ids or edge
/// lengths nothing is selfShadowed. N_g.L of NaN is in no set but R.
PixelSets pixelSets(const TruthMaps& truth, const Picture& visibility);

} // namespace gnomon::metrics
