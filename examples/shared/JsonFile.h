// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace gnomon::examples {

/// Results as a file holds them, a value a line. Text from drivers and file names need not be UTF-8: what is not becomes U+FFFD.
std::string resultsText(const nlohmann::ordered_json& results);

/// Reads the results that a program wrote, by `read`.
/// @param name     that the program gives such files.
/// @param program  with its option.
/// @throws std::runtime_error, one sentence that begins with the file, if it is missing, no JSON, or `read` throws.
void readResultsFile(const std::string& file, const std::string& name, const std::string& program,
                     const std::function<void(const nlohmann::json&)>& read);

} // namespace gnomon::examples
