// SPDX-License-Identifier: MIT
#include <gnomon/ground/GroundSearch.h>
#include <gnomon/ground/HeightPyramid.h>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double rounding = 1e-9; // of what a cell rises by
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Floats that are not inside of the doubles they stand for.
float below(double value) { return std::nextafter(static_cast<float>(value), -infinite); }
float above(double value) { return std::nextafter(static_cast<float>(value), infinite); }

} // namespace

HeightPyramid::HeightPyramid(HeightField field) : _field(std::move(field)) {
    Level cells;
    cells.columns = _field.columns() - 1;
    cells.rows = _field.rows() - 1;
    cells.nodes.resize(std::size_t(cells.columns) * std::size_t(cells.rows));
    tbb::parallel_for(0, cells.rows, [&](int y) {
        for (int x = 0; x < cells.columns; ++x)
            cells.nodes[std::size_t(y) * std::size_t(cells.columns) + std::size_t(x)] = cell(x, y);
    });
    _levels.push_back(std::move(cells));
    while (_levels.back().columns > 1 || _levels.back().rows > 1)
        _levels.push_back(levelOver(_levels.back(), static_cast<int>(_levels.size())));
}

HeightPyramid::Level HeightPyramid::levelOver(const Level& lower, int level) const {
    Level result;
    result.columns = (lower.columns + 1) / 2;
    result.rows = (lower.rows + 1) / 2;
    result.nodes.resize(std::size_t(result.columns) * std::size_t(result.rows));
    tbb::parallel_for(0, result.rows, [&](int y) {
        for (int x = 0; x < result.columns; ++x)
            result.nodes[std::size_t(y) * std::size_t(result.columns) + std::size_t(x)] = merged({level, x, y});
    });
    return result;
}

bool HeightPyramid::Node::hasHoles() const { return std::signbit(slope); }
double HeightPyramid::Node::steepest() const { return std::abs(double(slope)); }

HeightPyramid::Node HeightPyramid::cell(int x, int y) const {
    Node result;
    if (_field.isHole(x, y)) {
        result.slope = -0.0f;
        return result;
    }
    const auto triangles = _field.triangles(x, y);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const GroundTriangle& triangle : triangles) {
        for (const glm::dvec3& corner : triangle) low = std::min(low, corner.z), high = std::max(high, corner.z);
        result.slope = std::max(result.slope, above(slopeOf(triangle)));
    }
    result.low = below(low);
    result.high = above(high);
    return result;
}

HeightPyramid::Node HeightPyramid::merged(const Block& block) const {
    const Level& lower = _levels[std::size_t(block.level) - 1];
    Node result;
    bool holes = false;
    for (int y = 2 * block.y; y < std::min(2 * block.y + 2, lower.rows); ++y)
        for (int x = 2 * block.x; x < std::min(2 * block.x + 2, lower.columns); ++x) {
            const Node& part = node({block.level - 1, x, y});
            holes = holes || part.hasHoles();
            if (part.isHole()) continue;
            const bool first = result.isHole();
            result.low = first ? part.low : std::min(result.low, part.low);
            result.high = first ? part.high : std::max(result.high, part.high);
            result.slope = std::max(result.slope, std::abs(part.slope));
        }
    if (holes) result.slope = -result.slope;
    return result;
}

GroundBox HeightPyramid::boxOf(const Block& block) const {
    const Node& it = node(block);
    const int right = std::min(block.column() + block.side(), _field.columns() - 1);
    const int top = std::min(block.row() + block.side(), _field.rows() - 1);
    glm::dvec3 low = _field.post(block.column(), block.row()), high = _field.post(right, top);
    low.z = double(it.low);
    high.z = double(it.high);
    return {low, high};
}

template <class Enter>
void HeightPyramid::descend(const Block& from, const Enter& enter) const {
    if (node(from).isHole() || !enter(from)) return;
    const Level& lower = _levels[std::size_t(from.level) - 1];
    for (int y = 2 * from.y; y < std::min(2 * from.y + 2, lower.rows); ++y)
        for (int x = 2 * from.x; x < std::min(2 * from.x + 2, lower.columns); ++x)
            descend({from.level - 1, x, y}, enter);
}

std::optional<glm::dvec3> HeightPyramid::hit(const glm::dvec3& start, const glm::dvec3& along) const {
    double nearest = std::numeric_limits<double>::infinity();
    descend(top(), [&](const Block& block) {
        const RaySpan span = spanInside(boxOf(block), start, along);
        if (span.from > span.to || span.from >= nearest) return false;
        if (block.level > 0) return true;
        for (const GroundTriangle& triangle : _field.triangles(block.x, block.y))
            nearest = std::min(nearest, meet(triangle, start, along).value_or(nearest));
        return false;
    });
    if (!std::isfinite(nearest)) return std::nullopt;
    return start + nearest * along;
}

/// Lowest and highest of a cell's part that a rectangle touches, or some more: its planes over that part's corners.
std::pair<double, double> HeightPyramid::heightsIn(int x, int y, const glm::dvec2& low, const glm::dvec2& high) const {
    const Node& cell = node({0, x, y});
    const glm::dvec2 corner(x, y), from = glm::clamp(_field.cellOf(low.x, low.y) - corner, 0.0, 1.0),
                                   to = glm::clamp(_field.cellOf(high.x, high.y) - corner, 0.0, 1.0);
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double u : {from.x, to.x})
        for (const double v : {from.y, to.y}) {
            const auto [one, other] = _field.planesOver(x, y, u, v);
            least = std::min({least, one, other});
            most = std::max({most, one, other});
        }
    const double slack = rounding * (most - least);
    return {std::max(double(cell.low), least - slack), std::min(double(cell.high), most + slack)};
}

std::optional<GroundRange> HeightPyramid::range(const glm::dvec2& low, const glm::dvec2& high) const {
    const glm::dvec2 from = glm::floor(_field.cellOf(low.x, low.y)), to = glm::floor(_field.cellOf(high.x, high.y)),
                     last(_levels[0].columns - 1, _levels[0].rows - 1);
    if (!(from.x <= last.x && from.y <= last.y && to.x >= 0.0 && to.y >= 0.0)) return std::nullopt;
    const glm::ivec2 first(glm::max(from, glm::dvec2(0.0))), end(glm::min(to, last));
    int level = 0;
    while ((end.x >> level) - (first.x >> level) > 3 || (end.y >> level) - (first.y >> level) > 3) ++level;
    std::optional<GroundRange> range;
    bool holes = false;
    for (int y = first.y >> level; y <= end.y >> level; ++y)
        for (int x = first.x >> level; x <= end.x >> level; ++x) {
            const Node& block = node({level, x, y});
            holes = holes || block.hasHoles();
            if (block.isHole()) continue;
            const auto [least, most] =
                level > 0 ? std::pair(double(block.low), double(block.high)) : heightsIn(x, y, low, high);
            if (!range) range = {least, most, 0.0};
            range = {std::min(range->low, least), std::max(range->high, most),
                     std::max(range->steepest, block.steepest())};
        }
    if (range) range->holes = holes;
    return range;
}

} // namespace gnomon
