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

/// Prints the table of a folder's stability.json again.
void printStabilityAgain(const std::string& folder);

} // namespace gnomon::examples
