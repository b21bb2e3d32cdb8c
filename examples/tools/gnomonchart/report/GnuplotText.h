// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace gnomon::examples {

/// A number of six digits, as gnuplot reads it.
std::string plotNumber(double value);

/// A number for people: two digits below 10, "0.42", whole from there on, "160".
std::string shortNumber(double value);

/// A text as gnuplot takes it literally: in single quotes, without control characters.
std::string plotText(const std::string& text);
/// The same for a comment.
std::string plotComment(const std::string& text);

/// "#rrggbb" as a number in data.
std::string plotColour(const char* colour);

/// Marks of an axis, each with its number.
std::string plotTics(const std::vector<double>& values);

/// How a text on the page looks.
struct TextLook {
    double size = 11.0; ///< px
    const char* colour = "#374151";
    bool bold = false;
};

/// px; an estimate, rather too wide, by DejaVu Sans.
glm::dvec2 textSize(const std::string& text, const TextLook& look);

/// The command for a text whose left end is at a place on the page, px; vertically its middle.
/// @param more  gnuplot's further options.
std::string textCommand(const std::string& text, const glm::dvec2& at, const TextLook& look,
                        const std::string& more = "");
std::string lineCommand(const glm::dvec2& from, const glm::dvec2& to, const std::string& look);

} // namespace gnomon::examples
