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

/// Leaves out the corners that matter least while there are more triangles than wanted. @param most  twice the area in plan
/// that may be lost or won by it. @return what is.
double FanBatch::simplify(KernelFan& fan, double most) {
    double sum = 0.0;
    while (fan.corners > wantedTriangles + 2) {
        const auto at = [&](std::size_t i) { return fan.edge + i % fan.corners; };
        std::size_t least = 0;
        double area = infinite;
        for (std::size_t i = 0; i < fan.corners; ++i) {
            const double one = std::abs(areaAt(at(i + fan.corners - 1), at(i), at(i + 1)));
            if (one < area) area = one, least = i;
        }
        if (!(sum + area <= most)) break;
        sum += area;
        for (Lane* lane : {&_cx, &_cy, &_cz}) {
            const auto first = lane->begin() + std::ptrdiff_t(fan.edge + least);
            std::copy(first + 1, lane->begin() + std::ptrdiff_t(fan.edge + fan.corners), first);
        }
        --fan.corners;
    }
    return sum;
}

/// To the corner that sees all others. @return false if none does.
bool FanBatch::turnToStart(KernelFan& fan) {
    for (std::size_t start = 0; start < fan.corners; ++start) {
        const auto at = [&](std::size_t i) { return fan.edge + (start + i) % fan.corners; };
        double least = infinite, most = 0.0;
        for (std::size_t i = 1; i + 1 < fan.corners && least >= 0.0; ++i) {
            const double area = areaAt(fan.edge + start, at(i), at(i + 1));
            least = std::min(least, area);
            most = std::max(most, area);
        }
        if (!(least >= 0.0 && most > 0.0)) continue;
        if (start > 0)
            for (Lane* lane : {&_cx, &_cy, &_cz}) {
                const auto first = lane->begin() + std::ptrdiff_t(fan.edge);
                std::rotate(first, first + std::ptrdiff_t(start), first + std::ptrdiff_t(fan.corners));
            }
        return true;
    }
    return false;
}

/// Of a polygon that was measured.
void FanBatch::finish(Entry& entry) {
    KernelFan& fan = _fans[entry.fan];
    entry.seen = std::max(0.0, fan.area - std::abs(fan.under));
    entry.wrong = std::isnan(fan.lenses) ? infinite : fan.lenses;
    const double lost = simplify(fan, mostLost * entry.seen);
    entry.wrong += lost;
    const bool isStart = lost == 0.0 && fan.least >= 0.0 && fan.most > 0.0;
    if (!isStart && !turnToStart(fan)) entry.outcome = TerrainOutcome::noFan;
}

} // namespace gnomon
