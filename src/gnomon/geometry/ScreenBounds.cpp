// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon {
namespace {

using Points = std::vector<glm::dvec3>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

bool isFinite(const glm::dvec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

double side(const glm::dvec4& halfSpace, const glm::dvec3& point) {
    return glm::dot(halfSpace, glm::dvec4(point, 1.0));
}

/// A convex polygon that is cut, in memory that is used again.
class CutPolygon {
public:
    Points corners;

    /// Sutherland and Hodgman's cut by one half-space. An edge is always cut from its kept end, so that two faces cut their
    /// common edge at the same point.
    void cut(const glm::dvec4& halfSpace) {
        _kept.clear();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            glm::dvec3 from = corners[i], to = corners[(i + 1) % corners.size()];
            double fromSide = side(halfSpace, from), toSide = side(halfSpace, to);
            if (fromSide >= 0.0) _kept.push_back(from);
            if ((fromSide >= 0.0) == (toSide >= 0.0)) continue;
            if (fromSide < 0.0) {
                std::swap(from, to);
                std::swap(fromSide, toSide);
            }
            _kept.push_back(from + (to - from) * (fromSide / (fromSide - toSide)));
        }
        corners.swap(_kept);
    }

private:
    Points _kept;
};

std::array<glm::dvec4, 6> sidesOfBox(const glm::dvec3& low, const glm::dvec3& high) {
    return {{{1, 0, 0, -low.x},
             {0, 1, 0, -low.y},
             {0, 0, 1, -low.z},
             {-1, 0, 0, high.x},
             {0, -1, 0, high.y},
             {0, 0, -1, high.z}}};
}

/// The face of a box across `axis` at a level.
void setFace(const glm::dvec3& low, const glm::dvec3& high, int axis, double level, Points& face) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    face.resize(4);
    for (std::size_t i = 0; i < 4; ++i) {
        face[i][axis] = level;
        face[i][u] = i == 1 || i == 2 ? high[u] : low[u];
        face[i][v] = i >= 2 ? high[v] : low[v];
    }
}

/// A square in the boundary of `halfSpace`, large enough to cover the box's section. Empty if it has no boundary.
Points section(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& halfSpace) {
    const double size = glm::length(glm::dvec3(halfSpace));
    if (!(size > 0.0)) return {};
    const glm::dvec3 normal = glm::dvec3(halfSpace) / size, centre = 0.5 * (low + high);
    const glm::dvec3 thin = glm::abs(normal);
    const glm::dvec3 axis = thin.x <= thin.y && thin.x <= thin.z ? glm::dvec3(1, 0, 0)
                            : thin.y <= thin.z                   ? glm::dvec3(0, 1, 0)
                                                                 : glm::dvec3(0, 0, 1);
    const double reach = 2.0 * glm::length(high - low);
    const glm::dvec3 u = glm::normalize(glm::cross(normal, axis)), v = glm::cross(normal, u);
    const glm::dvec3 foot = centre - normal * (side(halfSpace, centre) / size);
    return {foot + reach * (u + v), foot + reach * (u - v), foot - reach * (u + v), foot - reach * (u - v)};
}

bool lexicographic(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

void append(Points& all, const Points& more) { all.insert(all.end(), more.begin(), more.end()); }

/// Limits of x/w (axis 0) or y/w (axis 1) over the part of a hull with w > 0.
struct Limits {
    double low = infinity, high = -infinity;
    double lowBehind = infinity, highBehind = -infinity; ///< of x/w over the points with w < 0.

    void add(double x, double w) {
        const double slope = x / w;
        double& least = w > 0.0 ? low : lowBehind;
        double& most = w > 0.0 ? high : highBehind;
        least = std::min(least, slope);
        most = std::max(most, slope);
    }

    /// An edge from (x, w > 0) to (x', w' < 0) meets w = 0 at the sign of x/w - x'/w', and x/w tends to that infinity.
    /// Equal slopes (x = 0 at both ends, say) keep x/w as it is; equal but for rounding count as unequal.
    void passBehindTheEye() {
        if (lowBehind > highBehind) return; // nothing is behind
        if (high > lowBehind - 8.0 * epsilon * std::abs(lowBehind)) high = infinity;
        if (low < highBehind + 8.0 * epsilon * std::abs(highBehind)) low = -infinity;
    }
};

Limits limitsAlong(const glm::dvec4* points, std::size_t count, int axis) {
    Limits limits;
    for (const glm::dvec4* point = points; point != points + count; ++point)
        if (point->w > 0.0 || point->w < 0.0) limits.add((*point)[axis], point->w);
    limits.passBehindTheEye();
    for (const glm::dvec4* point = points; point != points + count; ++point) { // w = 0 itself: an end at infinity
        if (point->w == 0.0 && (*point)[axis] > 0.0) limits.high = infinity;
        if (point->w == 0.0 && (*point)[axis] < 0.0) limits.low = -infinity;
    }
    return limits;
}

/// The part of the screen between two corners; nullopt if there is none.
std::optional<ScreenRect> onScreen(const glm::dvec2& low, const glm::dvec2& high) {
    const ScreenRect rect{glm::max(low, -1.0), glm::min(high, 1.0)};
    return glm::all(glm::lessThanEqual(rect.low, rect.high)) ? std::optional(rect) : std::nullopt;
}

/// As nearly always, points that are all before the eye. Their limits are those of x/w and y/w.
/// @return false if one is not, or is not finite.
bool limitsBeforeEye(const glm::dvec4* points, std::size_t count, glm::dvec2& low, glm::dvec2& high) {
    double zero = 0.0; // not a number by what is not finite
    low = glm::dvec2(infinity);
    high = glm::dvec2(-infinity);
    for (const glm::dvec4* point = points; point != points + count; ++point) {
        if (!(point->w > 0.0)) return false;
        const glm::dvec2 at = glm::dvec2(*point) / point->w;
        low = glm::min(low, at);
        high = glm::max(high, at);
        zero += 0.0 * (point->x + point->y + point->z + point->w);
    }
    return zero == 0.0;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

constexpr std::size_t most = 8; // each of four cuts adds one corner

/// The four sides of the screen: a point is kept where the product is not below 0.
const std::array<glm::dvec4, 4> sides{
    {{1.0, 0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0, 1.0}, {0.0, 1.0, 0.0, 1.0}, {0.0, -1.0, 0.0, 1.0}}};

struct Polygon {
    std::array<glm::dvec4, most> corners;
    std::size_t count = 0;

    void add(const glm::dvec4& corner) { corners[count++] = corner; }
};

Polygon cut(const Polygon& polygon, const glm::dvec4& half) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec4 &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.count];
        const double fromA = glm::dot(half, a), fromB = glm::dot(half, b);
        if (fromA >= 0.0) result.add(a);
        if ((fromA < 0.0) != (fromB < 0.0)) result.add(a + (b - a) * (fromA / (fromA - fromB)));
    }
    return result;
}

} // namespace

std::array<glm::dvec4, 8> boxCorners(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& frameFromBox) {
    const std::array<glm::dvec4, 2> x{frameFromBox[0] * low.x, frameFromBox[0] * high.x},
        y{frameFromBox[1] * low.y, frameFromBox[1] * high.y},
        z{frameFromBox[2] * low.z + frameFromBox[3], frameFromBox[2] * high.z + frameFromBox[3]};
    std::array<glm::dvec4, 8> corners; // to the bit as glm multiplies, each product and sum once
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = (x[i & 1] + y[i >> 1 & 1]) + z[i >> 2];
    return corners;
}

std::vector<glm::dvec3> cutBox(const glm::dvec3& low, const glm::dvec3& high,
                               const std::vector<glm::dvec4>& halfSpaces) {
    const bool finite =
        isFinite({low, 0.0}) && isFinite({high, 0.0}) && std::all_of(halfSpaces.begin(), halfSpaces.end(), isFinite);
    if (!finite || !glm::all(glm::lessThanEqual(low, high))) return {};
    Points corners;
    CutPolygon polygon;
    for (int axis = 0; axis < 3; ++axis)
        for (const double level : {low[axis], high[axis]}) {
            setFace(low, high, axis, level, polygon.corners);
            for (const glm::dvec4& half : halfSpaces) polygon.cut(half);
            append(corners, polygon.corners);
        }
    const auto ofBox = sidesOfBox(low, high);
    for (std::size_t i = 0; i < halfSpaces.size(); ++i) {
        polygon.corners = section(low, high, halfSpaces[i]);
        for (const glm::dvec4& half : ofBox) polygon.cut(half);
        for (std::size_t j = 0; j < halfSpaces.size(); ++j)
            if (j != i) polygon.cut(halfSpaces[j]);
        append(corners, polygon.corners);
    }
    std::sort(corners.begin(), corners.end(), lexicographic);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

std::optional<ScreenRect> screenBounds(const glm::dvec4* clipPoints, std::size_t count) {
    glm::dvec2 low, high;
    if (limitsBeforeEye(clipPoints, count, low, high)) return onScreen(low, high);
    const glm::dvec4* const end = clipPoints + count;
    if (!std::all_of(clipPoints, end, isFinite)) return ScreenRect{{-1.0, -1.0}, {1.0, 1.0}};
    if (std::none_of(clipPoints, end, [](const glm::dvec4& point) { return point.w > 0.0; })) return std::nullopt;
    const Limits x = limitsAlong(clipPoints, count, 0), y = limitsAlong(clipPoints, count, 1);
    return onScreen({x.low, y.low}, {x.high, y.high});
}

std::vector<glm::dvec2> screenOutline(const std::vector<glm::dvec4>& clipPoints, const glm::dvec2& by) {
    std::vector<glm::dvec2> points;
    for (const glm::dvec4& point : clipPoints) {
        points.push_back(glm::dvec2(point) / point.w);
        const glm::dvec2& last = points.back();
        if (!(point.w > 0.0 && std::abs(last.x) < 1e6 && std::abs(last.y) < 1e6)) return {};
    }
    return grownOutline(points, by);
}

glm::dvec4 eyeIn(const glm::dmat4& clipFromFrame) {
    return glm::inverse(clipFromFrame) * glm::dvec4(0.0, 0.0, -1.0, 0.0);
}

std::vector<glm::dvec2> convexHull2D(std::vector<glm::dvec2> points) {
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<glm::dvec2> hull;
    for (const bool back : {false, true}) {
        const std::size_t start = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= start + 2 && !(cross(hull.back() - hull[hull.size() - 2], point - hull.back()) > 0.0))
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back(); // the other half begins with it
        if (!back) std::reverse(points.begin(), points.end());
    }
    return hull;
}

std::vector<glm::dvec2> grownOutline(const std::vector<glm::dvec2>& corners, const glm::dvec2& by) {
    std::vector<glm::dvec2> wider;
    for (const glm::dvec2& corner : corners)
        for (const double x : {-by.x, by.x})
            for (const double y : {-by.y, by.y}) wider.push_back(corner + glm::dvec2(x, y));
    return convexHull2D(std::move(wider));
}

ScreenArea screenArea(const std::array<glm::dvec4, 4>& quad, const glm::dvec2& pixels) {
    Polygon polygon;
    for (const glm::dvec4& corner : quad) polygon.add(corner);
    for (const glm::dvec4& half : sides) polygon = cut(polygon, half);
    std::array<glm::dvec2, most> places;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec4& corner = polygon.corners[i];
        if (!(corner.w > 0.0)) return {}; // all of it is in the eye
        places[i] = glm::dvec2(corner) / corner.w * pixels / 2.0;
    }
    ScreenArea result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec2 &a = places[i], &b = places[(i + 1) % polygon.count];
        result.area += (a.x * b.y - a.y * b.x) / 2.0;
        result.around += glm::distance(a, b);
    }
    result.area = std::abs(result.area);
    return result;
}

} // namespace gnomon
