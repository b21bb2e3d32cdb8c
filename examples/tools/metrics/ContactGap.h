// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/TruthMaps.h>
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

} // namespace gnomon::metrics
