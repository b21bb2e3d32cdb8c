// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

namespace gnomon {

/// Room in memory that is used again and again: what is there from before stays as it is until it is written.
/// @return the first of `count` more than are used.
template <class Kept>
std::size_t grow(std::vector<Kept>& kept, std::size_t& used, std::size_t count) {
    const std::size_t first = used, wanted = used + count;
    if (kept.size() < wanted) kept.resize(wanted + wanted / 2);
    used = wanted;
    return first;
}

} // namespace gnomon
