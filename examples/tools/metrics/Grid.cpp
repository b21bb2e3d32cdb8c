// SPDX-License-Identifier: MIT
#include <metrics/Grid.h>

#include <algorithm>

namespace gnomon::metrics {

std::size_t count(const Mask& mask) {
    const auto in = std::count_if(mask.cells.begin(), mask.cells.end(), [](unsigned char cell) { return cell != 0; });
    return static_cast<std::size_t>(in);
}

} // namespace gnomon::metrics
