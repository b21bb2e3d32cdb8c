// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/TruthMaps.h>
#include <optional>

namespace gnomon::metrics {

/// How far shadows have come off what casts them: the mean length, in metres along the sun's azimuth on level ground, of
/// the lit gaps `peterPanning`. Each connected gap's horizontal area, divided by its breadth across the azimuth.
///
/// nullopt without such pixels, without positions, or with the light straight up or unknown. Breadth is that of whole
/// pixels: exact where pixels lie along the azimuth, up to a pixel too much (and the gap too short) else.
std::optional<double> contactGap(const Mask& peterPanning, const TruthMaps& truth);

} // namespace gnomon::metrics
