// SPDX-License-Identifier: MIT
#include <gnomon/geometry/Across.h>
#include <gnomon/mapfit/SeenEdges.h>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <climits>
#include <cmath>
#include <utility>

namespace gnomon {
namespace {

constexpr double ofPicture = 1e-9; // what is rounded away there
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double grazing = 0.05; // cosine between a normal and the way to the light
constexpr int directions = 6;    // of edges, over half a turn
constexpr double halfTurn = 3.14159265358979323846;

/// Change of x/w and y/w along two ways on a surface.
glm::dmat2 slopeOf(const glm::dmat4& matrix, const glm::dvec4& at, const glm::dvec3& u, const glm::dvec3& v) {
    const auto along = [&](const glm::dvec3& way) {
        const glm::dvec4 change = matrix * glm::dvec4(way, 0.0);
        return (glm::dvec2(change) - glm::dvec2(at) / at.w * change.w) / at.w;
    };
    return {along(u), along(v)};
}

/// The longer side of a pixel, squared, in the map.
double longest(const glm::dmat2& mapFromPicture) {
    return std::max(glm::dot(mapFromPicture[0], mapFromPicture[0]), glm::dot(mapFromPicture[1], mapFromPicture[1]));
}

/// Of a way in pixels.
double riseOf(const glm::dvec2& way) {
    const glm::dvec2 along = glm::abs(way);
    return std::min(along.x, along.y) / std::max(along.x, along.y);
}

double sampledBy(double rise) {
    constexpr double bent = 1.08; // to straight ones: on the tuning scenes of gnomonchart
    return std::min(bent * sampledEdgeOf(rise), 0.5);
}

/// Lengths on a map's sides for one of the scene, across the way to the light.
double mapAUnit(const glm::dmat4& mapFromScene, const glm::dvec3& place, const glm::dvec3& way) {
    const auto [u, v] = across(glm::normalize(way));
    return std::sqrt(std::abs(glm::determinant(slopeOf(mapFromScene, mapFromScene * glm::dvec4(place, 1.0), u, v))));
}

/// How depth changes along a map's sides on a plane.
glm::dvec2 slopeIn(const glm::dmat4& sceneFromMap, const glm::dvec3& normal, const glm::dvec3& place) {
    const glm::dvec4 plane = glm::transpose(sceneFromMap) * glm::dvec4(normal, -glm::dot(normal, place));
    return glm::abs(glm::dvec2(plane) / plane.z);
}

/// How far off what is so wide is among places so far apart: it is lost, or drawn as wide as they are apart.
double lostWidth(double across, double apart) { return across < apart ? apart : 0.0; }

} // namespace

RayBins::RayBins(const glm::dmat4& pictureFromScene, std::vector<Ray> rays)
    : _pictureFromScene(pictureFromScene),
      _clipFromScene(glm::scale(glm::translate(glm::dmat4(1.0), {-1.0, -1.0, 0.0}), {2.0, 2.0, 1.0}) *
                     pictureFromScene),
      _rays(std::move(rays)),
      _bins(side * side) {
    for (std::size_t i = 0; i < _rays.size(); ++i) {
        const glm::dvec2& at = _rays[i].at;
        if (at.x >= 0.0 && at.y >= 0.0 && at.x < 1.0 && at.y < 1.0)
            _bins[std::size_t(binOf(at.y) * side + binOf(at.x))].push_back(i);
    }
}

int RayBins::binOf(double at) { return int(std::clamp(at * side, 0.0, side - 1.0)); }

template <class Visit>
void RayBins::eachIn(const ScreenRect& rect, const Visit& visit) const {
    if (!(rect.high.x >= 0.0 && rect.high.y >= 0.0 && rect.low.x <= 1.0 && rect.low.y <= 1.0)) return;
    const int left = binOf(rect.low.x), right = binOf(rect.high.x), top = binOf(rect.high.y);
    for (int row = binOf(rect.low.y); row <= top; ++row)
        for (int column = left; column <= right; ++column)
            for (const std::size_t i : _bins[std::size_t(row * side + column)]) {
                const glm::dvec2& at = _rays[i].at;
                if (at.x >= rect.low.x && at.x <= rect.high.x && at.y >= rect.low.y && at.y <= rect.high.y)
                    visit(i, _rays[i]);
            }
}

/// A triangle that reaches behind the eye may be anywhere in the picture.
/// Source: T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997.
void RayBins::meet(const PlacedTriangles& triangles, const Hit& hit) const {
    if (_rays.empty()) return;
    const glm::dmat4 pictureFromMesh = _pictureFromScene * triangles.sceneFromMesh;
    std::vector<glm::dvec3> places(triangles.cornerCount), seen(triangles.cornerCount); // seen: x/w, y/w, w
    for (std::size_t i = 0; i < triangles.cornerCount; ++i) {
        const glm::dvec4 inMesh(triangles.corners[i], 1.0), corner = pictureFromMesh * inMesh;
        places[i] = glm::dvec3(triangles.sceneFromMesh * inMesh);
        seen[i] = {corner.x / corner.w, corner.y / corner.w, corner.w};
    }
    for (std::size_t i = 0; i < triangles.count; ++i) {
        const unsigned* index = triangles.indices + 3 * i;
        const glm::dvec3 &a = seen[index[0]], &b = seen[index[1]], &c = seen[index[2]];
        if (!(a.z > 0.0 || b.z > 0.0 || c.z > 0.0)) continue;
        ScreenRect rect{glm::dvec2(0.0), glm::dvec2(1.0)};
        if (a.z > 0.0 && b.z > 0.0 && c.z > 0.0)
            rect = {glm::dvec2(glm::min(a, glm::min(b, c))) - ofPicture,
                    glm::dvec2(glm::max(a, glm::max(b, c))) + ofPicture};
        const glm::dvec3 &first = places[index[0]], u = places[index[1]] - first, v = places[index[2]] - first;
        const glm::dvec3 normal = glm::cross(u, v);
        eachIn(rect, [&](std::size_t number, const Ray& ray) {
            const double along = -glm::dot(normal, ray.way);
            const glm::dvec3 from = ray.from - first, turned = glm::cross(from, ray.way);
            const double inU = glm::dot(v, turned) / along, inV = -glm::dot(u, turned) / along;
            if (inU >= 0.0 && inV >= 0.0 && inU + inV <= 1.0) hit({number, i, glm::dot(normal, from) / along, normal});
        });
    }
}

void RayBins::meet(const PlacedBox& box, const Hit& hit) const {
    if (_rays.empty()) return;
    const auto corners = boxCorners(box.low, box.high, _clipFromScene * box.sceneFromBox);
    const auto bounds = screenBounds(corners);
    if (!bounds) return;
    const ScreenRect rect{(bounds->low + 1.0) / 2.0 - ofPicture, (bounds->high + 1.0) / 2.0 + ofPicture};
    bool any = false;
    eachIn(rect, [&any](std::size_t, const Ray&) { any = true; });
    if (!any) return; // the rest takes longer
    const glm::dmat4 boxFromScene = glm::inverse(box.sceneFromBox);
    const glm::dmat3 turn(boxFromScene), back = glm::transpose(turn);
    eachIn(rect, [&](std::size_t number, const Ray& ray) {
        const glm::dvec3 from(boxFromScene * glm::dvec4(ray.from, 1.0)), way = turn * ray.way;
        double in = -infinity, out = infinity;
        int inAxis = 0, outAxis = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (way[axis] == 0.0) {
                if (from[axis] < box.low[axis] || from[axis] > box.high[axis]) in = infinity;
                continue;
            }
            double near = (box.low[axis] - from[axis]) / way[axis], far = (box.high[axis] - from[axis]) / way[axis];
            if (near > far) std::swap(near, far);
            if (near > in) in = near, inAxis = axis;
            if (far < out) out = far, outAxis = axis;
        }
        if (!(in <= out && out > 0.0 && std::isfinite(out))) return;
        const bool outside = in > 0.0;
        const int axis = outside ? inAxis : outAxis;
        const bool upwards = way[axis] < 0.0;
        glm::dvec3 normal(0.0);
        normal[axis] = upwards ? 1.0 : -1.0;
        hit({number, std::size_t(2 * axis + (upwards ? 1 : 0)), outside ? in : out, back * normal, !outside, out});
    });
}

SeenEdges::SeenEdges(const glm::dmat4& clipFromScene, const glm::dvec2& pixels, const ScreenRect& within,
                     const glm::dvec4& light)
    : _clipFromScene(clipFromScene),
      _sceneFromClip(glm::inverse(clipFromScene)),
      _pixel(2.0 / (pixels * (within.high - within.low))),
      _within(within),
      _light(light) {}

void SeenEdges::addReceiver(const PlacedBox& given, Relief relief) {
    PlacedBox box = given;
    const auto flat = flatAxis(box);
    if (flat && relief == Relief::HalfWay) box.low[*flat] = box.high[*flat] = (box.low[*flat] + box.high[*flat]) / 2.0;
    _receivers.push_back(box);
}

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

SeenEdges::Cells SeenEdges::grid() const {
    Cells cells;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            cells.push_back(cellAt(glm::dvec2(column + 0.5, row + 0.5) / glm::dvec2(columns, rows)));
    return cells;
}

/// What is seen of the receivers: the nearest.
void SeenEdges::look(Cells& cells) const {
    std::vector<RayBins::Ray> rays;
    for (const Cell& cell : cells) rays.push_back({cell.from, cell.way, cell.at});
    const glm::dvec3 size(_within.high - _within.low, 1.0);
    const glm::dmat4 gridFromClip = glm::translate(glm::scale(glm::dmat4(1.0), 1.0 / size), {-_within.low, 0.0});
    const RayBins bins(gridFromClip * _clipFromScene, std::move(rays));
    int first = 0;
    const auto take = [&](const RayBins::Met& met, int side) {
        Cell& cell = cells[met.ray];
        if (!(met.reach > 0.0 && met.reach < cell.reach)) return;
        cell.reach = met.reach;
        cell.normal = glm::normalize(glm::dot(met.normal, cell.way) < 0.0 ? met.normal : -met.normal);
        cell.side = side;
    };
    for (const PlacedBox& box : _receivers) {
        bins.meet(box, [&](const RayBins::Met& met) { take(met, first + int(met.side)); });
        first += 6;
    }
    for (const PlacedTriangles& mesh : _meshes) {
        bins.meet(mesh, [&](const RayBins::Met& met) {
            const auto part = std::upper_bound(mesh.parts.begin(), mesh.parts.end(), met.side) - mesh.parts.begin() - 1;
            const bool back = glm::dot(met.normal, cells[met.ray].way) > 0.0;
            if (back && !mesh.oneSided.empty() && mesh.oneSided[std::size_t(part)]) return;
            take(met, first + int(part));
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
    const double least = cell.side >= 6 * int(_receivers.size()) ? grazing : 0.0;
    const glm::dvec3 way = glm::dvec3(_light) - _light.w * cell.place().place;
    return glm::dot(cell.normal, way) > least * glm::length(way);
}

void SeenEdges::darken(Cells& cells) const {
    constexpr double beside = 1e-6; // of a box's size: what is so close is at the box itself
    for (const glm::dmat4& mapFromScene : _maps) {
        std::vector<RayBins::Ray> rays;
        for (const Cell& cell : cells) {
            const glm::dvec3 place = cell.place().place;
            const glm::dvec4 at = mapFromScene * glm::dvec4(place, 1.0);
            const glm::dvec2 in = faces(cell) && !cell.dark && at.w > 0.0 ? glm::dvec2(at) / at.w : glm::dvec2(-1.0);
            rays.push_back({place, glm::dvec3(_light) - _light.w * place, in});
        }
        const RayBins bins(mapFromScene, rays);
        const glm::dmat4 sceneFromMap = glm::inverse(mapFromScene);
        const auto depthAt = [&](const glm::dvec3& place) {
            const glm::dvec4 at = mapFromScene * glm::dvec4(place, 1.0);
            return at.z / at.w;
        };
        const auto take = [&](const RayBins::Met& met, double least) {
            const RayBins::Ray& ray = rays[met.ray];
            const bool before = _light.w == 0.0 || met.reach < 1.0;
            if (!(before && met.reach * glm::length(ray.way) > least)) return;
            Cell& cell = cells[met.ray];
            cell.dark = true;
            // As map.frag and DepthMap allow for the slopes of both; what is farthest from the surface is in the map.
            const glm::dvec3 blocker = ray.from + std::max(met.reach, met.through) * ray.way;
            const glm::dvec2 own = slopeIn(sceneFromMap, cell.normal, ray.from),
                             other = slopeIn(sceneFromMap, met.normal, blocker);
            const double allowed = 0.75 * (own.x + own.y) + 0.5 * std::max(other.x, other.y),
                         texel = std::abs(depthAt(ray.from) - depthAt(blocker)) / allowed;
            cell.texel = std::max(cell.texel, texel / mapAUnit(mapFromScene, ray.from, ray.way));
        };
        for (const PlacedBox& box : _casters) {
            const double least = beside * glm::distance(box.low, box.high);
            bins.meet(box, [&](const RayBins::Met& met) {
                if (!met.inside) take(met, least);
            });
        }
        for (const PlacedTriangles& mesh : _meshes)
            bins.meet(mesh, [&](const RayBins::Met& met) { take(met, cells[met.ray].least()); });
    }
}

/// Asks so many pixels to the left and the right of what is between two edges, and below and above. Where the next pixel shows
/// something else, the edge of a shadow cannot be told.
void SeenEdges::narrow(Cells& cells) const {
    constexpr std::array steps{0.25, 0.5, 1.0, 2.0, 4.0};       // pixels to a side
    constexpr std::array middles{0.125, 0.375, 0.75, 1.5, 3.0}; // between a step and the one before
    constexpr std::size_t toASide = steps.size(), each = 4 * toASide;
    Cells beside;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool level = isEdgeTo(cells, i, -1, 0) && isEdgeTo(cells, i, 1, 0);
        const bool upright = isEdgeTo(cells, i, 0, -1) && isEdgeTo(cells, i, 0, 1);
        if (!level && !upright) continue;
        of.push_back(i);
        for (int axis = 0; axis < 2; ++axis)
            for (const double side : {-1.0, 1.0})
                for (const double step : steps) {
                    glm::dvec2 at = cells[i].at;
                    at[axis] += side * step * _pixel[axis];
                    beside.push_back(cellAt(at));
                }
    }
    look(beside);
    darken(beside);
    for (std::size_t i = 0; i < of.size(); ++i) {
        Cell& cell = cells[of[i]];
        for (std::size_t axis = 0; axis < 2; ++axis) {
            double across = 0.0;
            for (std::size_t side = 0; side < 2; ++side) {
                double off = infinity;
                for (std::size_t step = toASide; step-- > 0;) {
                    const Cell& there = beside[i * each + (2 * axis + side) * toASide + step];
                    if (faces(there) && there.dark != cell.dark) off = middles[step];
                    const bool inGrid = glm::all(glm::greaterThanEqual(there.at, glm::dvec2(0.0))) &&
                                        glm::all(glm::lessThan(there.at, glm::dvec2(1.0)));
                    cell.left = cell.left || (inGrid && steps[step] <= 1.0 && there.side != cell.side);
                }
                across += off;
            }
            cell.across = std::min(cell.across, across);
        }
    }
    for (Cell& cell : cells)
        if (cell.left) cell.side = -1;
    weighNarrow(cells);
}

/// One of width a is met by one cell in pitch / a. Fewer than a handful may be met by chance.
void SeenEdges::weighNarrow(Cells& cells) const {
    const double pitch = std::sqrt(1.0 / (_pixel.x * columns * _pixel.y * rows));
    double met = 0.0;
    for (const Cell& cell : cells) met += cell.side >= 0 && cell.across < pitch ? 1.0 : 0.0;
    const double sure = met > 0.0 ? std::max(0.0, 1.0 - 2.0 / std::sqrt(met)) : 0.0; // two deviations fewer
    for (Cell& cell : cells)
        if (cell.across < pitch) cell.share = sure * pitch / cell.across;
}

bool SeenEdges::isEdgeTo(const Cells& cells, std::size_t index, int right, int up) const {
    const int x = int(index) % columns + right, y = int(index) / columns + up;
    return x >= 0 && y >= 0 && x < columns && y < rows &&
           isEdge(cells[index], cells[std::size_t(y) * columns + std::size_t(x)]);
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

/// Where a shadow begins at what casts it, it is lost for a texel or so, as everybody expects; so pixels about a place must be
/// as dark, and as near to what casts. Texels of many pixels are no concern: edges tell of them.
std::vector<Contact> SeenEdges::contactsOf(const Cells& cells) const {
    constexpr double beside = 1.5, mostPixels = 8.0;
    Cells about;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Cell& cell = cells[i];
        if (!cell.dark) continue;
        const Cell next = cellAt(cell.at + glm::dvec2(_pixel.x, 0.0));
        const double pixel = glm::distance(cell.place().place, next.from + cell.reach * next.way);
        if (!(cell.texel < mostPixels * pixel)) continue;
        of.push_back(i);
        for (const glm::dvec2& side :
             {glm::dvec2(1.0, 0.0), glm::dvec2(-1.0, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(0.0, -1.0)})
            about.push_back(cellAt(cell.at + beside * side * _pixel));
    }
    if (of.empty()) return {};
    look(about);
    darken(about);
    std::vector<Contact> result;
    for (std::size_t i = 0; i < of.size(); ++i) {
        const Cell& cell = cells[of[i]];
        const glm::dvec3 place = cell.place().place;
        double texel = cell.texel;
        bool within = true;
        for (std::size_t side = 4 * i; side < 4 * i + 4; ++side) {
            within = within && about[side].dark && about[side].side == cell.side;
            texel = std::max(texel, about[side].texel);
        }
        if (within) result.push_back({place, glm::dvec3(_light) - _light.w * place, texel});
    }
    return result;
}

std::vector<SeenPlace> SeenEdges::edges(std::vector<Contact>* contacts) const {
    Cells cells = grid();
    look(cells);
    darken(cells);
    if (contacts) *contacts = contactsOf(cells);
    narrow(cells);
    std::vector<SeenPlace> result;
    const auto add = [&](int column, int row, int right, int up) {
        const std::size_t index = std::size_t(row) * columns + std::size_t(column);
        if (!isEdgeTo(cells, index, right, up)) return;
        const Cell &one = cells[index], &other = cells[index + std::size_t(up * columns + right)];
        const Cell& thin = one.across < other.across ? one : other;
        const bool folded = bends(one, other);
        for (const int i : {0, 1}) {
            const SeenPlace place = (i == 0 ? one : other).place();
            const glm::dvec2 way = wayAt(cells, column + i * right, row + i * up);
            result.push_back({place.place, place.normal, way, thin.across, thin.share, folded});
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
glm::dvec2 SeenEdges::wayAt(const Cells& cells, int column, int row) const {
    constexpr int far = 2;
    const auto at = [&](int x, int y) -> const Cell& { return cells[std::size_t(y) * columns + std::size_t(x)]; };
    const Cell& here = at(column, row);
    glm::dvec2 change(0.0);
    for (int y = std::max(row - far, 0); y <= std::min(row + far, rows - 1); ++y)
        for (int x = std::max(column - far, 0); x <= std::min(column + far, columns - 1); ++x) {
            const Cell& other = at(x, y);
            if (isEdge(here, other)) change += glm::dvec2(x - column, y - row) * (other.dark ? 1.0 : -1.0);
        }
    const glm::dvec2 cell = (_within.high - _within.low) / glm::dvec2(columns, rows);
    return {-change.y * cell.x, change.x * cell.y};
}

std::vector<SeenPlace> SeenEdges::facing() const {
    Cells cells = grid();
    look(cells);
    std::vector<SeenPlace> result;
    for (const Cell& cell : cells)
        if (faces(cell)) result.push_back(cell.place());
    return result;
}

EdgeWidths::EdgeWidths(const glm::dmat4& clipFromScene, const glm::dvec2& pixels)
    : _clipFromScene(clipFromScene), _sceneFromClip(glm::inverse(clipFromScene)), _pixels(pixels) {}

/// Sides of a pixel in the map on what faces the eye: neither nearer nor farther along the picture.
glm::dmat2 EdgeWidths::facing(const glm::dvec4& clip, const glm::dmat4& mapFromScene) const {
    const glm::dmat4 mapFromClip = mapFromScene * _sceneFromClip;
    const glm::dvec4 there = clip / clip.w;
    const glm::dvec3 x(2.0 / _pixels.x, 0.0, 0.0), y(0.0, 2.0 / _pixels.y, 0.0);
    return slopeOf(mapFromClip, mapFromClip * there, x, y);
}

/// An edge along a way in the map is moved across it. In the picture the area between its two places is the determinant times
/// as large, and it is that area divided by its length there that it moves.
void EdgeWidths::add(const SeenPlace& place, const glm::dmat4& mapFromScene) {
    constexpr double shortened = 16.0; // as in map.frag
    const glm::dvec4 here(place.place, 1.0), clip = _clipFromScene * here, map = mapFromScene * here;
    if (!(clip.w > 0.0) || !(map.w > 0.0)) return;
    const auto [u, v] = across(glm::normalize(place.normal));
    const glm::dmat2 inMap = slopeOf(mapFromScene, map, u, v);
    glm::dmat2 inPicture = slopeOf(_clipFromScene, clip, u, v);
    for (int column = 0; column < 2; ++column) inPicture[column] *= _pixels / 2.0;
    const glm::dmat2 pictureFromMap = inPicture * glm::inverse(inMap);
    const glm::dmat2 mapFromPicture = glm::inverse(pictureFromMap);
    const double area = std::abs(glm::determinant(pictureFromMap));
    const bool slanted = longest(mapFromPicture) > shortened * longest(facing(clip, mapFromScene));
    const auto add = [&](const glm::dvec2& way, double length) {
        const double width = area * glm::length(mapFromPicture * way) / glm::length(way);
        if (length * place.share > 0.0 && width > 0.0 && std::isfinite(width))
            addEdge({width, length * place.share, place.across, riseOf(way), place.folded, slanted});
    };
    if (place.edge != glm::dvec2(0.0)) return add(place.edge * _pixels, 1.0);
    for (int i = 0; i < directions; ++i) {
        const double angle = halfTurn * i / directions;
        const glm::dvec2 way = inPicture * glm::dvec2(std::cos(angle), std::sin(angle));
        add(way, glm::length(way) / directions);
    }
}

void EdgeWidths::addContact(const Contact& contact, double pixels, const glm::dmat4& mapFromScene) {
    _contacts.emplace(1.0 / (contact.texel * mapAUnit(mapFromScene, contact.place, contact.way)), pixels);
}

double EdgeWidths::leak(double texels) const {
    double pixels = 0.0;
    for (auto each = _contacts.upper_bound(texels); each != _contacts.end(); ++each) pixels += each->second;
    return std::sqrt(pixels);
}

void EdgeWidths::addEdge(const Edge& edge) {
    constexpr double kinds = 8.0; // of widths, an octave: so they are sorted sooner
    const auto step = [](double of) {
        return of > 0.0 && std::isfinite(of) ? int(std::floor(kinds * std::log2(of))) : INT_MAX;
    };
    const int rise = int(std::floor(kinds * edge.rise));
    Edge& all = _edges[{step(edge.width), step(edge.across), rise, edge.folded, edge.slanted}];
    const double before = all.length / (all.length + edge.length);
    const double width = before * all.width + (1.0 - before) * edge.width;
    const double length = all.length + edge.length;
    all = edge;
    all.width = width;
    all.length = length;
}

/// The share of all edges that is off by no more than x grows with x by pieces: those that are off by less count whole.
double EdgeWidths::usual(double share, const Off& off) const {
    std::vector<std::pair<double, double>> edges; // how far off, and how long
    double all = 0.0, slope = 0.0, whole = 0.0;
    for (const auto& [like, edge] : _edges) {
        edges.emplace_back(off(edge), edge.length);
        all += edge.length;
        slope += edges.back().first > 0.0 ? edge.length / edges.back().first : 0.0;
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [most, length] : edges) {
        const double reached = (share * all - whole) / slope;                      // if it lies before this edge's
        if (reached <= most) return std::min(reached / share, edges.back().first); // not by rounding beyond all
        whole += length;
        slope -= most > 0.0 ? length / most : 0.0;
    }
    return edges.empty() ? 0.0 : edges.back().first;
}

/// Between two columns the drawn edge goes on level, or rises by a pixel. So above or below the true one it is off by any amount
/// between e and e - rise, or e and e + 1 - rise, with e at random: by more than a in (0.5 - a)^2 / (rise (1 - rise)) of its length.
/// The nearest place is nearer than that above or below, as if more of it were beyond: fitted to stripes.
double sampledEdgeOf(double rise) {
    constexpr double beyond = 0.05, ofNearest = 0.12;
    const double most = 0.5 - std::max(0.5 * beyond, std::sqrt(ofNearest * rise * (1.0 - rise)));
    return most / std::hypot(1.0, rise);
}

double sampledError(const EdgeWidths::Edge& edge) {
    return std::max(sampledBy(edge.rise), lostWidth(edge.across, 1.0));
}

/// A smooth edge is as hard as others where pixels are long, and next to a fold.
double mapError(const EdgeWidths::Edge& edge, const EdgeFilter& filter, double texels) {
    const double texel = edge.width / texels, sampled = sampledBy(edge.rise);
    const bool mean = filter.mean && !edge.slanted && !edge.folded;
    EdgeFilter here = filter;
    if (!filter.mean) here.pixel *= sampled / sampledEdge;
    if (filter.pixel < sampledEdge && (edge.slanted || edge.folded)) here.pixel = std::max(here.pixel, sampled);
    return std::max(mapError(here, texel), lostWidth(edge.across, mean ? texel : std::max(texel, 1.0)));
}

double mapError(const EdgeFilter& filter, double pixelsATexel) {
    return std::hypot(filter.pixel, filter.spread * pixelsATexel);
}

double polygonError(double pixelsOff) { return std::hypot(sampledEdge, pixelsOff); }

} // namespace gnomon
