// SPDX-License-Identifier: MIT
// FanBatch: from where the corners' rays end to the polygon.
#include <gnomon/FanBatch.h>
#include <gnomon/GroundQuery.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr std::size_t wantedTriangles = 12; // as many as the bounding-box method's
constexpr double mostLost = 0.01;           // of what is seen, for fewer triangles
constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

double FanBatch::areaAt(std::size_t a, std::size_t b, std::size_t c) const {
    return doubleArea({_cx[a], _cy[a], 0.0}, {_cx[b], _cy[b], 0.0}, {_cx[c], _cy[c], 0.0});
}

double FanBatch::doublePolygon(const Lane& x, const Lane& y, std::size_t first, std::size_t count) {
    double sum = 0.0;
    const auto way = [&](std::size_t i) { return glm::dvec2(x[i] - x[first], y[i] - y[first]); };
    for (std::size_t i = first + 2; i < first + count; ++i) sum += cross(way(i - 1), way(i));
    return sum;
}

bool FanBatch::takePlaces(const Entry& entry, bool exactly) {
    KernelFan& fan = _fans[entry.fan];
    fan.corner = _outlined;
    fan.corners = fan.edges;
    _outlined += fan.edges;
    for (Lane* lane : {&_cx, &_cy, &_cz})
        if (lane->size() < _outlined + kernelPad) lane->resize(2 * _outlined + kernelPad);
    for (std::size_t i = 0; i < fan.edges; ++i) {
        const auto place = placeOf(entry, silhouette(fan.edge + i), _asked[entry.query + i], exactly);
        if (!place) return false;
        _cx[fan.corner + i] = place->x;
        _cy[fan.corner + i] = place->y;
        _cz[fan.corner + i] = place->z;
    }
    return true;
}

/// Twice the area in plan between the polygon's edges and the parabolas through where the middles of the silhouette's edges
/// fall; infinite where one meets no ground. Edges in an upright plane through the light are straight whatever the ground.
double FanBatch::doubleLenses(const Entry& entry, bool exactly) const {
    const KernelFan& fan = _fans[entry.fan];
    double sum = 0.0;
    for (std::size_t i = 0; i < fan.edges; ++i) {
        const unsigned query = _asked[entry.query + fan.edges + i];
        if (query == none) continue;
        const auto place = placeOf(entry, middle(fan.edge + i), query, exactly);
        if (!place) return infinite;
        const std::size_t a = fan.corner + i, b = fan.corner + (i + 1) % fan.edges;
        sum += 4.0 / 3.0 * std::abs((_cx[b] - _cx[a]) * (place->y - _cy[a]) - (_cy[b] - _cy[a]) * (place->x - _cx[a]));
    }
    return sum;
}

/// Leaves out the corners that matter least while there are more triangles than wanted. @param most  twice the area in plan
/// that may be lost or won by it. @return what is.
double FanBatch::simplify(KernelFan& fan, double most) {
    double sum = 0.0;
    while (fan.corners > wantedTriangles + 2) {
        const auto at = [&](std::size_t i) { return fan.corner + i % fan.corners; };
        std::size_t least = 0;
        double area = infinite;
        for (std::size_t i = 0; i < fan.corners; ++i) {
            const double one = std::abs(areaAt(at(i + fan.corners - 1), at(i), at(i + 1)));
            if (one < area) area = one, least = i;
        }
        if (!(sum + area <= most)) break;
        sum += area;
        for (Lane* lane : {&_cx, &_cy, &_cz}) {
            const auto first = lane->begin() + std::ptrdiff_t(fan.corner + least);
            std::copy(first + 1, lane->begin() + std::ptrdiff_t(fan.corner + fan.corners), first);
        }
        --fan.corners;
    }
    return sum;
}

/// To the corner that sees all others. @return false if none does.
bool FanBatch::turnToStart(KernelFan& fan) {
    for (std::size_t start = 0; start < fan.corners; ++start) {
        const auto at = [&](std::size_t i) { return fan.corner + (start + i) % fan.corners; };
        double least = infinite, most = 0.0;
        for (std::size_t i = 1; i + 1 < fan.corners && least >= 0.0; ++i) {
            const double area = areaAt(fan.corner + start, at(i), at(i + 1));
            least = std::min(least, area);
            most = std::max(most, area);
        }
        if (!(least >= 0.0 && most > 0.0)) continue;
        if (start > 0)
            for (Lane* lane : {&_cx, &_cy, &_cz}) {
                const auto first = lane->begin() + std::ptrdiff_t(fan.corner);
                std::rotate(first, first + std::ptrdiff_t(start), first + std::ptrdiff_t(fan.corners));
            }
        return true;
    }
    return false;
}

/// @return false if a ray meets no ground, or the polygon overlaps itself.
bool FanBatch::outline(Entry& entry) {
    const bool exactly = !isGentle(entry);
    if (!takePlaces(entry, exactly)) return false;
    KernelFan& fan = _fans[entry.fan];
    entry.seen = std::max(0.0, doublePolygon(_cx, _cy, fan.corner, fan.corners) -
                                   std::abs(doublePolygon(_sx, _sy, fan.edge, fan.edges)));
    entry.wrong = doubleLenses(entry, exactly);
    entry.wrong += simplify(fan, mostLost * entry.seen);
    return turnToStart(fan);
}

} // namespace gnomon
