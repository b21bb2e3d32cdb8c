// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/ShadowMetrics.h>
#include <nlohmann/json.hpp>

#include <string>

namespace gnomon::examples {

/// The numbers as a person reads them, a line a metric.
std::string reportText(const metrics::ShadowMetrics& metrics);

/// Which there are, in words; "none".
std::string catastropheText(const metrics::Catastrophes& catastrophes);

/// The same in full. Shares are 0 to 1; what does not exist is null; units are in the names.
nlohmann::json reportJson(const metrics::ShadowMetrics& metrics);

/// What reportJson() made of it. What follows from other numbers is not looked at.
/// @throws std::runtime_error, one sentence, if a number is missing.
metrics::ShadowMetrics reportOf(const nlohmann::json& report);

} // namespace gnomon::examples
