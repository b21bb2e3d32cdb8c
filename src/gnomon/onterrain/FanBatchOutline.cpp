// SPDX-License-Identifier: MIT
// FanBatch: from where the corners' rays end to the polygon.
#include <gnomon/ground/GroundIntersection.h>
#include <gnomon/onterrain/FanBatch.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr std::size_t wantedTriangles = 12; // as many as the bounding-box method's
constexpr double mostLost = 0.01;           // of what is seen, for fewer triangles
constexpr double mostWide = 1e-3;           // of a part's size
constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

double FanBatch::areaAt(const Entry& entry, std::size_t a, std::size_t b, std::size_t c) const {
    const auto at = [&](std::size_t corner) {
        const KernelEdge& edge = edgeOf(entry, corner);
        return glm::dvec3(edge.endX[entry.lane], edge.endY[entry.lane], 0.0);
    };
    return doubleArea(at(a), at(b), at(c));
}

/// Leaves out the corners that matter least while there are more triangles than wanted. @param most  twice the area in plan
/// that may be lost or won by it. @return what is.
double FanBatch::simplify(Entry& entry, double most) {
    double sum = 0.0;
    while (entry.corners > wantedTriangles + 2) {
        const std::size_t n = entry.corners;
        std::size_t least = 0;
        double area = infinite;
        for (std::size_t i = 0; i < n; ++i) {
            const double one = std::abs(areaAt(entry, (i + n - 1) % n, i, (i + 1) % n));
            if (one < area) area = one, least = i;
        }
        if (!(sum + area <= most)) break;
        sum += area;
        for (std::size_t i = least; i + 1 < n; ++i) setEnd(entry, i, endOf(entry, i + 1));
        --entry.corners;
    }
    return sum;
}

/// To the corner that sees all others. @return false if none does.
bool FanBatch::turnToStart(const Entry& entry) {
    const std::size_t n = entry.corners;
    for (std::size_t start = 0; start < n; ++start) {
        double least = infinite, most = 0.0;
        for (std::size_t i = 1; i + 1 < n && least >= 0.0; ++i) {
            const double area = areaAt(entry, start, (start + i) % n, (start + i + 1) % n);
            least = std::min(least, area);
            most = std::max(most, area);
        }
        if (!(least >= 0.0 && most > 0.0)) continue;
        turn(entry, start);
        return true;
    }
    return false;
}

void FanBatch::turn(const Entry& entry, std::size_t start) {
    _turned.clear();
    for (std::size_t k = 0; k < entry.corners; ++k) _turned.push_back(endOf(entry, (start + k) % entry.corners));
    for (std::size_t k = 0; k < entry.corners; ++k) setEnd(entry, k, _turned[k]);
}

/// Whether a corner that is in the ground, and was put on the ground over it, lies out of the shadow there: under a wall that
/// slants. Under an upright one it lies in the wall.
bool FanBatch::isStoodTooWide(const Entry& entry) const {
    const KernelFan& fan = fanOf(entry);
    const double margin = mostWide * entry.size;
    const auto isOutside = [&](const glm::dvec4& plane, const glm::dvec3& point) {
        const glm::dvec3 normal(plane);
        return glm::dot(normal, point) + plane.w < -margin * glm::length(normal);
    };
    for (std::size_t e = 0; e < fan.edges; ++e) {
        if (rayOf(entry, e).descent[entry.lane] != 0.0) continue;
        const glm::dvec3 stood = endOf(entry, e);
        if (stood.z <= silhouette(entry, e).z + margin) continue;
        for (std::size_t k = 0; k < fan.edges; ++k)
            if (isOutside(edgePlane(entry, k), stood)) return true;
        for (std::size_t f = 0; f < fan.faces; ++f)
            if (isOutside(facePlane(entry, f), stood)) return true;
    }
    return false;
}

/// Of a polygon that was measured.
void FanBatch::finish(Entry& entry) {
    const KernelPart& part = partOf(entry);
    const std::size_t at = entry.lane;
    entry.corners = fanOf(entry).edges;
    entry.seen = std::max(0.0, part.area[at] - std::abs(part.under[at]));
    entry.wrong = std::isnan(part.lenses[at]) || isStoodTooWide(entry) ? infinite : part.lenses[at];
    const double lost = simplify(entry, mostLost * entry.seen);
    entry.wrong += lost;
    const bool isStart = lost == 0.0 && part.least[at] >= 0.0 && part.most[at] > 0.0;
    if (!isStart && !turnToStart(entry)) entry.outcome = TerrainOutcome::noFan;
}

} // namespace gnomon
