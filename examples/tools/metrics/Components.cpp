// SPDX-License-Identifier: MIT
#include <metrics/Components.h>

#include <utility>

namespace gnomon::metrics {
namespace {

using Places = std::vector<std::pair<int, int>>;

void visit(const Mask& mask, int x, int y, Components& result, Places& open) {
    if (!mask.holds(x, y) || !mask.at(x, y) || result.part.at(x, y) >= 0) return;
    result.part.at(x, y) = result.count;
    open.emplace_back(x, y);
}

/// Gives the part of (x, y) the next number.
void fill(const Mask& mask, int x, int y, Components& result) {
    Places open;
    visit(mask, x, y, result, open);
    while (!open.empty()) {
        const auto [cx, cy] = open.back();
        open.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) visit(mask, cx + dx, cy + dy, result, open);
    }
    ++result.count;
}

} // namespace

Components components(const Mask& mask) {
    Components result{Grid<int>(mask.width, mask.height, -1)};
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y) && result.part.at(x, y) < 0) fill(mask, x, y, result);
    return result;
}

} // namespace gnomon::metrics
