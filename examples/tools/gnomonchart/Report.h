// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace gnomon::examples {

/// Draws the figures and the page of the results in a folder, and prints what they say: report.py does.
///
/// Needs   python3 with matplotlib and jinja2, when it is called.
/// @throws std::runtime_error, one sentence, if Python cannot be started or the report fails; it has said why then.
void writeReport(const std::string& folder);

} // namespace gnomon::examples
