// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace gnomon::testing {

/// A page with the table of techniques' own words between each pair of marks:
///
///     <!-- settings NAME: made from the table of techniques -->
///     <!-- end -->
///
/// NAME is a technique, or "every technique" for the keys that all share.
/// @throws std::invalid_argument if it is neither, or the second mark is missing.
std::string withSettings(const std::string& page);

} // namespace gnomon::testing
