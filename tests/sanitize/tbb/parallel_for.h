// SPDX-License-Identifier: MIT
#pragma once

#include "order.h"

namespace tbb {

template <typename Index, typename Body>
void toldParallelFor(Index first, Index last, const Body& body) {
    told::Order order;
    parallel_for(first, last, order.task(body));
    order.wait();
}

template <typename Range, typename Body>
void toldParallelFor(const Range& range, const Body& body) {
    told::Order order;
    parallel_for(range, order.task(body));
    order.wait();
}

} // namespace tbb

#define parallel_for toldParallelFor
