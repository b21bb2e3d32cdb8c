// SPDX-License-Identifier: MIT
#pragma once
#include "Peers.h"
#include "Yardstick.h"

#include <functional>

namespace gnomon::examples {

/// How good a still picture is, lower is better: 95th percentile of the boundary distance, px, plus the share of certain
/// pixels that are wrong, %, plus the teeth's share of the surface, %; infinite for a catastrophe. So a pixel of distance weighs as much as 1 % of acne or leaks.
double score(const metrics::ShadowMetrics& metrics);

/// How wide a sweep goes.
enum class SweepWidth {
    NARROW, ///< the first two knobs, the first three values of each
    WIDE    ///< all knobs and values
};

/// The best settings that are found by turning one knob after the other, each to its best value with the others as they
/// are, beginning at the class's defaults; the first knob, the map's size, once more at the end. Still pictures alone are
/// compared. Settings that fail count as catastrophes.
///
/// Cost    a fresh viewer and two frames a value.
/// @param goesOn  asked before each picture; false stops the sweep with the best so far.
/// @return what differs from the defaults; ambientBias for the scene's ambient light with it, where the class has one.
Settings bestSettings(const Peer& peer, const Yardstick& yardstick, SweepWidth width,
                      const std::function<bool()>& goesOn);

} // namespace gnomon::examples
