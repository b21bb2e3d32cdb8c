// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/Grid.h>

namespace gnomon::metrics {

/// The connected parts of a set of pixels. A pixel is connected to its 8 neighbours.
struct Components {
    Grid<int> part; ///< Number of each pixel's part, from 0; -1 outside the set.
    int count = 0;  ///< Number of parts.
};

/// Finds the connected parts of a set.
Components components(const Mask& mask);

} // namespace gnomon::metrics
