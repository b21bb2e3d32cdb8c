// SPDX-License-Identifier: MIT
#include "CurveStyles.h"

#include <algorithm>
#include <array>

namespace gnomon::examples {
namespace {

constexpr std::array shapes = {6, 4, 8, 12, 10, 14}; // circle, square, triangle, diamond, triangle down, pentagon
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c510a"};
constexpr std::array greys = {"#6b7280", "#9aa1ad"};

} // namespace

CurveStyles::CurveStyles(const ChartResults& results) {
    for (const ChartPoint& point : results.points) {
        auto& names = point.ours() ? _ours : _theirs;
        const std::pair name(point.kit, point.technique);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
}

CurveStyle CurveStyles::of(const std::string& kit, const std::string& technique) const {
    const bool ours = kit == ourKit;
    const auto& names = ours ? _ours : _theirs;
    const auto found = std::find(names.begin(), names.end(), std::pair(kit, technique));
    const auto number = static_cast<std::size_t>(found - names.begin());
    const char* colour = ours ? colours[number % colours.size()] : greys[number / shapes.size() % greys.size()];
    return {colour, shapes[number % shapes.size()]};
}

} // namespace gnomon::examples
