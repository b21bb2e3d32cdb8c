// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

using Polygon = std::vector<glm::dvec2>;

constexpr double thinnest = 1e-6;              // of a rectangle's sides, the shorter to the longer
constexpr double steps = 1.0 / (1 << 19);      // of depth, as tests/render/PlanarBandTest.cpp measured
constexpr double floatError = 8.0 / (1 << 24); // of a matrix of floats times a vector of floats
constexpr double edgeOn = 20.0;                // tangent: the cosine of surface and light is 0.05
constexpr double mostInOneMap = 256.0; // of a lamp's distances: an error of depth is less than a texel of 1024 there
constexpr double infinity = std::numeric_limits<double>::infinity();

int leastOf(const glm::dvec3& v) { return v.x <= v.y && v.x <= v.z ? 0 : v.y <= v.z ? 1 : 2; }

glm::dvec3 anyAcross(const glm::dvec3& axis) {
    glm::dvec3 other(0.0);
    other[leastOf(glm::abs(axis))] = 1.0;
    return glm::normalize(glm::cross(axis, other));
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// What of a polygon is on the left of the line from `a` to `b`.
Polygon leftOf(const Polygon& polygon, const glm::dvec2& a, const glm::dvec2& b) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double atFrom = cross(b - a, from - a), atTo = cross(b - a, to - a);
        if (atFrom >= 0.0) kept.push_back(from);
        if ((atFrom >= 0.0) != (atTo >= 0.0)) kept.push_back(from + (to - from) * (atFrom / (atFrom - atTo)));
    }
    return kept;
}

/// A rectangle's way along one side, unit, and what it holds along that and across.
struct Rectangle {
    glm::dvec2 along{1.0, 0.0}, low{infinity}, high{-infinity};

    glm::dvec2 across() const { return {-along.y, along.x}; }
    void add(const glm::dvec2& point) {
        const glm::dvec2 at(glm::dot(along, point), glm::dot(across(), point));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    double area() const { return (high.x - low.x) * (high.y - low.y); }
};

Rectangle rectangleAlong(const glm::dvec2& along, const Polygon& polygon) {
    Rectangle result;
    result.along = along;
    for (const glm::dvec2& point : polygon) result.add(point);
    return result;
}

Rectangle smallestAbout(const Polygon& polygon) {
    Rectangle best = rectangleAlong({1.0, 0.0}, polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
        if (!(glm::dot(edge, edge) > 0.0)) continue;
        const Rectangle next = rectangleAlong(glm::normalize(edge), polygon);
        if (next.area() < best.area()) best = next;
    }
    return best;
}

/// No side is nothing.
void widen(Rectangle& rectangle) {
    const glm::dvec2 size = rectangle.high - rectangle.low;
    const double least = std::max(thinnest * std::max(size.x, size.y), std::numeric_limits<double>::min());
    for (int i = 0; i < 2; ++i) {
        const double missing = std::max(0.0, least - size[i]) / 2.0;
        rectangle.low[i] -= missing;
        rectangle.high[i] += missing;
    }
}

/// Rows that take a homogeneous place of the light's to 0 … 1 along the sides; depths stay.
glm::dmat4 unitFromLight(const Rectangle& rectangle) {
    const glm::dvec2 size = rectangle.high - rectangle.low, across = rectangle.across();
    return glm::transpose(glm::dmat4(glm::dvec4(rectangle.along / size.x, 0.0, -rectangle.low.x / size.x),
                                     glm::dvec4(across / size.y, 0.0, -rectangle.low.y / size.y),
                                     glm::dvec4(0.0, 0.0, 1.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0)));
}

/// Gives a map the outline's depths and some more. @param thick  see MapRoom.
void setDepths(MapFit& fit, const LightFrame& frame, const MapOutline& outline, double thick) {
    const double least = thick * (frame.isParallel ? 1.0 : outline.farthest * outline.farthest); // d(-1/w) is dw/w²
    const double more = 0.125 * std::max(outline.farthest - outline.nearest, 4.0 * least);
    fit.nearest = outline.nearest - more;
    fit.farthest = frame.isParallel ? outline.farthest + more : std::min(0.0, outline.farthest + more);
    const double range = fit.farthest - fit.nearest;
    fit.mapFromLight[2].z = 1.0 / range;
    fit.mapFromLight[3].z = -fit.nearest / range;
    fit.mapFromScene = fit.mapFromLight * frame.lightFromScene;
}

/// A box by its middle and half of each of its sides, as a frame has them, homogeneous.
struct BoxFrom {
    glm::dvec4 middle;
    std::array<glm::dvec4, 3> halves;

    explicit BoxFrom(const PlacedBox& box) : middle(box.sceneFromBox * glm::dvec4((box.low + box.high) / 2.0, 1.0)) {
        for (int axis = 0; axis < 3; ++axis)
            halves[std::size_t(axis)] = box.sceneFromBox[axis] * ((box.high[axis] - box.low[axis]) / 2.0);
    }
    BoxFrom(const glm::dmat4& frameFromScene, const BoxFrom& inScene) : middle(frameFromScene * inScene.middle) {
        for (std::size_t axis = 0; axis < 3; ++axis) halves[axis] = frameFromScene * inScene.halves[axis];
    }

    /// How far a linear function is from what it is in the middle, at most. @param row  of it.
    double reach(const glm::dvec4& row) const {
        return std::abs(glm::dot(row, halves[0])) + std::abs(glm::dot(row, halves[1])) +
               std::abs(glm::dot(row, halves[2]));
    }
    /// True if w is 1 all over it.
    bool isPlain() const { return middle.w == 1.0 && halves[0].w == 0.0 && halves[1].w == 0.0 && halves[2].w == 0.0; }
};

/// Of a box. A look at them is faster than to cut it: what is known already adds nothing.
template <class Test>
bool allCorners(const PlacedBox& box, const Test& test) {
    const auto corners = boxCorners(box.low, box.high, box.sceneFromBox);
    return std::all_of(corners.begin(), corners.end(), test);
}

constexpr double mostStretch = 8.0; // light at 7 degrees; edges are blurred by less than that in sight
constexpr double stretchOfBodies = 2.0;

/// Of a box that is flat, of any length; 0 of others.
glm::dvec3 flatNormal(const PlacedBox& box) {
    const auto thin = flatAxis(box);
    const glm::dmat3 way(box.sceneFromBox);
    return thin ? glm::cross(way[(*thin + 1) % 3], way[(*thin + 2) % 3]) : glm::dvec3(0.0);
}

constexpr double leastRatio = 2.0; // of a part's end to its beginning

/// Of the farthest to the nearest.
double ratioOf(const SeenRange& seen) {
    constexpr double most = 1e6; // what is nearer than that is a rounded zero
    if (seen.empty() || !(seen.farthest > 0.0)) return 1.0;
    return seen.farthest / std::max(seen.nearest, seen.farthest / most);
}

} // namespace

PlacedBox::PlacedBox(const glm::dvec3& lowest, const glm::dvec3& highest, const glm::dmat4& toScene)
    : low(lowest),
      high(highest),
      sceneFromBox(toScene),
      middle(toScene * glm::dvec4((lowest + highest) / 2.0, 1.0)),
      radius(std::numeric_limits<double>::infinity()) {
    if (glm::row(toScene, 3) != glm::dvec4(0.0, 0.0, 0.0, 1.0)) return;
    const glm::dvec3 half = (high - low) / 2.0;
    const glm::dvec3 x = half.x * glm::dvec3(toScene[0]), y = half.y * glm::dvec3(toScene[1]),
                     z = half.z * glm::dvec3(toScene[2]);
    const double skew = std::abs(glm::dot(x, y)) + std::abs(glm::dot(y, z)) + std::abs(glm::dot(z, x));
    const double found = std::sqrt(glm::dot(x, x) + glm::dot(y, y) + glm::dot(z, z) + 2.0 * skew);
    if (found >= 0.0) radius = found; // no number where a side is infinite
}

HalfSpaces both(HalfSpaces some, const HalfSpaces& others) {
    some.insert(some.end(), others.begin(), others.end());
    return some;
}

std::vector<glm::dvec4> cornersWithin(const PlacedBox& box, const HalfSpaces& halfSpaces) {
    const BoxFrom from(box);
    std::optional<std::array<glm::dvec4, 8>> all;
    HalfSpaces cutting; // by the others the box is not changed
    for (const glm::dvec4& half : halfSpaces) {
        const double middle = glm::dot(half, from.middle), reach = from.reach(half),
                     rounding = 1e-12 * (glm::dot(glm::abs(half), glm::abs(from.middle)) + reach);
        if (middle - reach > rounding) continue;
        if (middle + reach < -rounding) return {};
        if (!all) all = boxCorners(box.low, box.high, box.sceneFromBox);
        const auto outside = [&half](const glm::dvec4& corner) { return glm::dot(half, corner) < 0.0; };
        const auto count = std::count_if(all->begin(), all->end(), outside);
        if (count == 8) return {};
        if (count > 0) cutting.push_back(half * box.sceneFromBox);
    }
    if (!all) all = boxCorners(box.low, box.high, box.sceneFromBox);
    if (cutting.empty()) return {all->begin(), all->end()};
    std::vector<glm::dvec4> corners;
    for (const glm::dvec3& corner : cutBox(box.low, box.high, cutting))
        corners.push_back(box.sceneFromBox * glm::dvec4(corner, 1.0));
    return corners;
}

std::optional<int> flatAxis(const PlacedBox& box) {
    constexpr double flat = 1.0 / 8.0;
    glm::dvec3 length;
    for (int axis = 0; axis < 3; ++axis)
        length[axis] = glm::length(glm::dvec3(box.sceneFromBox[axis])) * (box.high[axis] - box.low[axis]);
    const int thin = leastOf(length);
    if (length[thin] > flat * std::min(length[(thin + 1) % 3], length[(thin + 2) % 3])) return std::nullopt;
    return thin;
}

glm::dvec4 nearerThan(const LightFrame& frame, double distance) { return -fartherThan(frame, distance); }

glm::dvec4 fartherThan(const LightFrame& frame, double distance) {
    return glm::row(frame.lightFromScene, 3) - glm::dvec4(0.0, 0.0, 0.0, distance);
}

LightFrame sunFrame(const glm::dvec3& towardsSun) {
    const glm::dvec3 away = -towardsSun, right = anyAcross(away), up = glm::cross(away, right);
    LightFrame frame;
    frame.lightFromScene = glm::dmat4(glm::transpose(glm::dmat3(right, up, away)));
    return frame;
}

LightFrame lampFrame(const glm::dvec3& lamp, const glm::dvec3& axis, double spread) {
    const glm::dvec3 right = anyAcross(axis), up = glm::cross(axis, right);
    const auto along = [&lamp](const glm::dvec3& way) { return glm::dvec4(way, -glm::dot(way, lamp)); };
    LightFrame frame;
    frame.isParallel = false;
    frame.lightFromScene =
        glm::transpose(glm::dmat4(along(right), along(up), glm::dvec4(0.0, 0.0, 0.0, -1.0), along(axis)));
    for (const glm::dvec3& side : {right, -right, up, -up}) frame.halfSpaces.push_back(along(spread * axis + side));
    return frame;
}

bool MapOutline::surrounds(const glm::dvec2& at) const {
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (!(cross(corners[(i + 1) % corners.size()] - corners[i], at - corners[i]) >= 0.0)) return false;
    return corners.size() >= 3;
}

bool MapOutline::covers(const glm::dvec4& p) const {
    const double depth = p.z / p.w;
    return p.w > 0.0 && depth >= nearest && depth <= farthest && surrounds(glm::dvec2(p) / p.w);
}

/// True if all of the box's ball is within: faster, and true of most boxes of a large scene.
bool MapOutline::coversBall(const PlacedBox& box) const {
    if (!_frame.isParallel || corners.size() < 3) return false;
    const glm::dvec3 middle(_frame.lightFromScene * glm::dvec4(box.middle, 1.0)); // which keeps lengths
    if (!(middle.z - box.radius >= nearest && middle.z + box.radius <= farthest)) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 side = corners[i + 1 < corners.size() ? i + 1 : 0] - corners[i];
        const double inside = cross(side, glm::dvec2(middle) - corners[i]);
        if (!(inside >= 0.0 && inside * inside >= box.radius * box.radius * glm::dot(side, side))) return false;
    }
    return true;
}

bool MapOutline::coversAll(const PlacedBox& box) const {
    if (empty()) return false;
    if (coversBall(box)) return true;
    const BoxFrom from(_frame.lightFromScene, BoxFrom(box));
    if (!_frame.isParallel || !from.isPlain())
        return allCorners(box, [this](const glm::dvec4& corner) { return covers(_frame.lightFromScene * corner); });
    const double thick = std::abs(from.halves[0].z) + std::abs(from.halves[1].z) + std::abs(from.halves[2].z);
    if (from.middle.z - thick < nearest || from.middle.z + thick > farthest) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
        const auto aside = [&side](const glm::dvec2& way) { return cross(side, way); };
        double reach = 0.0;
        for (const glm::dvec4& half : from.halves) reach += std::abs(aside(glm::dvec2(half)));
        if (!(aside(glm::dvec2(from.middle) - corners[i]) >= reach)) return false;
    }
    return corners.size() >= 3;
}

bool MapOutline::isBefore(const MapOutline& other) const {
    return !empty() && (other.empty() || nearest <= other.nearest) &&
           std::all_of(other.corners.begin(), other.corners.end(), [this](const auto& at) { return surrounds(at); });
}

void MapOutline::addBox(const PlacedBox& box, const HalfSpaces& halfSpaces) {
    if (coversAll(box)) return;
    for (const glm::dvec4& corner : cornersWithin(box, both(halfSpaces, _frame.halfSpaces))) {
        const glm::dvec4 p = _frame.lightFromScene * corner;
        if (!(p.w > 0.0)) continue; // the lamp's own place
        const double depth = p.z / p.w;
        nearest = corners.empty() ? depth : std::min(nearest, depth);
        farthest = corners.empty() ? depth : std::max(farthest, depth);
        corners.push_back(glm::dvec2(p) / p.w);
    }
    corners = convexHull2D(std::move(corners));
}

void MapOutline::merge(const MapOutline& other) {
    if (other.empty()) return;
    nearest = empty() ? other.nearest : std::min(nearest, other.nearest);
    farthest = empty() ? other.farthest : std::max(farthest, other.farthest);
    corners.insert(corners.end(), other.corners.begin(), other.corners.end());
    corners = convexHull2D(std::move(corners));
}

void MapOutline::cut(const MapOutline& other) {
    const Polygon& edges = other.corners;
    if (edges.empty()) corners.clear();
    if (edges.size() < 3) return;
    for (std::size_t i = 0; i < edges.size(); ++i) corners = leftOf(corners, edges[i], edges[(i + 1) % edges.size()]);
}

void MapOutline::limitNearest(double ratio) {
    if (!_frame.isParallel) nearest = std::max(nearest, ratio * farthest);
}

double MapOutline::split() const {
    if (_frame.isParallel || empty() || nearest >= mostInOneMap * farthest) return 0.0;
    return std::exp2(std::round(-std::log2(nearest * farthest) / 2.0)); // both have the same ratio
}

void MapOutline::grow(double by) { corners = grownOutline(corners, glm::dvec2(by)); }

double MapOutline::length() const {
    const Rectangle rectangle = smallestAbout(corners);
    return std::max(rectangle.high.x - rectangle.low.x, rectangle.high.y - rectangle.low.y);
}

HalfSpaces MapOutline::sides() const {
    Rectangle rectangle = smallestAbout(corners);
    widen(rectangle);
    const glm::dvec2 more = 1e-3 * (rectangle.high - rectangle.low); // cutBox() minds planes that are nearly one
    rectangle.low -= more;
    rectangle.high += more;
    HalfSpaces result;
    for (int axis = 0; axis < 2; ++axis) {
        const glm::dvec2 way = axis ? rectangle.across() : rectangle.along;
        result.push_back(glm::dvec4(way, 0.0, -rectangle.low[axis]) * _frame.lightFromScene);
        result.push_back(glm::dvec4(-way, 0.0, rectangle.high[axis]) * _frame.lightFromScene);
    }
    return result;
}

std::vector<glm::dvec4> MapOutline::corners3D() const {
    const glm::dmat4 sceneFromLight = glm::inverse(_frame.lightFromScene);
    std::vector<glm::dvec4> points;
    for (const glm::dvec2& corner : corners)
        for (const double depth : {nearest, farthest}) { // a lamp's in proportion to its distance, so that w is 1
            const double scale = _frame.isParallel ? 1.0 : -1.0 / depth;
            points.push_back(sceneFromLight * (scale * glm::dvec4(corner, depth, 1.0)));
        }
    return points;
}

bool MapFit::covers(const MapOutline& outline, double margin) const {
    const auto inside = [&](const glm::dvec2& corner) {
        const glm::dvec4 at = mapFromLight * glm::dvec4(corner, nearest, 1.0);
        return std::min(at.x, at.y) >= margin * at.w && std::max(at.x, at.y) <= (1.0 - margin) * at.w;
    };
    return outline.nearest >= nearest && outline.farthest <= farthest &&
           std::all_of(outline.corners.begin(), outline.corners.end(), inside);
}

MapFit fitMap(const LightFrame& frame, const MapOutline& outline, const MapOutline& most, const MapRoom& room) {
    Rectangle rectangle = smallestAbout(convexHull2D(outline.corners));
    const Rectangle limit = rectangleAlong(rectangle.along, most.corners);
    const glm::dvec2 around = room.reserve * (rectangle.high - rectangle.low);
    rectangle.low = glm::min(rectangle.low, glm::max(rectangle.low - around, limit.low));
    rectangle.high = glm::max(rectangle.high, glm::min(rectangle.high + around, limit.high));
    widen(rectangle);
    const glm::dvec2 border = room.margin / (1.0 - 2.0 * room.margin) * (rectangle.high - rectangle.low);
    rectangle.low -= border;
    rectangle.high += border;
    MapFit fit;
    fit.size = rectangle.high - rectangle.low;
    fit.mapFromLight = unitFromLight(rectangle);
    setDepths(fit, frame, outline, room.thick);
    return fit;
}

MapFit slidMap(MapFit fit, const LightFrame& frame, const MapOutline& outline, double thick, int texels) {
    Rectangle inMap;
    for (const glm::dvec2& corner : outline.corners)
        inMap.add(glm::dvec2(fit.mapFromLight * glm::dvec4(corner, 0.0, 1.0)));
    const glm::dvec2 offCentre = (inMap.low + inMap.high - 1.0) / 2.0;
    fit.mapFromLight[3] -= glm::dvec4(glm::round(offCentre * double(texels)) / double(texels), 0.0, 0.0);
    setDepths(fit, frame, outline, thick);
    return fit;
}

double softReach(const LightFrame& frame, double nearest, double farthest, double lightRadius, double radius) {
    const double perUnit = frame.isParallel ? 1.0 : -nearest;
    return lightRadius * std::max(0.0, farthest - nearest) + radius * perUnit;
}

MapSpread mapSpread(const LightFrame& frame, const MapFit& fit, double lightRadius, double radius, int texels) {
    const glm::dvec2 texelsAUnit = double(texels) / fit.size; // of x/w and y/w
    MapSpread spread;
    spread.penumbra = lightRadius * (fit.farthest - fit.nearest) * texelsAUnit;
    spread.nearest = radius * (frame.isParallel ? 1.0 : -fit.nearest) * texelsAUnit;
    spread.farthest = radius * (frame.isParallel ? 1.0 : -fit.farthest) * texelsAUnit;
    return spread;
}

double MapErrors::texelsOff() const {
    const auto off = [](const MapError& error) { return edgeOn * error.depth / error.steepest; };
    return std::min(off(nearest), off(farthest));
}

MapErrors mapErrors(const LightFrame& frame, const MapFit& fit, const glm::dvec3& reach, int texels) {
    const auto rounding = [&](int axis) {
        const glm::dvec4 row = glm::abs(glm::row(fit.mapFromScene, axis));
        return floatError * (glm::dot(glm::dvec3(row), reach) + row.w);
    };
    const double range = fit.farthest - fit.nearest, texel = fit.longer() / texels;
    const auto at = [&](double depth) {
        const double perW = frame.isParallel ? 1.0 : -depth;
        return MapError{steps + 2.0 * floatError + rounding(2) * perW,
                        texels * std::max(rounding(0), rounding(1)) * perW, edgeOn * texel / range * perW};
    };
    return {at(fit.nearest), at(fit.farthest)};
}

TexelDensity::TexelDensity(const LightFrame& frame, const glm::dmat4& clipFromScene, const glm::dvec2& pixels)
    : _frame(frame), _pixel(glm::row(clipFromScene, 3)) {
    const auto pixel = [&](int axis) {
        return 2.0 / (pixels[axis] * glm::length(glm::dvec3(glm::row(clipFromScene, axis))));
    };
    _pixel *= std::min(pixel(0), pixel(1));
    _pixelAUnit = glm::length(glm::dvec3(_pixel));
}

void TexelDensity::addBox(const PlacedBox& box, const HalfSpaces& halfSpaces) {
    const glm::dvec3 normal = flatNormal(box);
    const double least = side * (normal == glm::dvec3(0.0) ? stretchOfBodies : mostStretch);
    if (_frame.isParallel && glm::dot(_pixel, glm::dvec4(box.middle, 1.0)) - box.radius * _pixelAUnit >= least) return;
    const BoxFrom from(box);
    if (_frame.isParallel && from.isPlain()) {
        if (std::max(glm::dot(_pixel, from.middle) - from.reach(_pixel), 0.0) >= least) return;
    } else if (allCorners(box, [&](const glm::dvec4& corner) { return unstretched(corner) >= least; })) {
        return;
    }
    for (const glm::dvec4& corner : cornersWithin(box, both(halfSpaces, _frame.halfSpaces)))
        if (inLight(corner).w > 0.0) side = std::min(side, unstretched(corner) / stretch(normal, corner));
}

glm::dvec4 TexelDensity::inLight(const glm::dvec4& place) const { return _frame.lightFromScene * place; }

/// Side of a pixel on what faces the light there; 0 behind a lamp.
double TexelDensity::unstretched(const glm::dvec4& place) const {
    const double distance = inLight(place).w; // 1 of suns
    return distance > 0.0 ? std::max(glm::dot(_pixel, place), 0.0) / distance : 0.0;
}

/// @param normal  see flatNormal().
double TexelDensity::stretch(const glm::dvec3& normal, const glm::dvec4& place) const {
    if (normal == glm::dvec3(0.0)) return stretchOfBodies;
    const auto axis = [this](int row) { return glm::dvec3(glm::row(_frame.lightFromScene, row)); };
    const glm::dvec4 at = inLight(place);
    const glm::dvec3 light = _frame.isParallel ? axis(2) : at.x * axis(0) + at.y * axis(1) + at.w * axis(3);
    const double across = glm::length(normal) * glm::length(light);
    return across > 0.0 ? across / std::max(std::abs(glm::dot(normal, light)), across / mostStretch) : mostStretch;
}

int texelsFor(double wanted, int most, int before) {
    constexpr double enough = 7.0 / 8.0, step = 32.0;
    constexpr int fewest = 64;
    const double least = std::min(enough * wanted, double(most)), tooMany = std::max(2.0 * wanted, double(fewest));
    if (before > 0 && before >= least && before <= std::min(tooMany, double(most))) return before;
    return static_cast<int>(std::min(std::max(std::ceil(wanted / step) * step, double(fewest)), double(most)));
}

SeenRange::SeenRange(const glm::dmat4& clipFromScene)
    : _w(glm::row(clipFromScene, 3)), _wAUnit(glm::length(glm::dvec3(_w))) {}

void SeenRange::addBox(const PlacedBox& box, const HalfSpaces& halfSpaces) {
    const double at = glm::dot(_w, glm::dvec4(box.middle, 1.0)), within = box.radius * _wAUnit;
    if (nearest <= at - within && at + within <= farthest) return;
    const BoxFrom from(box);
    const double w = glm::dot(_w, from.middle), reach = from.reach(_w);
    if (nearest <= w - reach && w + reach <= farthest) return;
    for (const glm::dvec4& corner : cornersWithin(box, halfSpaces)) {
        nearest = std::min(nearest, glm::dot(_w, corner));
        farthest = std::max(farthest, glm::dot(_w, corner));
    }
}

int cascadesFor(const SeenRange& seen, double pixels, int before) {
    constexpr double mostPixels = 3.0; // on a side of a texel where it is widest
    const double partRatio = std::max(leastRatio, mostPixels / pixels);
    const double asked = std::log(ratioOf(seen)) / std::log(partRatio);
    if (before > 0 && asked <= before + 0.125 && asked > before - 1.25) return before;
    return static_cast<int>(std::clamp(std::ceil(asked), 1.0, double(mostCascades)));
}

std::vector<double> cascadeSplits(const SeenRange& seen, int most) {
    const double ratio = ratioOf(seen);
    const int maps = std::clamp(static_cast<int>(std::log(ratio) / std::log(leastRatio)), 1, most);
    std::vector<double> splits;
    for (int i = 1; i < maps; ++i) splits.push_back(seen.farthest * std::pow(ratio, double(i) / maps - 1.0));
    return splits;
}

HalfSpaces viewPart(const glm::dmat4& clipFromScene, const std::vector<double>& splits, std::size_t part) {
    const glm::dvec4 w = glm::row(clipFromScene, 3), depth = glm::row(clipFromScene, 2), here(0.0, 0.0, 0.0, 1.0);
    HalfSpaces result;
    for (const int axis : {0, 1})
        for (const double sign : {1.0, -1.0}) result.push_back(w + sign * glm::row(clipFromScene, axis));
    result.push_back(part == 0 ? w + depth : w - splits[part - 1] * here);
    result.push_back(part == splits.size() ? w - depth : splits[part] * here - w);
    return result;
}

glm::dmat4 coneFromScene(const glm::dvec3& apex, const SpotCone& cone) {
    const glm::dmat4 lamp = lampFrame(apex, cone.axis, 1.0).lightFromScene;
    const double across = std::cos(cone.cutoff), along = std::sin(cone.cutoff);
    return glm::transpose(glm::dmat4(across * glm::row(lamp, 0), across * glm::row(lamp, 1), along * glm::row(lamp, 3),
                                     glm::dvec4(0.0, 0.0, 0.0, 1.0)));
}

} // namespace gnomon
