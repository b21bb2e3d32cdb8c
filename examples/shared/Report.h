// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/ShadowMetrics.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// The numbers as a person reads them, a line a metric.
std::string reportText(const metrics::ShadowMetrics& metrics);

/// The same in full. Shares are 0 to 1; what does not exist is null; units are in the names.
nlohmann::ordered_json jsonOf(const metrics::ShadowMetrics& metrics);

/// A number for a file. JSON has neither NaN nor infinity: those are the texts "NaN", "Infinity" and "-Infinity".
inline nlohmann::ordered_json jsonOf(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    return value;
}

/// null if there is none.
template <class Part>
nlohmann::ordered_json jsonOf(const std::optional<Part>& part) {
    return part ? jsonOf(*part) : nlohmann::ordered_json();
}

template <class Part>
nlohmann::ordered_json jsonOf(const std::vector<Part>& parts) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Part& part : parts) list.push_back(jsonOf(part));
    return list;
}

/// Results as a file holds them, a value a line. Text from drivers and file names need not be UTF-8: what is not becomes U+FFFD.
inline std::string resultsText(const nlohmann::ordered_json& results) {
    return results.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::examples
