// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/FlatBox.h>
#include <gnomon/mapfit/SeenEdges.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace gnomon {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where a ray is in a box, in lengths of its way, and the axes of the sides that it passes.
struct Passage {
    double in = -infinity, out = infinity;
    int inAxis = 0, outAxis = 0;

    bool any() const { return in <= out && out > 0.0 && std::isfinite(out); }
};

Passage passageOf(const SeenEdges::Box& box, const glm::dvec3& from, const glm::dvec3& way) {
    Passage result;
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0) {
            if (from[axis] < box.low[axis] || from[axis] > box.high[axis]) result.in = infinity;
            continue;
        }
        double near = (box.low[axis] - from[axis]) / way[axis], far = (box.high[axis] - from[axis]) / way[axis];
        if (near > far) std::swap(near, far);
        if (near > result.in) result.in = near, result.inAxis = axis;
        if (far < result.out) result.out = far, result.outAxis = axis;
    }
    return result;
}

/// The cells of a row of them whose middle lies between two places.
std::pair<int, int> between(double low, double high, double from, double to, int count) {
    const double step = (to - from) / count;
    if (!(step > 0.0)) return {0, count};
    const double first = std::ceil((low - from) / step - 0.5), last = std::floor((high - from) / step - 0.5);
    return {int(std::clamp(first, 0.0, double(count))), int(std::clamp(last + 1.0, 0.0, double(count)))};
}

std::optional<ScreenRect> boundsOf(const SeenEdges::Box& box, const glm::dmat4& clipFromBox) {
    const auto corners = boxCorners(box.low, box.high, clipFromBox);
    return screenBounds({corners.begin(), corners.end()});
}

} // namespace

SeenEdges::SeenEdges(const glm::dmat4& clipFromScene, const ScreenRect& within, const glm::dvec4& light)
    : _clipFromScene(clipFromScene), _within(within), _light(light) {
    const glm::dmat4 sceneFromClip = glm::inverse(clipFromScene);
    const auto at = [&](const glm::dvec2& place, double depth) {
        const glm::dvec4 point = sceneFromClip * glm::dvec4(place, depth, 1.0);
        return glm::dvec3(point) / point.w;
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const glm::dvec2 share((column + 0.5) / columns, (row + 0.5) / rows);
            const glm::dvec2 place = within.low + share * (within.high - within.low);
            const glm::dvec3 near = at(place, -1.0);
            _cells.push_back({near, at(place, 0.0) - near});
        }
}

void SeenEdges::addReceiver(const Box& given, const glm::dmat4& sceneFromBox) {
    Box box = given;
    if (const auto flat = flatAxis(box.low, box.high, sceneFromBox))
        box.low[*flat] = box.high[*flat] = (box.low[*flat] + box.high[*flat]) / 2.0;
    const int first = 6 * _receivers++;
    const auto bounds = boundsOf(box, _clipFromScene * sceneFromBox);
    if (!bounds) return;
    const auto [left, right] = between(bounds->low.x, bounds->high.x, _within.low.x, _within.high.x, columns);
    const auto [bottom, top] = between(bounds->low.y, bounds->high.y, _within.low.y, _within.high.y, rows);
    if (left >= right || bottom >= top) return;
    const glm::dmat4 boxFromScene = glm::inverse(sceneFromBox);
    const glm::dmat3 turn(boxFromScene);
    for (int row = bottom; row < top; ++row)
        for (int column = left; column < right; ++column) {
            Cell& cell = _cells[std::size_t(row) * columns + column];
            const glm::dvec3 way = turn * cell.way;
            const Passage passage = passageOf(box, glm::dvec3(boxFromScene * glm::dvec4(cell.from, 1.0)), way);
            const bool outside = passage.in > 0.0;
            const double reach = outside ? passage.in : passage.out;
            if (!passage.any() || !(reach < cell.reach)) continue;
            const int axis = outside ? passage.inAxis : passage.outAxis;
            glm::dvec3 normal(0.0);
            normal[axis] = way[axis] < 0.0 ? 1.0 : -1.0;
            cell.reach = reach;
            cell.normal = glm::transpose(turn) * normal;
            cell.side = first + 2 * axis + (way[axis] < 0.0 ? 1 : 0);
        }
}

bool SeenEdges::faces(const Cell& cell) const {
    return cell.side >= 0 &&
           glm::dot(cell.normal, glm::dvec3(_light) - _light.w * (cell.from + cell.reach * cell.way)) > 0.0;
}

void SeenEdges::addCasters(const std::vector<Box>& boxes, const glm::dmat4& mapFromScene) {
    constexpr int bins = 32;
    constexpr double beside = 1e-6; // of a box's size: what is so close is at the box itself
    const glm::dmat4 clipFromMap = glm::scale(glm::translate(glm::dmat4(1.0), {-1.0, -1.0, 0.0}), {2.0, 2.0, 1.0});
    std::array<std::vector<Cell*>, bins * bins> binned;
    for (Cell& cell : _cells) {
        if (!faces(cell) || cell.dark) continue;
        const glm::dvec4 at = mapFromScene * glm::dvec4(cell.place().place, 1.0);
        if (!(at.w > 0.0 && at.x >= 0.0 && at.y >= 0.0 && at.x < at.w && at.y < at.w)) continue;
        binned[std::size_t(at.y / at.w * bins) * bins + std::size_t(at.x / at.w * bins)].push_back(&cell);
    }
    for (const Box& box : boxes) {
        const auto bounds = boundsOf(box, clipFromMap * mapFromScene);
        if (!bounds) continue;
        const auto bin = [&](double at) { return int(std::clamp((at + 1.0) / 2.0 * bins, 0.0, bins - 1.0)); };
        const double least = beside * glm::distance(box.low, box.high);
        for (int y = bin(bounds->low.y); y <= bin(bounds->high.y); ++y)
            for (int x = bin(bounds->low.x); x <= bin(bounds->high.x); ++x)
                for (Cell* cell : binned[std::size_t(y) * bins + x]) {
                    const glm::dvec3 place = cell->place().place, way = glm::dvec3(_light) - _light.w * place;
                    const Passage passage = passageOf(box, place, way);
                    const bool before = _light.w == 0.0 || passage.in < 1.0;
                    if (passage.any() && before && passage.in * glm::length(way) > least) cell->dark = true;
                }
    }
}

bool SeenEdges::isEdge(const Cell& one, const Cell& other) const {
    return one.side >= 0 && one.side == other.side && one.dark != other.dark;
}

std::vector<SeenPlace> SeenEdges::edges() const {
    std::vector<SeenPlace> result;
    const auto add = [&](int column, int row, int right, int up) {
        const Cell* cell = &_cells[std::size_t(row) * columns + column];
        if (column + right >= columns || row + up >= rows || !isEdge(*cell, cell[up * columns + right])) return;
        for (const int i : {0, 1}) {
            result.push_back(cell[i * (up * columns + right)].place());
            result.back().edge = wayAt(column + i * right, row + i * up);
        }
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            add(column, row, 1, 0);
            add(column, row, 0, 1);
        }
    return result;
}

/// By the change of darkness from a cell to those about it on the same side.
glm::dvec2 SeenEdges::wayAt(int column, int row) const {
    const Cell& here = _cells[std::size_t(row) * columns + column];
    glm::dvec2 change(0.0);
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y)
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, columns - 1); ++x) {
            const Cell& other = _cells[std::size_t(y) * columns + x];
            if (!isEdge(here, other)) continue;
            change += glm::dvec2(x - column, y - row) * (other.dark ? 1.0 : -1.0);
        }
    const glm::dvec2 cell = (_within.high - _within.low) / glm::dvec2(columns, rows);
    return {-change.y * cell.x, change.x * cell.y};
}

std::vector<SeenPlace> SeenEdges::facing() const {
    std::vector<SeenPlace> result;
    for (const Cell& cell : _cells)
        if (faces(cell)) result.push_back(cell.place());
    return result;
}

} // namespace gnomon
