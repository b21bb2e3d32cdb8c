// SPDX-License-Identifier: MIT
#include <gnomon/terrain/PlanCoverage.h>

#include <glm/common.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {

PlanCoverage::PlanCoverage(const std::vector<Rect>& rectangles) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    _all = {glm::dvec2(infinite), glm::dvec2(-infinite)};
    for (const Rect& each : rectangles) _all = {glm::min(_all.low, each.low), glm::max(_all.high, each.high)};
    std::array<unsigned char, side * side> touched{};
    for (const Rect& each : rectangles) {
        const Cells cells = cellsOf(each);
        for (int y = cells.fromY; y <= cells.toY; ++y)
            std::fill(touched.begin() + y * side + cells.fromX, touched.begin() + y * side + cells.toX + 1, 1);
    }
    for (std::size_t y = 1; y <= side; ++y)
        for (std::size_t x = 1; x <= side; ++x)
            _sums[y * (side + 1) + x] = touched[(y - 1) * side + x - 1] + _sums[y * (side + 1) + x - 1] +
                                        _sums[(y - 1) * (side + 1) + x] - _sums[(y - 1) * (side + 1) + x - 1];
}

PlanCoverage::Cells PlanCoverage::cellsOf(const Rect& rectangle) const {
    const glm::dvec2 cell = glm::max((_all.high - _all.low) / double(side), std::numeric_limits<double>::min());
    const auto place = [&](double at, int axis) {
        return static_cast<int>(std::clamp((at - _all.low[axis]) / cell[axis], 0.0, double(side - 1)));
    };
    return {place(rectangle.low.x, 0), place(rectangle.low.y, 1), place(rectangle.high.x, 0),
            place(rectangle.high.y, 1)};
}

bool PlanCoverage::touches(const Rect& rectangle) const {
    const bool beside = !(rectangle.low.x <= _all.high.x && _all.low.x <= rectangle.high.x &&
                          rectangle.low.y <= _all.high.y && _all.low.y <= rectangle.high.y);
    if (beside) return false;
    const Cells cells = cellsOf(rectangle);
    const auto sum = [this](int x, int y) { return _sums[static_cast<std::size_t>(y * (side + 1) + x)]; };
    return sum(cells.toX + 1, cells.toY + 1) + sum(cells.fromX, cells.fromY) !=
           sum(cells.fromX, cells.toY + 1) + sum(cells.toX + 1, cells.fromY);
}

} // namespace gnomon
