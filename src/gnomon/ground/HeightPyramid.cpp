// SPDX-License-Identifier: MIT
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/ground/TurnedAwaySearch.h>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double rounding = 1e-15; // of the terms of a sum of four products of doubles
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Floats that are not inside of the doubles they stand for.
float below(double value) { return std::nextafter(static_cast<float>(value), -infinite); }
float above(double value) { return std::nextafter(static_cast<float>(value), infinite); }

/// As mayHold(). @param inside  planes that hold all of the box are added, those that it has are not asked.
bool holdsSome(const GroundBox& box, const std::vector<glm::dvec4>& planes, PlaneSet& inside) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const bool isKnown = i < 64;
        if (isKnown && inside >> i & 1u) continue;
        const glm::dvec4& p = planes[i];
        const double x = p.x * middle.x, y = p.y * middle.y, z = p.z * middle.z, at = x + y + z + p.w;
        const double reach = std::abs(p.x) * half.x + std::abs(p.y) * half.y + std::abs(p.z) * half.z;
        const double slack = rounding * (std::abs(x) + std::abs(y) + std::abs(z) + std::abs(p.w));
        if (!(at + reach >= -slack)) return false;
        if (isKnown && at - reach > slack) inside |= PlaneSet(1) << i;
    }
    return true;
}

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
    result.off = holes ? infinite : off(block);
    if (holes) result.slope = -result.slope;
    return result;
}

/// At the posts: the block's diagonal runs along those of its rising cells, so that both are linear in between. Falling
/// cells have their own in the middle.
float HeightPyramid::off(const Block& block) const {
    const int left = block.column(), low = block.row(), side = block.side();
    if (left + side >= _field.columns() || low + side >= _field.rows()) return infinite;
    const double a = _field.post(left, low).z, b = _field.post(left + side, low).z,
                 c = _field.post(left + side, low + side).z, d = _field.post(left, low + side).z;
    double most = 0.0;
    const auto compare = [&](double x, double y, double height) {
        const double u = x / side, v = y / side;
        const double flat = u >= v ? a + u * (b - a) + v * (c - b) : a + v * (d - a) + u * (c - d);
        most = std::max(most, std::abs(flat - height));
    };
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) compare(x, y, _field.post(left + x, low + y).z);
    for (int y = 0; y < side && !_field.allRising(); ++y)
        for (int x = 0; x < side; ++x)
            if (_field.cut(left + x, low + y) == CellCut::falling)
                compare(x + 0.5, y + 0.5,
                        (_field.post(left + x + 1, low + y).z + _field.post(left + x, low + y + 1).z) / 2);
    return most > 0.0 ? above(most) : 0.0f; // what is level stays exact
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
    if (node(from).isHole() || !enter(from) || from.level == 0) return;
    const Level& lower = _levels[std::size_t(from.level) - 1];
    for (int y = 2 * from.y; y < std::min(2 * from.y + 2, lower.rows); ++y)
        for (int x = 2 * from.x; x < std::min(2 * from.x + 2, lower.columns); ++x)
            descend({from.level - 1, x, y}, enter);
}

template <class Enter>
void HeightPyramid::descend(const Enter& enter) const {
    descend(top(), enter);
}

template <class Enter>
void HeightPyramid::descendWithin(const Block& from, const std::vector<glm::dvec4>& planes, PlaneSet inside,
                                  const Enter& enter) const {
    if (node(from).isHole() || !holdsSome(boxOf(from), planes, inside) || !enter(from, inside) || from.level == 0)
        return;
    const Level& lower = _levels[std::size_t(from.level) - 1];
    for (int y = 2 * from.y; y < std::min(2 * from.y + 2, lower.rows); ++y)
        for (int x = 2 * from.x; x < std::min(2 * from.x + 2, lower.columns); ++x)
            descendWithin({from.level - 1, x, y}, planes, inside, enter);
}

void HeightPyramid::cover(const std::vector<glm::dvec4>& planes, double error,
                          const std::function<void(const GroundTriangle&, PlaneSet)>& take) const {
    descendWithin(top(), planes, 0, [&](const Block& block, PlaneSet inside) {
        if (block.level > 0 && !(double(node(block).off) <= error)) return true;
        for (const GroundTriangle& triangle : _field.triangles(block.column(), block.row(), block.side()))
            take(triangle, inside);
        return false;
    });
}

double HeightPyramid::hitInCell(int x, int y, const glm::dvec3& start, const glm::dvec3& along) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const GroundTriangle& triangle : _field.triangles(x, y))
        nearest = std::min(nearest, meet(triangle, start, along).value_or(nearest));
    return nearest;
}

/// @param low,high  heights of the ray over these cells.
double HeightPyramid::hitAmong(const Cells& cells, double low, double high, const glm::dvec3& start,
                               const glm::dvec3& along) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int y = cells.low; y <= cells.high; ++y)
        for (int x = cells.left; x <= cells.right; ++x) {
            const Node& cell = node({0, x, y});
            if (cell.isHole() || low > double(cell.high) || high < double(cell.low)) continue;
            nearest = std::min(nearest, hitInCell(x, y, start, along));
        }
    return nearest;
}

/// Column by column of cells, across the axis along which it goes farther; of each column the few that it passes.
double HeightPyramid::hitBeside(const glm::dvec3& start, const glm::dvec3& along) const {
    constexpr int mostColumns = 64; // of what goes farther blocks of cells are left out at once
    constexpr double slack = 1e-6;  // of a cell
    const glm::dvec2 pace = glm::dvec2(along) / _field.step(), from = _field.cellOf(start.x, start.y);
    const int axis = std::abs(pace.x) >= std::abs(pace.y) ? 0 : 1, way = pace[axis] < 0.0 ? -1 : 1;
    const bool isUpright = !(std::abs(pace[axis]) > 1e-100); // or as good as that
    double nearest = std::numeric_limits<double>::infinity(), in = 0.0;
    if (!cells(from, from)) return nearest;
    double column = std::floor(from[axis]);
    for (int i = 0; i < mostColumns && in <= nearest; ++i, column += way) {
        const double out = isUpright ? 0.0 : std::max(0.0, (column + (way > 0) - from[axis]) / pace[axis]);
        glm::dvec2 low = glm::min(from + in * pace, from + out * pace) - slack,
                   high = glm::max(from + in * pace, from + out * pace) + slack;
        low[axis] = high[axis] = column;
        const auto passed = cells(low, high);
        if (!passed) break;
        const double z = start.z + in * along.z,
                     end = isUpright ? std::copysign(infinite, along.z) : start.z + out * along.z;
        nearest = std::min(nearest, hitAmong(*passed, std::min(z, end), std::max(z, end), start, along));
        if (isUpright) break;
        in = out;
    }
    return nearest;
}

double HeightPyramid::hitAnywhere(const glm::dvec3& start, const glm::dvec3& along) const {
    double nearest = std::numeric_limits<double>::infinity();
    descend([&](const Block& block) {
        const RaySpan span = spanInside(boxOf(block), start, along);
        if (span.from > span.to || span.from >= nearest) return false;
        if (block.level == 0) nearest = std::min(nearest, hitInCell(block.x, block.y, start, along));
        return true;
    });
    return nearest;
}

std::optional<glm::dvec3> HeightPyramid::hit(const glm::dvec3& start, const glm::dvec3& along) const {
    double nearest = hitBeside(start, along);
    if (!std::isfinite(nearest)) nearest = hitAnywhere(start, along);
    if (!std::isfinite(nearest)) return std::nullopt;
    return start + nearest * along;
}

double HeightPyramid::steepest(const std::vector<glm::dvec4>& planes) const {
    double most = 0.0;
    descendWithin(top(), planes, 0, [&](const Block& block, PlaneSet) {
        if (node(block).steepest() <= most) return false;
        if (block.level == 0) most = node(block).steepest();
        return true;
    });
    return most;
}

TurnedAway HeightPyramid::turnedAway(const glm::dvec4& light) const {
    TurnedAwaySearch search(light);
    descend([&](const Block& block) {
        if (!search.enter(boxOf(block), node(block).steepest())) return false;
        if (block.level > 0) return true;
        for (const GroundTriangle& triangle : _field.triangles(block.x, block.y)) search.take(triangle);
        return false;
    });
    return search.result();
}

std::optional<HeightPyramid::Cells> HeightPyramid::cells(const glm::dvec2& low, const glm::dvec2& high) const {
    const glm::dvec2 from = glm::floor(low), to = glm::floor(high);
    const glm::dvec2 last(_levels[0].columns - 1, _levels[0].rows - 1);
    if (!(from.x <= last.x && from.y <= last.y && to.x >= 0.0 && to.y >= 0.0)) return std::nullopt;
    const glm::ivec2 first(glm::max(from, glm::dvec2(0.0))), end(glm::min(to, last));
    return Cells{first.x, first.y, end.x, end.y};
}

double HeightPyramid::steepest(const Cells& cells) const {
    double most = 0.0;
    for (int y = cells.low; y <= cells.high; ++y)
        for (int x = cells.left; x <= cells.right; ++x) most = std::max(most, node({0, x, y}).steepest());
    return most;
}

GroundRange HeightPyramid::range() const {
    const Node& all = _levels.back().nodes.front();
    return {double(all.low), double(all.high), all.steepest(), all.hasHoles()};
}

std::optional<GroundRange> HeightPyramid::range(const glm::dvec2& low, const glm::dvec2& high) const {
    const auto touched = cells(_field.cellOf(low.x, low.y), _field.cellOf(high.x, high.y));
    if (!touched) return std::nullopt;
    const glm::ivec2 first(touched->left, touched->low), end(touched->right, touched->high);
    int level = 0;
    while ((end.x >> level) - (first.x >> level) > 3 || (end.y >> level) - (first.y >> level) > 3) ++level;
    std::optional<GroundRange> range;
    bool holes = false;
    for (int y = first.y >> level; y <= end.y >> level; ++y)
        for (int x = first.x >> level; x <= end.x >> level; ++x) {
            const Node& block = node({level, x, y});
            holes = holes || block.hasHoles();
            if (block.isHole()) continue;
            if (!range) range = {double(block.low), double(block.high), 0.0};
            range = {std::min(range->low, double(block.low)), std::max(range->high, double(block.high)),
                     std::max(range->steepest, block.steepest())};
        }
    if (range) range->holes = holes;
    return range;
}

double HeightPyramid::steepest() const {
    const Node& all = _levels.back().nodes.front();
    return all.hasHoles() ? std::numeric_limits<double>::infinity() : all.steepest();
}

bool HeightPyramid::isGentle(const glm::dvec2& low, const glm::dvec2& high, double tangent) const {
    const auto touched = cells(low, high);
    if (!touched) return false;
    const glm::ivec2 from(touched->left, touched->low), to(touched->right, touched->high);
    int level = 0;
    const auto isWide = [&](int axis) { return (to[axis] >> level) - (from[axis] >> level) > 1; };
    while (isWide(0) || isWide(1)) ++level;
    for (int y = from.y >> level; y <= to.y >> level; ++y)
        for (int x = from.x >> level; x <= to.x >> level; ++x)
            if (!isGentle({level, x, y}, from, to, tangent)) return false;
    return true;
}

bool HeightPyramid::isGentle(const Block& from, const glm::ivec2& low, const glm::ivec2& high, double tangent) const {
    if (!node(from).hasHoles() && node(from).steepest() < tangent) return true;
    if (from.level == 0) return false;
    const int level = from.level - 1;
    for (int y = std::max(2 * from.y, low.y >> level); y <= std::min(2 * from.y + 1, high.y >> level); ++y)
        for (int x = std::max(2 * from.x, low.x >> level); x <= std::min(2 * from.x + 1, high.x >> level); ++x)
            if (!isGentle({level, x, y}, low, high, tangent)) return false;
    return true;
}

} // namespace gnomon
