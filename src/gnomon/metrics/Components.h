// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/Grid.h>

namespace gnomon::metrics {

/// The 8-connected parts of a set of pixels.
struct Components {
    Grid<int> part; ///< number of each pixel's part, from 0; -1 outside the set.
    int count = 0;
};

Components components(const Mask& mask);

} // namespace gnomon::metrics
