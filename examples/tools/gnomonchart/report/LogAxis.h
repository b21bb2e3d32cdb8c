// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

namespace gnomon::examples {

/// A logarithmic axis and where it lies on the page.
struct LogAxis {
    double low = 1.0, high = 10.0; ///< values at its ends, above 0.
    double from = 0.0, to = 1.0;   ///< px of its ends.

    /// px; values outside go to the end.
    double place(double value) const;
    /// Values 1, 2 and 5 times a power of ten within it; if that is more than `most`, the powers alone.
    std::vector<double> ticks(std::size_t most = 12) const;
};

/// An axis that shows all values, the smallest no lower than `least`, with some air at either end.
LogAxis logAxis(const std::vector<double>& values, double least, double from, double to);

} // namespace gnomon::examples
