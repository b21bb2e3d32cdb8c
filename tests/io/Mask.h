// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <vector>

namespace gnomon::testing {

/// Pixels of a picture, row by row.
using Mask = std::vector<bool>;

inline int count(const Mask& mask) { return static_cast<int>(std::count(mask.begin(), mask.end(), true)); }

/// Pixels of `a` that are not in `b`.
inline int beyond(const Mask& a, const Mask& b) {
    int result = 0;
    for (std::size_t i = 0; i < a.size(); ++i) result += a[i] && !b[i];
    return result;
}

} // namespace gnomon::testing
