// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/Grid.h>
#include <optional>

namespace gnomon::metrics {

/// M4: distance between the drawn boundary of a shadow (V = 0.5) and the true one (T_a = 0.5), px.
///
/// Both boundaries are cut into pieces of at most 0.5 px. Each piece gives the distance from its midpoint to the
/// nearest point of the other boundary, weighted by its length.
/// For metres, use an orthographic camera that looks straight down: pixels of a perspective view are not metres.
struct BoundaryDistance {
    double mean = 0.0;        ///< Mean distance.
    double p95 = 0.0;         ///< 95th percentile of the distances: the headline of accuracy.
    double max = 0.0;         ///< Greatest (Hausdorff) distance. A single pixel of acne sets it: a flag of stability.
    double signedMean = 0.0;  ///< Mean with a sign: + if the drawn shadow is too large, - if it is too small.
    double drawnLength = 0.0; ///< Length of the drawn boundary.
    double trueLength = 0.0;  ///< Length of the true boundary.
};

/// Measures M4.
///
/// @param visibility  V, finite in `within`.
/// @param lit         T_a, finite in `within`. All three have one size.
/// @param within      R+. Only squares of four such pixel centres count.
/// @return            nullopt unless both boundaries exist.
///
/// If V is hard, 0 or 1 at pixel centres, each place of its boundary is known to half a pixel. The mean over a slanting
/// edge is much more precise.
///
/// Source
/// - D. Huttenlocher et al., "Comparing images using the Hausdorff distance", PAMI 1993.
std::optional<BoundaryDistance> boundaryDistance(const Picture& visibility, const Picture& lit, const Mask& within);

} // namespace gnomon::metrics
