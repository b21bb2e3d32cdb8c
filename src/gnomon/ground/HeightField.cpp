// SPDX-License-Identifier: MIT
#include <gnomon/ground/HeightField.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gnomon {

HeightField::HeightField(int columns, int rows, const glm::dvec2& origin, const glm::dvec2& step,
                         std::vector<float> heights, double base, std::vector<CellCut> cuts)
    : _columns(columns),
      _rows(rows),
      _origin(origin),
      _step(step),
      _heights(std::move(heights)),
      _base(base),
      _cuts(std::move(cuts)) {
    if (columns < 2 || rows < 2) throw std::invalid_argument("a height field needs at least 2 posts along each side.");
    if (_heights.size() != std::size_t(columns) * std::size_t(rows))
        throw std::invalid_argument("a height field needs one height for each post.");
    if (!_cuts.empty() && _cuts.size() != std::size_t(columns - 1) * std::size_t(rows - 1))
        throw std::invalid_argument("a height field needs one cut for each cell, or none at all.");
    if (!(step.x > 0.0) || !(step.y > 0.0) || !std::isfinite(step.x + step.y + origin.x + origin.y + base))
        throw std::invalid_argument("a height field needs a finite step above 0 and a finite origin.");
}

bool HeightField::isHole(int x, int y) const {
    if (cut(x, y) == CellCut::hole) return true;
    const double sum = post(x, y).z + post(x + 1, y).z + post(x, y + 1).z + post(x + 1, y + 1).z;
    return !std::isfinite(sum);
}

std::array<GroundTriangle, 2> HeightField::triangles(int x, int y) const {
    const glm::dvec3 a = post(x, y), b = post(x + 1, y), c = post(x + 1, y + 1), d = post(x, y + 1);
    if (cut(x, y) == CellCut::falling) return {GroundTriangle{a, b, d}, GroundTriangle{b, c, d}};
    return {GroundTriangle{a, b, c}, GroundTriangle{a, c, d}};
}

std::optional<double> HeightField::height(double x, double y) const {
    const glm::dvec2 at = cellOf(x, y);
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x <= _columns - 1 && at.y <= _rows - 1)) return std::nullopt;
    const int i = std::min(static_cast<int>(at.x), _columns - 2), j = std::min(static_cast<int>(at.y), _rows - 2);
    if (isHole(i, j)) return std::nullopt;
    const double u = at.x - i, v = at.y - j;
    const double a = post(i, j).z, b = post(i + 1, j).z, c = post(i + 1, j + 1).z, d = post(i, j + 1).z;
    if (cut(i, j) == CellCut::falling)
        return u + v <= 1.0 ? a + u * (b - a) + v * (d - a) : c + (1.0 - u) * (d - c) + (1.0 - v) * (b - c);
    return u >= v ? a + u * (b - a) + v * (c - b) : a + v * (d - a) + u * (c - d);
}

} // namespace gnomon
