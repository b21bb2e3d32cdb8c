// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

namespace gnomon::examples {

/// A field of a CSV file: in quotes if it holds a comma, a quote or the end of a line. As RFC 4180 has it.
std::string csvField(const std::string& text);

/// Texts one after the other, with `between` between them.
std::string joined(const std::vector<std::string>& texts, const char* between);

} // namespace gnomon::examples
