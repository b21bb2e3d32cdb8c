// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

namespace gnomon::examples {

/// Writes results.json (everything, every bit of every number) and results.csv (one line a point, see csvOf()) into
/// an existing folder, each whole or not at all.
/// Cost    about 0.15 ms a point that it holds: may be called after every one of some hundreds.
/// @throws std::runtime_error, one sentence, if a file cannot be written.
void saveResults(const ChartResults& results, const std::string& folder);

/// Reads a results.json back, the same to the bit.
/// @throws std::runtime_error, one sentence, if it is missing, no JSON, or lacks something.
ChartResults loadResults(const std::string& file);

} // namespace gnomon::examples
