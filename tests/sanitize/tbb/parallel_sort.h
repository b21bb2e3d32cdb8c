// SPDX-License-Identifier: MIT
#pragma once

#include "order.h"

namespace tbb {

/// Its tasks follow one another, too: they hand elements on.
template <typename Iterator, typename Less>
void toldParallelSort(Iterator first, Iterator last, const Less& less) {
    told::Order order;
    parallel_sort(first, last, [&](const auto& a, const auto& b) {
        __tsan_acquire(&order.begun);
        const bool answer = less(a, b);
        __tsan_release(&order.begun);
        return answer;
    });
    __tsan_acquire(&order.begun);
}

} // namespace tbb

#define parallel_sort toldParallelSort
