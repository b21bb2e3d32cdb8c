// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityResults.h"

#include <nlohmann/json_fwd.hpp>

namespace gnomon::examples {

/// Writes stability.json into an existing folder, whole or not at all.
/// @throws std::runtime_error, one sentence, if the file cannot be written.
void saveStability(const StabilityResults& results, const std::string& folder);

/// What a child process hands over.
nlohmann::json jsonOf(const StabilityCell& cell);
nlohmann::json jsonOf(const StabilityFlicker& flicker);
StabilityCell cellOf(const nlohmann::json& json);
StabilityFlicker flickerOf(const nlohmann::json& json);

} // namespace gnomon::examples
