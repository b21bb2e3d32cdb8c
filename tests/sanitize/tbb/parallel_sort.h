// SPDX-License-Identifier: MIT
#pragma once

#include "order.h"

#include <algorithm>

namespace tbb {

/// Its tasks hand elements on in an order that only oneTBB's library knows, and move them once more after the last comparison.
/// One thread sorts here.
template <typename Iterator, typename Less>
void toldParallelSort(Iterator first, Iterator last, const Less& less) {
    std::sort(first, last, less);
}

} // namespace tbb

#define parallel_sort toldParallelSort
