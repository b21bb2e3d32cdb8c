// SPDX-License-Identifier: MIT
#include "ResultsCsv.h"

#include "CsvText.h"
#include "PointNumbers.h"

#include <array>
#include <charconv>
#include <cmath>

namespace gnomon::examples {
namespace {

constexpr std::array textColumns = {"scene",
                                    "kit",
                                    "technique",
                                    "setting",
                                    "settings",
                                    "failure",
                                    "catastrophic",
                                    "notes",
                                    "picture",
                                    "overlay",
                                    "predicted_spec",
                                    "predicted_steady_spec",
                                    "predicted_moving_spec"};

constexpr const char* between = "; "; // texts of one field

/// What is not UTF-8 becomes U+FFFD, as in results.json.
std::string utf8(const std::string& text) {
    using nlohmann::json;
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

std::string shortest(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    std::array<char, 32> digits{}; // the longest shortest double has 24
    return {digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr};
}

std::string settingsText(const ChartPoint& point) {
    std::vector<std::string> parts;
    for (const auto& [name, value] : point.settings) parts.push_back(name + "=" + value);
    return joined(parts, between);
}

std::string header() {
    std::vector<std::string> names(textColumns.begin(), textColumns.end());
    for (const PointNumber& number : pointNumbers()) names.emplace_back(number.name);
    std::string line;
    for (const std::string& name : names) line += (line.empty() ? "" : ",") + name;
    return line + "\r\n";
}

std::string line(const ChartPoint& point) {
    const ChartPrediction predicted = point.prediction.value_or(ChartPrediction());
    const std::array<std::string, textColumns.size()> texts = {point.scene,
                                                               point.kit,
                                                               point.technique,
                                                               point.setting,
                                                               settingsText(point),
                                                               point.failure,
                                                               point.catastrophic() ? "yes" : "no",
                                                               joined(point.notes, between),
                                                               point.picture,
                                                               point.overlay,
                                                               predicted.spec,
                                                               predicted.steady.spec,
                                                               predicted.moving.spec};
    std::string result;
    for (const std::string& text : texts) result += csvField(utf8(text)) + ",";
    for (const PointNumber& number : pointNumbers()) {
        const std::optional<double> value = number.of(point);
        result += (value ? shortest(*value) : "") + ",";
    }
    result.pop_back();
    return result + "\r\n";
}

} // namespace

std::string csvOf(const ChartResults& results) {
    std::string text = header();
    for (const ChartPoint& point : results.points) text += line(point);
    return text;
}

} // namespace gnomon::examples
