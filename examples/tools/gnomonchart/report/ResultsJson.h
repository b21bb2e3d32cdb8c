// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

namespace gnomon::examples {

/// Everything, by the names that ChartResults has; units are in the names. What does not exist is null.
nlohmann::ordered_json jsonOf(const ChartResults& results);

/// @throws std::runtime_error, one sentence that says where and what is missing or of the wrong kind.
ChartResults chartResultsOf(const nlohmann::json& json);

} // namespace gnomon::examples
