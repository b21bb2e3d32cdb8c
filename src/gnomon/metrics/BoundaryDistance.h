// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/Grid.h>
#include <optional>

namespace gnomon::metrics {

/// M4: how far the drawn boundary of a shadow (V = 0.5) lies from the true one (T_a = 0.5), both ways. All in px.
///
/// Every piece of at most 0.5 px of either boundary gives the distance from its middle to the nearest point of the
/// other, and counts by its length. Pixels of a perspective view are not metres: use a nadir orthographic camera for
/// those.
struct BoundaryDistance {
    double mean = 0.0;
    double p95 = 0.0;        ///< 95th percentile: the headline of accuracy.
    double max = 0.0;        ///< the Hausdorff distance; one pixel of acne sets it: a flag of stability only.
    double signedMean = 0.0; ///< outwards of the true shadow is +: the shadow is dilated; - eroded.
    double drawnLength = 0.0, trueLength = 0.0;
};

/// @param visibility  V.    @param lit  T_a.    Both finite in `within`, all of one size.
/// @param within      R+: only squares of four such pixel centres are looked at.
/// @return nullopt unless both boundaries exist: there is no distance to nothing.
///
/// A hard V, 0 or 1 at pixel centres, has its boundary known to about half a pixel at each place; the mean over a
/// slanting edge is far better. Source: Huttenlocher et al., "Comparing images using the Hausdorff distance", PAMI 1993.
std::optional<BoundaryDistance> boundaryDistance(const Picture& visibility, const Picture& lit, const Mask& within);

} // namespace gnomon::metrics
