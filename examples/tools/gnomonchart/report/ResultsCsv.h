// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

namespace gnomon::examples {

/// One line a point, by RFC 4180: names in the first line with their units, lines end in CR LF, UTF-8. A number that
/// does not exist is empty; numbers are the shortest that read back the same; NaN, Infinity and -Infinity are words.
/// Settings and notes are joined by "; ".
std::string csvOf(const ChartResults& results);

} // namespace gnomon::examples
