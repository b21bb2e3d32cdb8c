// SPDX-License-Identifier: MIT
#pragma once
#include <charconv>
#include <optional>
#include <string>

namespace gnomon {

/// The shortest text that reads back as the same number: "0.533", "1e6".
template <typename Number>
std::string textOf(Number number) {
    char text[32];
    std::string result(text, std::to_chars(text, text + sizeof text, number).ptr);
    const std::size_t exponent = result.find("e+0");
    return exponent == std::string::npos ? result : result.erase(exponent + 1, 2);
}

/// A number of at least 0 to two digits that count, without an exponent: "0.0012", "3.5", "353".
inline std::string roundedText(double number) {
    int decimals = 0;
    for (double scaled = number; number > 0.0 && scaled < 9.95 && decimals < 6; scaled *= 10.0) ++decimals;
    char text[64];
    return std::string(text, std::to_chars(text, text + sizeof text, number, std::chars_format::fixed, decimals).ptr);
}

/// The whole text as a number; nullopt if it is none, or not within the limits.
template <typename Number>
std::optional<Number> numberIn(const std::string& text, Number low, Number high) {
    Number number{};
    const char* end = text.data() + text.size();
    const std::from_chars_result read = std::from_chars(text.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || !(number >= low && number <= high)) return std::nullopt;
    return number;
}

} // namespace gnomon
