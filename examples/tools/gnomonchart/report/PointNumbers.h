// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

#include <string>
#include <vector>

namespace gnomon::examples {

/// One number that a point has: a column of results.csv, a column or a line of index.html.
struct PointNumber {
    const char* name;  ///< for files: words and the unit, "added_steady_wall_ms".
    const char* title; ///< for people, without the unit.
    const char* unit;  ///< "ms", "px", "%", "MiB"; empty: a pure number.
    const char* group; ///< heading in the page: "cost", "accuracy", "causes", "stability".
    bool inTable;      ///< a column of the page's table; the others show when a point is opened.
    std::optional<double> (*of)(const ChartPoint& point); ///< nullopt where the point has none. Shares are in %.
};

/// All of them, in the order in which they are shown.
const std::vector<PointNumber>& pointNumbers();

} // namespace gnomon::examples
