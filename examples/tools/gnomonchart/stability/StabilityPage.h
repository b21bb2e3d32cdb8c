// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityResults.h"

#include <string>

namespace gnomon::examples {

/// Writes into the results' folder what people read: the heat map stability.svg, .png and .gnuplot, and stability.html, one
/// file with the heat map, a sortable table, and a window for each cell with its pictures and the sweep's curve.
/// Needs   gnuplot.
/// @throws std::runtime_error, one sentence, if the figure cannot be drawn or a file not be written.
void writeStabilityPage(const StabilityResults& results, const std::string& folder);

} // namespace gnomon::examples
