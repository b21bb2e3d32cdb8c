// SPDX-License-Identifier: MIT
#pragma once
#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace gnomon {

/// Rectangle in normalised device coordinates, each within [-1, 1].
struct ScreenRect {
    glm::dvec2 low;  ///< Left and bottom.
    glm::dvec2 high; ///< Right and top.
};
/// All of the viewport.
constexpr ScreenRect wholeScreen{{-1.0, -1.0}, {1.0, 1.0}};

/// The smallest rectangle that holds both.
inline ScreenRect united(const ScreenRect& a, const ScreenRect& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}
/// True of what common() gives where nothing lies in both.
inline bool isEmpty(const ScreenRect& rect) { return !(rect.low.x <= rect.high.x && rect.low.y <= rect.high.y); }
/// What lies in both.
inline ScreenRect common(const ScreenRect& a, const ScreenRect& b) {
    return {glm::max(a.low, b.low), glm::min(a.high, b.high)};
}
/// True if the two touch, be it in a point. False if one of them is empty.
inline bool overlap(const ScreenRect& a, const ScreenRect& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

} // namespace gnomon
