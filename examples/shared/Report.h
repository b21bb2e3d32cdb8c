// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/ShadowMetrics.h>
#include <nlohmann/json.hpp>

#include <string>

namespace gnomon::examples {

/// The numbers as a person reads them, a line a metric.
std::string reportText(const metrics::ShadowMetrics& metrics);

/// The same in full. Shares are 0 to 1; what does not exist is null; units are in the names.
nlohmann::ordered_json jsonOf(const metrics::ShadowMetrics& metrics);

} // namespace gnomon::examples
