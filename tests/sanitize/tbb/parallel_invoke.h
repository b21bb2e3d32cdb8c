// SPDX-License-Identifier: MIT
#pragma once

#include "order.h"

namespace tbb {

template <typename First, typename Second>
void toldParallelInvoke(const First& first, const Second& second) {
    told::Order order;
    parallel_invoke(order.task(first), order.task(second));
    order.wait();
}

} // namespace tbb

#define parallel_invoke toldParallelInvoke
