// SPDX-License-Identifier: MIT
#pragma once

#include "order.h"

namespace tbb {

template <typename Container, typename Body>
void toldParallelForEach(Container& container, const Body& body) {
    told::Order order;
    parallel_for_each(container, order.task(body));
    order.wait();
}

} // namespace tbb

#define parallel_for_each toldParallelForEach
