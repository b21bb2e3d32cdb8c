// SPDX-License-Identifier: MIT
#include <gnomon/drape/GridCut.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr unsigned none = ~0u;

/// Of the plane of one of a cell's triangles: at the cell's lower left corner, change along x, change along y.
glm::dvec3 heightsOf(const HeightField& field, int x, int y, bool falls, bool isLower) {
    const double a = field.post(x, y).z, b = field.post(x + 1, y).z, c = field.post(x + 1, y + 1).z,
                 d = field.post(x, y + 1).z;
    if (falls) return isLower ? glm::dvec3(a, b - a, d - a) : glm::dvec3(b + d - c, c - d, c - b);
    return isLower ? glm::dvec3(a, b - a, c - b) : glm::dvec3(a, c - d, d - a);
}

} // namespace

const DrapeMesh& GridCut::cut(const HeightField& field, const std::vector<glm::dvec3>& polygon) {
    _field = &field;
    _places.clear();
    _numbers.clear();
    _mesh.corners.clear();
    _mesh.indices.clear();
    _polygon.clear();
    for (const glm::dvec3& corner : polygon) _polygon.push_back(add(field.cellOf(corner.x, corner.y)));
    slice(_polygon, 0, field.columns() - 1, _column, [&](Polygon& column, int x) {
        slice(column, 1, field.rows() - 1, _cell, [&](const Polygon& cell, int y) { cutCell(cell, x, y); });
    });
    return _mesh;
}

unsigned GridCut::add(const glm::dvec2& place) {
    _places.push_back(place);
    _numbers.push_back(none);
    return unsigned(_places.size() - 1);
}

/// Takes what is between two lines of the grid after the other. @param low  memory for it.
template <class Take>
void GridCut::slice(Polygon& polygon, int axis, int cells, Polygon& low, const Take& take) {
    double from = std::numeric_limits<double>::infinity(), to = -from;
    for (const unsigned corner : polygon) {
        from = std::min(from, _places[corner][axis]);
        to = std::max(to, _places[corner][axis]);
    }
    const int last = int(std::clamp(std::ceil(to) - 1.0, 0.0, cells - 1.0));
    int at = int(std::clamp(std::floor(from), 0.0, double(last)));
    for (; at < last; ++at) {
        const double line = at + 1.0;
        split(
            polygon, low, _high, [&](const glm::dvec2& place) { return place[axis] - line; },
            [&](unsigned below, unsigned above) { return onLine(below, above, axis, line); });
        polygon.swap(_high);
        if (low.size() > 2) take(low, at);
    }
    if (polygon.size() > 2) take(polygon, last);
}

/// Both sides of a line. @param side  of a place: below 0 it is low. @param meet  number of the line's corner between two.
template <class Side, class Meet>
void GridCut::split(const Polygon& polygon, Polygon& low, Polygon& high, const Side& side, const Meet& meet) {
    low.clear();
    high.clear();
    _sides.clear();
    for (const unsigned corner : polygon) _sides.push_back(side(_places[corner]));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = i + 1 < polygon.size() ? i + 1 : 0;
        if (_sides[i] <= 0.0) low.push_back(polygon[i]);
        if (_sides[i] >= 0.0) high.push_back(polygon[i]);
        if (!(_sides[i] * _sides[next] < 0.0)) continue;
        const unsigned corner = _sides[i] < 0.0 ? meet(polygon[i], polygon[next]) : meet(polygon[next], polygon[i]);
        low.push_back(corner);
        high.push_back(corner);
    }
}

/// A corner on one of the grid's lines; if it is a post, the columns on both sides find the same one.
unsigned GridCut::onLine(unsigned low, unsigned high, int axis, double at) {
    const glm::dvec2 a = _places[low], b = _places[high];
    glm::dvec2 place = glm::mix(a, b, (at - a[axis]) / (b[axis] - a[axis]));
    place[axis] = at;
    if (a[1 - axis] == b[1 - axis]) {
        place[1 - axis] = a[1 - axis];
        const auto same = std::find(_places.begin(), _places.end(), place);
        if (same != _places.end()) return unsigned(same - _places.begin());
    }
    return add(place);
}

void GridCut::cutCell(const Polygon& polygon, int x, int y) {
    if (_field->isHole(x, y)) return;
    const bool falls = _field->cut(x, y) == CellCut::falling;
    const glm::dvec2 corner(x, y);
    const auto side = [&](const glm::dvec2& place) {
        const glm::dvec2 in = place - corner;
        return falls ? in.x + in.y - 1.0 : in.y - in.x;
    };
    split(polygon, _low, _high, side, [&](unsigned low, unsigned high) {
        const double below = side(_places[low]), above = side(_places[high]);
        return add(glm::mix(_places[low], _places[high], below / (below - above)));
    });
    take(_low, x, y, heightsOf(*_field, x, y, falls, true));
    take(_high, x, y, heightsOf(*_field, x, y, falls, false));
}

/// A piece on one triangle. Corners that it shares with others have been met, or have the same height there.
void GridCut::take(const Polygon& polygon, int x, int y, const glm::dvec3& heights) {
    if (polygon.size() < 3) return;
    for (const unsigned corner : polygon) {
        if (_numbers[corner] != none) continue;
        const glm::dvec2 at = _places[corner], in = at - glm::dvec2(x, y);
        _numbers[corner] = unsigned(_mesh.corners.size());
        _mesh.corners.emplace_back(_field->origin() + at * _field->step(),
                                   heights.x + heights.y * in.x + heights.z * in.y);
    }
    for (std::size_t i = 2; i < polygon.size(); ++i)
        for (const unsigned corner : {polygon[0], polygon[i - 1], polygon[i]})
            _mesh.indices.push_back(_numbers[corner]);
}

} // namespace gnomon
