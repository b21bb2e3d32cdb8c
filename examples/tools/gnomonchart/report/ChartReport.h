// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

#include <string>

namespace gnomon::examples {

/// Writes into the results' folder what people read: the figures (see drawFigures()) and index.html (see pageOf()).
/// Cost    about a second a scene.
/// Needs   gnuplot.
/// @throws std::runtime_error, one sentence, if a figure cannot be drawn or a file not be written.
void writeReport(const ChartResults& results, const std::string& folder);

} // namespace gnomon::examples
