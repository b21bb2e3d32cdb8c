// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon::metrics {

/// A picture of any type: one value a pixel.
///
/// Pixel (0, 0) is the lower left one, as in OpenGL. Its centre lies at (0.5, 0.5) px.
template <typename T>
struct Grid {
    int width = 0;        ///< Width, px.
    int height = 0;       ///< Height, px.
    std::vector<T> cells; ///< width * height values, row by row, the lowest row first.

    /// A grid without pixels.
    Grid() = default;
    /// A grid with `value` at every pixel.
    Grid(int w, int h, const T& value = T())
        : width(w), height(h), cells(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

    /// True if there is no pixel.
    bool empty() const { return cells.empty(); }
    /// True if (x, y) is a pixel of the grid.
    bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
    /// True if both grids have the same width and height.
    template <typename U>
    bool sameSize(const Grid<U>& other) const {
        return width == other.width && height == other.height;
    }
    /// The value at pixel (x, y), which the grid must hold.
    T& at(int x, int y) { return cells[index(x, y)]; }
    /// The value at pixel (x, y), which the grid must hold.
    const T& at(int x, int y) const { return cells[index(x, y)]; }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

/// A picture of numbers.
using Picture = Grid<double>;
/// A set of pixels: 1 in the set, 0 outside.
using Mask = Grid<unsigned char>;

/// Number of pixels in a set.
inline std::size_t count(const Mask& mask) {
    return mask.cells.size() - static_cast<std::size_t>(std::count(mask.cells.begin(), mask.cells.end(), 0));
}

} // namespace gnomon::metrics
