// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/FlatBox.h>
#include <gnomon/mapfit/SeenEdges.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double grazing = 0.05; // cosine between a normal and the way to the light

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
    : _clipFromScene(clipFromScene), _sceneFromClip(glm::inverse(clipFromScene)), _within(within), _light(light) {
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            _cells.push_back(cellAt(glm::dvec2(column + 0.5, row + 0.5) / glm::dvec2(columns, rows)));
}

/// In the grid.
glm::dvec2 SeenEdges::pixelOf(const glm::dvec2& pixels) const { return 2.0 / (pixels * (_within.high - _within.low)); }

SeenEdges::Cell SeenEdges::cellAt(const glm::dvec2& inGrid) const {
    const auto at = [&](double depth) {
        const glm::dvec2 place = _within.low + inGrid * (_within.high - _within.low);
        const glm::dvec4 point = _sceneFromClip * glm::dvec4(place, depth, 1.0);
        return glm::dvec3(point) / point.w;
    };
    Cell cell;
    cell.at = inGrid;
    cell.from = at(-1.0);
    cell.way = at(0.0) - cell.from;
    return cell;
}

void SeenEdges::addReceiver(const Box& given, const glm::dmat4& sceneFromBox, Relief relief) {
    Box box = given;
    const auto flat = flatAxis(box.low, box.high, sceneFromBox);
    if (flat && relief == Relief::HalfWay) box.low[*flat] = box.high[*flat] = (box.low[*flat] + box.high[*flat]) / 2.0;
    const int first = std::exchange(_sides, _sides + 6);
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

void SeenEdges::addReceivers(const Meshes& meshes) {
    _firstOfMeshes = _sides;
    look(meshes, _cells);
}

/// What is nearer to the eye than what is known.
void SeenEdges::look(const Meshes& meshes, std::vector<Cell>& cells) const {
    std::vector<RayBins::Ray> rays;
    for (const Cell& cell : cells) rays.push_back({cell.from, cell.way, cell.at});
    const glm::dvec3 size(_within.high - _within.low, 1.0);
    const glm::dmat4 gridFromClip = glm::translate(glm::scale(glm::dmat4(1.0), 1.0 / size), {-_within.low, 0.0});
    const RayBins bins(gridFromClip * _clipFromScene, std::move(rays));
    int first = _firstOfMeshes;
    for (const PlacedTriangles& mesh : meshes) {
        bins.meet(mesh, [&](const RayBins::Met& met) {
            Cell& cell = cells[met.ray];
            if (!(met.reach > 0.0 && met.reach < cell.reach)) return;
            const auto part = std::upper_bound(mesh.parts.begin(), mesh.parts.end(), met.triangle);
            cell.reach = met.reach;
            cell.normal = glm::normalize(glm::dot(met.normal, cell.way) < 0.0 ? met.normal : -met.normal);
            cell.side = first + int(part - mesh.parts.begin()) - 1;
        });
        first += int(mesh.parts.size());
    }
}

/// Along a cell's line of sight, to the plane through what another one sees.
double SeenEdges::reachOf(const Cell& cell, const Cell& plane) {
    return glm::dot(plane.normal, plane.place().place - cell.from) / glm::dot(plane.normal, cell.way);
}

/// Of meshes, what the light hardly touches does not count: it shows no edges.
bool SeenEdges::faces(const Cell& cell) const {
    if (cell.side < 0) return false;
    const double least = isOfMesh(cell) ? grazing : 0.0;
    const glm::dvec3 way = glm::dvec3(_light) - _light.w * cell.place().place;
    return glm::dot(cell.normal, way) > least * glm::length(way);
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
                    if (cell->dark) continue;
                    const glm::dvec3 place = cell->place().place, way = glm::dvec3(_light) - _light.w * place;
                    const Passage passage = passageOf(box, place, way);
                    const bool before = _light.w == 0.0 || passage.in < 1.0;
                    if (passage.any() && before && passage.in * glm::length(way) > least) cell->dark = true;
                }
    }
}

void SeenEdges::darken(std::vector<Cell>& cells, const Meshes& meshes,
                       const std::vector<glm::dmat4>& mapsFromScene) const {
    for (const glm::dmat4& mapFromScene : mapsFromScene) {
        std::vector<RayBins::Ray> rays;
        for (const Cell& cell : cells) {
            const glm::dvec3 place = cell.place().place;
            const glm::dvec4 at = mapFromScene * glm::dvec4(place, 1.0);
            const glm::dvec2 in = faces(cell) && !cell.dark && at.w > 0.0 ? glm::dvec2(at) / at.w : glm::dvec2(-1.0);
            rays.push_back({place, glm::dvec3(_light) - _light.w * place, in});
        }
        const RayBins bins(mapFromScene, std::move(rays));
        for (const PlacedTriangles& mesh : meshes)
            bins.meet(mesh, [&](const RayBins::Met& met) {
                Cell& cell = cells[met.ray];
                const glm::dvec3 way = glm::dvec3(_light) - _light.w * cell.place().place;
                const bool before = _light.w == 0.0 || met.reach < 1.0;
                if (before && met.reach * glm::length(way) > cell.least()) cell.dark = true;
            });
    }
}

void SeenEdges::addCasters(const Meshes& meshes, const std::vector<glm::dmat4>& mapsFromScene,
                           const glm::dvec2& pixels) {
    darken(_cells, meshes, mapsFromScene);
    narrow(meshes, mapsFromScene, pixels);
}

/// Asks a quarter, a half and a whole pixel to the left and the right of what is between two edges, and below and above. Where
/// the whole pixel shows something else, the edge of a shadow cannot be told.
void SeenEdges::narrow(const Meshes& meshes, const std::vector<glm::dmat4>& mapsFromScene, const glm::dvec2& pixels) {
    constexpr std::array steps{0.25, 0.5, 1.0};    // pixels to either side
    constexpr std::size_t each = 2 * steps.size(); // along an axis
    const glm::dvec2 pixel = pixelOf(pixels);
    std::vector<Cell> beside;
    std::vector<Cell*> of;
    for (Cell& cell : _cells) {
        if (!isOfMesh(cell) || !isAlone(cell)) continue;
        of.push_back(&cell);
        for (int axis = 0; axis < 2; ++axis)
            for (const double step : steps)
                for (const double side : {-step, step}) {
                    glm::dvec2 at = cell.at;
                    at[axis] += side * pixel[axis];
                    beside.push_back(cellAt(at));
                }
    }
    look(meshes, beside);
    darken(beside, meshes, mapsFromScene);
    const auto alone = [&](std::size_t i, std::size_t pair) {
        const Cell *ends = &beside[2 * (i * each + pair)], &cell = *of[i];
        return faces(ends[0]) && faces(ends[1]) && ends[0].dark != cell.dark && ends[1].dark != cell.dark;
    };
    for (std::size_t i = 0; i < of.size(); ++i)
        for (std::size_t pair = 0; pair < each; ++pair)
            if (alone(i, pair)) of[i]->across = std::min(of[i]->across, 2.0 * steps[pair % steps.size()]);
    for (std::size_t i = 0; i < beside.size(); ++i) {
        Cell& cell = *of[i / (2 * each)];
        if (beside[i].isInGrid() && beside[i].side != cell.side) cell.left = true;
    }
    for (Cell& cell : _cells)
        if (cell.left) cell.side = -1;
    weighThin(pixel);
}

/// A thin shadow is met as seldom as pixels meet it: one cell stands for as many pixels as it has, each with an outline of its
/// own. If it is wider than half a pixel the true outline is as long. Other edges are met in proportion to their length.
void SeenEdges::weighThin(const glm::dvec2& pixel) {
    constexpr double half = 0.5, ofAPixel = 2.4; // pixels of outline, between a row of pixels and one alone
    constexpr double ofAnEdge = 3.14159265358979323846 / 4.0; // of the pitch, for each pair of cells, drawn and true
    const glm::dvec2 pitch = 1.0 / (pixel * glm::dvec2(columns, rows));
    double met = 0.0;
    for (const Cell& cell : _cells) met += isThin(cell) ? 1.0 : 0.0;
    const double sure = met > 0.0 ? std::max(0.0, 1.0 - 2.0 / std::sqrt(met)) : 0.0; // two deviations fewer
    std::vector<glm::dvec2> wide;                                                    // places of other edges, pixels
    for (const Cell& cell : _cells)
        if (!isThin(cell) && edgesBeside(cell) > 0) wide.push_back(cell.at / pixel);
    for (Cell& cell : _cells) {
        if (!isThin(cell)) continue;
        cell.apart = glm::length(1.0 / pixel); // of nothing else: as far as the grid reaches
        for (const glm::dvec2& edge : wide) cell.apart = std::min(cell.apart, glm::distance(edge, cell.at / pixel));
        const double outline = (cell.across > half ? 2.0 : 1.0) * ofAPixel * pitch.x * pitch.y;
        cell.share = sure * outline / (2.0 * ofAnEdge * std::sqrt(pitch.x * pitch.y)) / edgesBeside(cell);
    }
}

bool SeenEdges::isEdgeTo(const Cell& cell, int right, int up) const {
    const int index = int(&cell - _cells.data()), x = index % columns + right, y = index / columns + up;
    return x >= 0 && y >= 0 && x < columns && y < rows && isEdge(cell, at(x, y));
}

int SeenEdges::edgesBeside(const Cell& cell) const {
    return int(isEdgeTo(cell, 1, 0)) + int(isEdgeTo(cell, -1, 0)) + int(isEdgeTo(cell, 0, 1)) +
           int(isEdgeTo(cell, 0, -1));
}

/// True if there are edges on both sides.
bool SeenEdges::isAlone(const Cell& cell) const {
    return (isEdgeTo(cell, 1, 0) && isEdgeTo(cell, -1, 0)) || (isEdgeTo(cell, 0, 1) && isEdgeTo(cell, 0, -1));
}

/// As map.frag finds that what is beside a pixel bends away.
bool SeenEdges::bends(const Cell& one, const Cell& other) const {
    constexpr double much = 0.75, rounding = 1e-6;
    const auto slopeOf = [&](const Cell& cell) {
        const glm::dvec4 plane =
            glm::transpose(_sceneFromClip) * glm::dvec4(cell.normal, -glm::dot(cell.normal, cell.place().place));
        return glm::dvec2(plane) / plane.z;
    };
    const glm::dvec2 a = slopeOf(one), b = slopeOf(other);
    const glm::dvec2 most = much * glm::max(glm::abs(a), glm::abs(b)) + rounding;
    return glm::any(glm::greaterThan(glm::abs(a - b), most));
}

/// What is farther than a step along both surfaces is another part of the object.
bool SeenEdges::isEdge(const Cell& one, const Cell& other) const {
    if (one.side < 0 || one.side != other.side || one.dark == other.dark || !faces(one) || !faces(other)) return false;
    const glm::dvec3 here = one.place().place, there = other.place().place;
    const auto step = [](const Cell& cell, const Cell& beside) {
        return glm::distance(cell.place().place, beside.from + reachOf(beside, cell) * beside.way);
    };
    return glm::distance(here, there) <= step(one, other) + step(other, one);
}

std::vector<SeenPlace> SeenEdges::edges() const {
    std::vector<SeenPlace> result;
    const auto add = [&](int column, int row, int right, int up) {
        if (column + right >= columns || row + up >= rows) return;
        const Cell &one = at(column, row), &other = at(column + right, row + up);
        if (!isEdge(one, other)) return;
        const bool first = one.across < other.across;
        const Cell& thin = first ? one : other;
        const bool folded = bends(one, other);
        for (const int i : {0, 1}) {
            const SeenPlace place = (i == 0 ? one : other).place();
            const glm::dvec2 way = wayAt(column + i * right, row + i * up);
            result.push_back({place.place, place.normal, way, thin.across, thin.apart, thin.share, folded});
        }
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            add(column, row, 1, 0);
            add(column, row, 0, 1);
        }
    return result;
}

/// By the change of darkness from a cell to those about it on the same side, far enough to tell most slanted edges from level ones.
glm::dvec2 SeenEdges::wayAt(int column, int row) const {
    constexpr int far = 2;
    const Cell& here = at(column, row);
    glm::dvec2 change(0.0);
    for (int y = std::max(row - far, 0); y <= std::min(row + far, rows - 1); ++y)
        for (int x = std::max(column - far, 0); x <= std::min(column + far, columns - 1); ++x) {
            const Cell& other = at(x, y);
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
