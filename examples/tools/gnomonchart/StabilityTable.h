// SPDX-License-Identifier: MIT
#pragma once
#include "ChartOptions.h"

#include <functional>

namespace gnomon::examples {

/// Measures the stability table, writes it into the options' folder, and prints it.
/// @param stops  asked again and again; true ends the run with what there is.
/// @return whether it is complete.
/// @throws std::invalid_argument, one sentence, for a scene or technique that is not there; std::runtime_error, one
/// sentence, if a file cannot be written.
bool makeStabilityTable(const ChartOptions& options, const std::string& command, const std::function<bool()>& stops);

/// Searches random scenes for shadows that Gnomon's techniques lose without a word, and prints each with the plainest scene
/// in which it is lost.
/// @return whether there is none, and the search went to its end.
bool searchRandom(const ChartOptions& options, const std::function<bool()>& stops);

} // namespace gnomon::examples
