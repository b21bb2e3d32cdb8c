// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

namespace gnomon::metrics {

/// One value a pixel. Pixel (0, 0) is the lower left one, as in OpenGL; its centre lies at (0.5, 0.5) px.
template <typename T>
struct Grid {
    int width = 0, height = 0; ///< px
    std::vector<T> cells;      ///< width * height of them, row after row, the lowest first.

    Grid() = default;
    Grid(int w, int h, const T& value = T())
        : width(w), height(h), cells(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

    bool empty() const { return cells.empty(); }
    bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
    template <typename U>
    bool sameSize(const Grid<U>& other) const {
        return width == other.width && height == other.height;
    }
    T& at(int x, int y) { return cells[index(x, y)]; }
    const T& at(int x, int y) const { return cells[index(x, y)]; }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

using Picture = Grid<double>;
using Mask = Grid<unsigned char>; ///< 1 in the set, 0 outside.

/// Pixels in the set.
std::size_t count(const Mask& mask);

} // namespace gnomon::metrics
