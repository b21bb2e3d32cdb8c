// SPDX-License-Identifier: MIT
#include "GnuplotText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

namespace gnomon::examples {
namespace {

std::string withoutControls(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }, ' ');
    return text;
}

std::string place(const glm::dvec2& at) { return "screen X(" + plotNumber(at.x) + "),Y(" + plotNumber(at.y) + ")"; }

} // namespace

std::string plotNumber(double value) {
    std::ostringstream out;
    out << std::setprecision(6) << value;
    return out.str();
}

std::string shortNumber(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), std::abs(value) < 9.95 ? "%.2g" : "%.0f", value);
    return text.data();
}

std::string plotText(const std::string& text) {
    std::string result = "'";
    for (const char c : withoutControls(text)) result += c == '\'' ? "''" : std::string(1, c);
    return result + "'";
}

std::string plotComment(const std::string& text) { return "# " + withoutControls(text); }

std::string plotColour(const char* colour) { return "0x" + std::string(colour + 1); }

std::string plotTics(const std::vector<double>& values) {
    std::string tics;
    for (const double value : values)
        tics += (tics.empty() ? "'" : ", '") + plotNumber(value) + "' " + plotNumber(value);
    return tics;
}

glm::dvec2 textSize(const std::string& text, const TextLook& look) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }); // UTF-8
    return {static_cast<double>(letters) * look.size * (look.bold ? 0.68 : 0.6), 1.25 * look.size};
}

std::string textCommand(const std::string& text, const glm::dvec2& at, const TextLook& look, const std::string& more) {
    return "  set label " + plotText(text) + " at " + place(at) + " left front font 'DejaVu Sans" +
           (look.bold ? ":Bold" : "") + "," + plotNumber(look.size) + "' textcolor rgb '" + look.colour + "' " + more +
           "\n";
}

std::string lineCommand(const glm::dvec2& from, const glm::dvec2& to, const std::string& look) {
    return "  set arrow from " + place(from) + " to " + place(to) + " nohead " + look + "\n";
}

} // namespace gnomon::examples
