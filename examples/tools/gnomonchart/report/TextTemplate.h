// SPDX-License-Identifier: MIT
#pragma once
#include <map>
#include <string>

namespace gnomon::examples {

/// A text with each ${NAME} replaced by its value, in one pass: values may hold "${" themselves.
/// @throws std::logic_error for a name without a value.
std::string fillTemplate(const std::string& text, const std::map<std::string, std::string>& values);

} // namespace gnomon::examples
