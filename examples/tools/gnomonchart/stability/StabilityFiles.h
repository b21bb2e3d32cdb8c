// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityResults.h"

#include <nlohmann/json_fwd.hpp>

namespace gnomon::examples {

/// Writes stability.json (everything) and stability.csv (a line a technique, scene and value) into an existing folder, each
/// whole or not at all.
/// @throws std::runtime_error, one sentence, if a file cannot be written.
void saveStability(const StabilityResults& results, const std::string& folder);

/// Reads a stability.json back. @throws std::runtime_error, one sentence, if it is missing, no JSON, or lacks something.
StabilityResults loadStability(const std::string& file);

/// What a child process hands over.
nlohmann::json jsonOf(const StabilityCell& cell);
nlohmann::json jsonOf(const StabilityFlicker& flicker);
StabilityCell cellOf(const nlohmann::json& json);
StabilityFlicker flickerOf(const nlohmann::json& json);

} // namespace gnomon::examples
